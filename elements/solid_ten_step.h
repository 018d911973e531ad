#pragma once

#include "elements/solid_eight_step.h"
#include "elements/ten_node_tetrahedron.h"

namespace plash {

/// History of one point: stress and what the law has.
template <class Point>
inline constexpr int ten_point_size = 6 + Point::history_size;

/// Where the points of a ten-node tetrahedron begin in its history; before them the mean stress, the
/// energies, and the mean plastic strain.
inline constexpr int first_ten_point = point_history + 1;

/// Constants of a ten-node tetrahedron before those of its points: reference volumes of the points.
inline constexpr int ten_point_constants = point_constants + ten_points;

template <class Lane>
struct TenNodeResult {
    TenNodeModes<Lane> force; ///< on the modes [force]
    SolidVote<Lane> vote;
};

/// A tetrahedron with straight edges that has the Jacobian of a point, for laws that ask where the element
/// is.
template <class Lane>
inline SolidModes<Lane> tetrahedron_of(const TenNodePoint<Lane>& x)
{
    const Vector3<Lane> a{}, b = x.by[0], c = x.by[1], d = x.by[2];
    return modes_of<Lane>({a, b, c, c, d, d, d, d});
}

/// One step of a batch of ten-node tetrahedra with four points. With the deformation gradient of a point
/// F = J J_0^-1, nodal forces are the derivative of the sum of point volumes times energy densities, on
/// curved and deformed elements too. The bulk viscosity acts on the mean volume strain with half the cube
/// root of the volume for its length, as the nodes are twice as dense as the elements.
///
/// position, velocity  modes of the nodes; else as solid_step
/// history    SolidHistory with the mean stress, mean plastic strain, then the points
/// constants  SolidConstant, reference volumes of the points, then Point::constant_size for each point
template <class Lane, class Point>
inline TenNodeResult<Lane> ten_point_step(const Point& point, const SolidParameters& parameters,
                                          const TenNodeRule& rule, const TenNodeModes<Lane>& position,
                                          const TenNodeModes<Lane>& velocity, double time_step, Lane* history,
                                          const Lane* constants)
{
    TenNodeResult<Lane> result;
    SolidVote<Lane>& vote = result.vote;
    const Lane step = broadcast<Lane>(time_step);
    const std::array<TenNodePoint<Lane>, ten_points> x = ten_node_points(position),
                                                     v = ten_node_points(velocity),
                                                     middle = ten_node_points(
                                                         moved(position, -0.5 * time_step, velocity));

    // Gradients in the middle of the step, geometry at its end.
    std::array<TenNodeJacobian<Lane>, ten_points> now;
    Tensor3<Lane> gradient[ten_points];
    Lane volume_middle[ten_points];
    Lane volume{}, total_middle{}, swelling{};
    for (int q = 0; q < ten_points; ++q) {
        const TenNodeJacobian<Lane> b = jacobian_of(middle[q]);
        now[q] = jacobian_of(x[q]);
        const Lane reference = constants[point_constants + q];
        const MaskOf<Lane> inverted = min(b.volume, now[q].volume) <= 0.0;
        vote.inverted |= inverted;
        volume_middle[q] = inverted ? reference : b.volume;
        now[q].volume = inverted ? reference : now[q].volume;
        Tensor3<Lane> sum;
        for (int k = 0; k < 3; ++k) sum.add_dyad(v[q].by[k], b.cofactor[k]);
        gradient[q] = (1.0 / (24.0 * volume_middle[q])) * sum;
        swelling += volume_middle[q] * (gradient[q].xx + gradient[q].yy + gradient[q].zz);
        total_middle += volume_middle[q];
        volume += now[q].volume;
    }
    const Lane expansion = swelling / total_middle, inverse_volume = 1.0 / volume;
    const Lane relative_volume = volume * constants[inverse_volume_constant];
    const Lane inverse_length = inverse_cube_root(volume);
    const Lane length = 0.5 * volume * inverse_length * inverse_length;

    const auto motion_of = [&](int q, const SolidModes<Lane>& place) {
        const Lane inverse_reference = 1.0 / constants[point_constants + q];
        const SymmetricTensor<Lane> increment = step * symmetric_part(gradient[q]);
        const Vector3<Lane> half_turn = (0.5 * step) * axial_vector(gradient[q]);
        const Lane volume_change = trace(increment) * volume_middle[q] * inverse_reference;
        return SolidMotion<Lane>{turned_half(increment, half_turn),
                                 incremental_rotation(half_turn),
                                 now[q].volume * inverse_reference,
                                 volume_change,
                                 volume_change,
                                 volume_change,
                                 {},
                                 history[internal_energy_history] * constants[inverse_volume_constant],
                                 time_step,
                                 place,
                                 constants + ten_point_constants + q * Point::constant_size};
    };
    Lane* const points = history + first_ten_point;
    std::array<decltype(seen_by(point, std::declval<SolidMotion<Lane>>())), ten_points> seen;
    const auto stiffest_wave = [&] {
        Lane modulus{};
        for (int q = 0; q < ten_points; ++q) {
            const SolidModes<Lane> place = tetrahedron_of(x[q]);
            const HistoryView<Lane> variables{points + q * ten_point_size<Point> + 6};
            const SolidMotion<Lane> motion = motion_of(q, place);
            seen[q] = seen_by(point, motion);
            modulus = max(modulus, wave_modulus_of(point, motion, variables, seen[q]));
        }
        return Lane{sqrt((1.0 / parameters.density) * modulus * relative_volume)};
    };
    Lane sound_speed = stiffest_wave();
    const Lane viscosity = parameters.viscosity.pressure(constants[mass_constant] * inverse_volume, length,
                                                         sound_speed, expansion);
    const Lane mean_viscosity = 0.5 * (viscosity + history[viscosity_history]);
    history[viscosity_history] = viscosity;

    // Stresses, their work and forces.
    SymmetricTensor<Lane> mean{};
    Lane plastic_strain{}, work{};
    MaskOf<Lane> failed = volume > 0.0;
    std::array<TenNodePoint<Lane>, ten_points> force;
    for (int q = 0; q < ten_points; ++q) {
        Lane* values = points + q * ten_point_size<Point>;
        const SolidModes<Lane> place = tetrahedron_of(x[q]);
        SolidMotion<Lane> motion = motion_of(q, place);
        motion.viscous_work = -mean_viscosity * motion.volume_change;
        SymmetricTensor<Lane> stress = tensor_at(values);
        const SymmetricTensor<Lane> before = stress;
        stress = rotated(stress, motion.rotation);
        const HistoryView<Lane> variables{values + 6};
        update_point(point, stress, variables, motion, seen[q]);
        if constexpr (Point::can_fail) failed &= point.failed(variables, motion);
        if constexpr (Point::plastic_strain >= 0)
            plastic_strain += (1.0 / ten_points) * variables[Point::plastic_strain];
        put_tensor(values, stress);
        mean = mean + (now[q].volume * inverse_volume) * stress;
        work += 0.5 * volume_middle[q] * contract(before + stress, step * symmetric_part(gradient[q]));
        stress.xx -= viscosity;
        stress.yy -= viscosity;
        stress.zz -= viscosity;
        const SymmetricTensor<Lane> share = broadcast<Lane>(-1.0 / 24) * stress;
        for (int k = 0; k < 3; ++k) force[q].by[k] = times(share, now[q].cofactor[k]);
    }
    result.force = modes_of_points(force);
    if constexpr (Point::can_fail) vote.failed = failed;
    vote.viscous_work = -mean_viscosity * step * swelling;
    history[internal_energy_history] += vote.inverted ? Lane{} : work + vote.viscous_work;
    put_tensor(history, mean);
    history[point_history] = plastic_strain;

    if constexpr (Point::modulus_changes) sound_speed = stiffest_wave();
    const Lane crossing = sqrt(stiffest_length_squared(rule, now, inverse_volume));
    vote.stable_step = parameters.viscosity.stable_step(crossing, length, sound_speed, expansion);
    return result;
}

} // namespace plash
