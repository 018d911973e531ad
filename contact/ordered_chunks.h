#pragma once

#include <algorithm>
#include <cstddef>

namespace plash {

/// work(room, begin, end) over [0, count) in chunks on all threads, and join(room) for each chunk in their
/// order, one at a time, while others are worked on: sums of many to many have the same bits for any number
/// of threads. Every thread has a Room of its own.
template <class Room, class Work, class Join>
void for_chunks_in_order(std::size_t count, std::size_t length, Work&& work, Join&& join)
{
    const auto chunks = static_cast<std::ptrdiff_t>((count + length - 1) / length);
#pragma omp parallel if (chunks > 1)
    {
        Room room;
#pragma omp for schedule(static, 1) ordered
        for (std::ptrdiff_t chunk = 0; chunk < chunks; ++chunk) {
            const std::size_t begin = chunk * length;
            work(room, begin, std::min(begin + length, count));
#pragma omp ordered
            join(room);
        }
    }
}

} // namespace plash
