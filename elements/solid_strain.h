#pragma once

#include "elements/solid_kinematics.h"
#include "elements/ten_node_tetrahedron.h"
#include "materials/history.h"

namespace plash {

/// Adds a step to the strains that result files show (STRFLG): the sum of the strain increments of the
/// mid-step geometry, turned with the material like the stress of a law in rate form.
/// gradient  of the velocity in the middle of the step [1/time]
/// strain    six tensor components in global axes, in and out
template <class Lane>
inline void add_strain(const Tensor3<Lane>& gradient, double time_step, Lane* strain)
{
    const Lane step = broadcast<Lane>(time_step);
    const SymmetricTensor<Lane> increment = step * symmetric_part(gradient);
    const Vector3<Lane> half_turn = (0.5 * step) * axial_vector(gradient);
    put_tensor(strain, rotated(tensor_at(strain), incremental_rotation(half_turn)) +
                           turned_half(increment, half_turn));
}

/// Mean velocity gradient of hexahedra, from positions in the middle of the step [1/time].
template <SolidGradientRule rule, class Lane>
inline Tensor3<Lane> mean_gradient(const SolidModes<Lane>& middle, const SolidModes<Lane>& velocity)
{
    const SolidGradient<Lane, rule> b = gradient_of<rule>(middle);
    return (1.0 / b.volume) * volume_gradient(b, velocity);
}

/// The same of ten-node tetrahedra.
template <class Lane>
inline Tensor3<Lane> mean_gradient(const TenNodeModes<Lane>& middle, const TenNodeModes<Lane>& velocity)
{
    const auto x = ten_node_points(middle), v = ten_node_points(velocity);
    Tensor3<Lane> sum;
    Lane volume{};
    for (int q = 0; q < ten_points; ++q) {
        const TenNodeJacobian<Lane> b = jacobian_of(x[q]);
        volume += b.volume;
        for (int k = 0; k < 3; ++k) sum.add_dyad(v[q].by[k], b.cofactor[k]);
    }
    return (1.0 / (24.0 * volume)) * sum; // volume times gradient is a 24th of the dyads at each point
}

} // namespace plash
