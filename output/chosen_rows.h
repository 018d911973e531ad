#pragma once

#include "model/record.h"

#include <algorithm>
#include <span>
#include <vector>

namespace plash {

/// Row of each of `count` elements in results of some of them (ElementResults::shell_rows ...).
inline std::vector<Index> rows_of(std::span<const Index> elements, std::size_t count)
{
    std::vector<Index> rows(count, none);
    for (std::size_t row = 0; row < elements.size(); ++row) rows[elements[row]] = static_cast<Index>(row);
    return rows;
}

/// In rising order.
inline std::vector<Index> without_repeats(std::vector<Index> elements)
{
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    return elements;
}

} // namespace plash
