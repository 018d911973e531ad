#pragma once

#include "math/lanes.h"
#include "sph/particle_arrays.h"
#include "sph/ring_radius.h"

#include <algorithm>

/// Axisymmetric bodies (*CONTROL_SPH IDIM = -2): a particle is a ring around the y axis at the radius x. All
/// that bodies sum (mass, force, energy) is by radian. Pairs are weighed by the areas A = m / (r rho) that
/// rings have in the plane, and rates of strain are those of the plane, divided by M, besides the hoop strain
/// v_x / r, which laws see as the zz component; those of v_y are weighed by (r_i + r_j) / (2 r_i), as the
/// forces along y are. With sigma the stress, the force on a ring is
///     F_x = sum of A_i A_j ((r_i sigma_i / M_i + r_j sigma_j / M_j) . grad W)_x - A_i sigma_hoop,
///     F_y = sum of A_i A_j (r_i + r_j) / 2 ((sigma_i / M_i + sigma_j / M_j) . grad W)_y.
/// M_i, half the sum of A_j (x_j - x_i) . grad W, is by how much pair sums give the gradient of a linear
/// field right: 1 in a lattice, a few percent less in a flow. Without it a uniform pressure p would press
/// outwards with p A of the hoop and inwards with M p A of the pairs, and a flow without divergence would
/// spread by v_x / r and close by M v_x / r. Where gradients are corrected by tensors, M is 1.
///
/// Beyond the axis stand images with negative radii: r sigma goes on through the axis as it is, an odd
/// function, and the pressure of a fluid at rest holds its innermost ring as well as all others. F_y leaves
/// these images out, which keeps the momentum along the axis to round-off; their share is of second order in
/// r_i - r_j. (The density of rings: Petschek & Libersky 1993; why sums need help at the axis: Garcia-Senz et
/// al. 2009.)
namespace plash {

inline double ring_radius(const MotionRecord& motion)
{
    return ring_radius(motion.position.x, motion.smoothing);
}

/// The longest step that a ring allows times the speed of sound [length]: that of a particle in the plane,
/// its smoothing length, or less near the axis. A ring that alone moves to and fro is held by its own hoop
/// with the frequency c / r and by its neighbours, which add up to a third of that.
template <class Lane>
Lane ring_size(const Lane& radius, const Lane& smoothing)
{
    return min(1.5 * radius, smoothing);
}

/// M from its sum; a ring with few neighbours keeps gradients that are too small [-].
inline double ring_moment(double sum)
{
    constexpr double least = 0.7; // half at a free surface
    return std::max(sum, least);
}

/// Whether the particles of a body are rings.
inline bool are_rings(const ParticleArrays& arrays)
{
    return !arrays.first_radius.empty();
}

/// Rate of the hoop strain in the middle of the step that ends now [1/time]. half_step: half of it [time]
inline double hoop_rate(const MotionRecord& motion, double half_step)
{
    MotionRecord middle = motion;
    middle.position.x -= half_step * motion.velocity.x;
    return motion.velocity.x / ring_radius(middle);
}

} // namespace plash
