#pragma once

#include <vector>

namespace plash {

/// Empties a vector and gives its memory back, which assigning {} does not.
template <class Value, class Allocator>
void release(std::vector<Value, Allocator>& values)
{
    std::vector<Value, Allocator>().swap(values);
}

/// Gives the gaps that freed blocks have left between others back to the system, where the library can. Takes
/// about a millisecond for 100 MB.
void give_gaps_back();

} // namespace plash
