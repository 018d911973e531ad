#pragma once

#include "math/vector3.h"

namespace plash {

/// What every pair loop needs of a particle: one cache line, by sorted place.
struct alignas(64) MotionRecord {
    Vec3 position;     ///< at n [length]
    double smoothing;  ///< h [length]
    Vec3 velocity;     ///< at n - 1/2 [velocity]
    double weight = 0; ///< mass, or volume mass / density for the volume-weighted forms [mass] or [volume]
};
static_assert(sizeof(MotionRecord) == 64);

} // namespace plash
