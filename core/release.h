#pragma once

#include <vector>

namespace plash {

/// Empties a vector and gives its memory back, which assigning {} does not.
template <class Value, class Allocator>
void release(std::vector<Value, Allocator>& values)
{
    std::vector<Value, Allocator>().swap(values);
}

} // namespace plash
