#pragma once

#include "ale/box_grid.h"

namespace plash {

/// function(sheet) for every sheet of rows of a box, on all threads. What a sheet writes must not be read by
/// another one. Small boxes are not worth waking other threads.
template <class Function>
void for_sheets(const BoxGrid& grid, int count, Function&& function)
{
    const bool worth_it = count > 1 && grid.cell_count() >= 8192;
#pragma omp parallel for schedule(static) if (worth_it)
    for (int sheet = 0; sheet < count; ++sheet) function(sheet);
}

/// The same, for functions that return a number each; the numbers are added in the order of the sheets.
template <class Number, class Function>
Number sum_sheets(const BoxGrid& grid, int count, Function&& function)
{
    std::vector<Number> partial(count);
    for_sheets(grid, count, [&](int sheet) { partial[sheet] = function(sheet); });
    Number sum{};
    for (const Number& part : partial) sum += part;
    return sum;
}

} // namespace plash
