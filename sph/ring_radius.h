#pragma once

#include "math/lanes.h"

namespace plash {

/// Radius of a ring around the y axis (sph/rings.h) [length]. Rings may touch the axis, where areas and hoop
/// strains would have no bound. x  where it stands, not negative [length]; smoothing  its smoothing length
/// [length]
template <class Lane>
Lane ring_radius(const Lane& x, const Lane& smoothing)
{
    constexpr double least = 0.1; // of the smoothing length; the innermost ring of a lattice stands at 0.4
    return max(x, least * smoothing);
}

/// Mean radius of two rings, by which pairs weigh what is along the axis (sph/rings.h); 0 for an image beyond
/// the axis, which stands at a negative x [length].
template <class Lane>
Lane mean_radius(const Lane& own, const Lane& other)
{
    return other < Lane{} ? Lane{} : 0.5 * (own + other);
}

} // namespace plash
