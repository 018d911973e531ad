#include "math/aligned.h"

#include <sys/mman.h>

namespace plash {

namespace {

constexpr std::size_t line = 64, huge_page = std::size_t{1} << 21;

std::align_val_t alignment_of(std::size_t bytes)
{
    return std::align_val_t{bytes >= 2 * huge_page ? huge_page : line};
}

} // namespace

void* allocate_aligned(std::size_t bytes)
{
    void* memory = ::operator new(bytes, alignment_of(bytes));
    if (bytes >= 2 * huge_page) madvise(memory, bytes, MADV_HUGEPAGE); // a refusal costs speed alone
    return memory;
}

void free_aligned(void* memory, std::size_t bytes)
{
    ::operator delete(memory, alignment_of(bytes));
}

} // namespace plash
