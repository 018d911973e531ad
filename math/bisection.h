#pragma once

#include "math/vector3.h"

#include <cstdint>
#include <span>

namespace plash {

/// Orders `order` (positions in `center`) so that runs of `length` items lie in compact boxes: halves along
/// the longest side of the box of the centres, at a multiple of `length`, until one run is left, which is
/// sorted by number (recursive coordinate bisection). Depends on the places alone, not on threads.
void bisect(std::span<std::int32_t> order, std::span<const Vec3> center, std::size_t length);

} // namespace plash
