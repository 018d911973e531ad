#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace plash {

/// Memory on cache-line boundaries; long arrays stand on huge pages where the system has them, since
/// streaming through hundreds of megabytes is otherwise held up by address translation.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory, std::size_t bytes);

/// Allocator on cache-line boundaries.
template <class T>
struct CacheAligned {
    using value_type = T;
    CacheAligned() = default;
    template <class U>
    CacheAligned(const CacheAligned<U>&)
    {}
    T* allocate(std::size_t count) { return static_cast<T*>(allocate_aligned(count * sizeof(T))); }
    void deallocate(T* memory, std::size_t count) { free_aligned(memory, count * sizeof(T)); }
    bool operator==(const CacheAligned&) const { return true; }
};

/// A long array of numbers for loops in lanes.
using AlignedDoubles = std::vector<double, CacheAligned<double>>;

} // namespace plash
