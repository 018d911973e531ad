#pragma once

#include <cstdint>
#include <sys/mman.h>
#include <vector>

namespace plash {

/// Asks the system for large pages behind a long array that has just been reserved: filling it for the first
/// time then costs a few hundred interruptions in place of a hundred thousand.
template <class T>
void use_large_pages(const std::vector<T>& array)
{
    constexpr std::uintptr_t page = 2 << 20;
    const auto address = reinterpret_cast<std::uintptr_t>(array.data());
    const std::uintptr_t begin = (address + page - 1) / page * page;
    const std::uintptr_t end = (address + array.capacity() * sizeof(T)) / page * page;
    if (begin + page <= end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

} // namespace plash
