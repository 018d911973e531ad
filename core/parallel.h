#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

/// Parallel loops whose results do not depend on the number of threads: work is cut into chunks of a fixed
/// length, and what chunks return is combined in chunk order.
namespace plash {

inline constexpr std::size_t chunk_length = 2048;

/// function(begin, end) over [0, count) in chunks, on all threads.
template <class Function>
void for_chunks(std::size_t count, Function&& function)
{
    const auto chunks = static_cast<std::ptrdiff_t>((count + chunk_length - 1) / chunk_length);
#pragma omp parallel for schedule(static) if (chunks > 1)
    for (std::ptrdiff_t chunk = 0; chunk < chunks; ++chunk) {
        const std::size_t begin = chunk * chunk_length;
        function(begin, std::min(begin + chunk_length, count));
    }
}

/// Sum over chunks of function(begin, end), added in chunk order.
template <class Function>
double sum_chunks(std::size_t count, Function&& function)
{
    const auto chunks = static_cast<std::ptrdiff_t>((count + chunk_length - 1) / chunk_length);
    std::vector<double> partial(chunks);
#pragma omp parallel for schedule(static) if (chunks > 1)
    for (std::ptrdiff_t chunk = 0; chunk < chunks; ++chunk) {
        const std::size_t begin = chunk * chunk_length;
        partial[chunk] = function(begin, std::min(begin + chunk_length, count));
    }
    double sum = 0;
    for (double part : partial) sum += part;
    return sum;
}

} // namespace plash
