#pragma once

#include "elements/bulk_viscosity.h"
#include "elements/hourglass_total.h"
#include "materials/history.h"
#include "math/lane_roots.h"

#include <variant>

namespace plash {

/// What one element group has in common.
struct SolidParameters {
    double density = 0;       ///< reference [mass/volume]
    double length_factor = 1; ///< characteristic length of the step over volume / largest face (3 for tets)
    BulkViscosity viscosity;
    SolidHourglass hourglass;
};

/// Where a solid's variables stand in its history, before those of its material point. Energies are those of
/// the whole element [energy].
enum SolidHistory : int {
    stress_history,          ///< 6 components
    viscosity_history = 6,   ///< bulk viscosity pressure [stress]
    internal_energy_history, ///< elastic, plastic and bulk viscosity
    hourglass_energy_history,
    hourglass_history, ///< 4 modes x 3 components [force]; of IHQ 7: shares, which stay
    point_history = hourglass_history + 12,
};

/// Constants of an element, before those of its material point.
enum SolidConstant : int {
    inverse_volume_constant, ///< 1 / reference volume
    mass_constant,           ///< without mass scaling [mass]
    point_constants,
};

/// How a batch of material points has moved over the last step.
template <class Lane>
struct SolidMotion {
    SymmetricTensor<Lane> increment; ///< strain of the step, in the axes of its end [-]
    Tensor3<Lane> rotation;          ///< of the material over the step
    Lane relative_volume;            ///< volume over reference volume, now
    Lane volume_change;              ///< of the relative volume over the step
    Lane change_at_start;            ///< the same as the forces of the start have worked along it,
    Lane change_at_end;              ///< and as those of the end have
    Lane viscous_work;               ///< of bulk viscosity in this step, by reference volume [stress]
    Lane energy_density; ///< internal energy over reference volume, before the step at first [stress]
    double time_step;    ///< [time]
    const SolidModes<Lane>& position;
    const Lane* constants; ///< of the material point
};

/// What a batch of elements gives back besides its history.
template <class Lane>
struct SolidVote {
    Lane stable_step;        ///< [time]
    Lane viscous_work;       ///< of bulk viscosity in this step [energy]
    MaskOf<Lane> inverted{}; ///< volume is not positive
    MaskOf<Lane> failed{};   ///< the material has failed
};

template <class Lane>
struct SolidResult {
    SolidModes<Lane> force; ///< on the corners, as modes [force]
    SolidVote<Lane> vote;
};

/// What a material point finds out of a motion once, for wave modulus and stress: point.see(motion), where it
/// has that.
template <class Point, class Lane>
inline auto seen_by(const Point& point, const SolidMotion<Lane>& motion)
{
    if constexpr (requires { point.see(motion); }) {
        return point.see(motion);
    } else {
        return std::monostate{};
    }
}
template <class Point, class Lane, class Seen>
inline Lane wave_modulus_of(const Point& point, const SolidMotion<Lane>& motion, HistoryView<Lane> history,
                            const Seen& seen)
{
    if constexpr (requires { point.see(motion); }) {
        return point.wave_modulus(seen);
    } else {
        return point.wave_modulus(motion, history);
    }
}
template <class Point, class Lane, class Seen>
inline void update_point(const Point& point, SymmetricTensor<Lane>& stress, HistoryView<Lane> history,
                         const SolidMotion<Lane>& motion, const Seen& seen)
{
    if constexpr (requires { point.see(motion); }) {
        point.update(stress, history, motion, seen);
    } else {
        point.update(stress, history, motion);
    }
}

/// Relative volume of a batch as a mean over its neighbours, which takes the place of its own in the law.
template <class Lane>
struct AveragedVolume {
    Lane now, before; ///< at the ends of the step
};

/// Gives a motion another volume; `strain` is the volume strain of the step that it has.
template <class Lane>
inline void replace_volume(SolidMotion<Lane>& motion, const Lane& strain,
                           const AveragedVolume<Lane>& averaged)
{
    const Lane change = averaged.now - averaged.before;
    const Lane more = (2.0 / 3) * change / (averaged.now + averaged.before) - (1.0 / 3) * strain;
    motion.increment.xx += more;
    motion.increment.yy += more;
    motion.increment.zz += more;
    motion.relative_volume = averaged.now;
    motion.volume_change = motion.change_at_start = motion.change_at_end = change;
}

/// One step of a batch of one-point solids (Hallquist 2006, 'Solid elements'; Goudreau & Hallquist 1982;
/// Flanagan & Belytschko 1981).
///
/// Strain and rotation are those of the mid-step geometry, so that rigid rotations of any size strain
/// nothing and energy is right to second order; forces are those of the geometry at t_n.
///
/// With an equation of state the energy is the input of the next pressure, and a first cell may expand by
/// tens of per cent in a step. There pressures work as the nodal forces of both ends of the step did, so that
/// what they give to the nodes leaves the cell to round-off (compatible work: Caramana, Burton, Shashkov &
/// Whalen 1998, J. Comput. Phys. 146, 227-262). Force at an end times motion of the nodes is pressure times
/// the rate of the volume there, V'. The volume is a cubic function of time while nodes move on straight
/// lines, so that V' at the start follows from volumes and rates of middle and end:
///   V'(0) = 8 V'(1/2) + 5 V'(1) - 24 (V(1) - V(1/2)).
///
/// point      material point: stress update and wave modulus (elements/solid_points.h)
/// position   at n [length]
/// velocity   at n - 1/2 [velocity]
/// time_step  from n - 1 to n [time]
/// history    SolidHistory and the point's own, in and out
/// constants  SolidConstant and the point's own
/// averaged   AveragedVolume that the law sees in place of the element's own (elements/solid_nodal_volume.h),
/// or none
template <SolidGradientRule rule, class Lane, class Point, class... Averaged>
inline SolidResult<Lane> solid_step(const Point& point, const SolidParameters& parameters,
                                    const SolidModes<Lane>& position, const SolidModes<Lane>& velocity,
                                    double time_step, Lane* history, const Lane* constants,
                                    const Averaged&... averaged)
{
    SolidVote<Lane> vote;
    const Lane step = broadcast<Lane>(time_step);

    // Motion over the step.
    const SolidModes<Lane> middle = moved(position, -0.5 * time_step, velocity);
    const SolidGradient<Lane, rule> b_middle = gradient_of<rule>(middle);
    const SolidGradient<Lane, rule> b = gradient_of<rule>(position);
    vote.inverted = min(b.volume, b_middle.volume) <= 0.0;
    // An element without volume is lost in any case; it goes on with its reference volume.
    const Lane reference_volume = constants[mass_constant] * (1 / parameters.density);
    const Lane volume_middle = vote.inverted ? reference_volume : b_middle.volume;
    const Lane volume = vote.inverted ? reference_volume : b.volume;
    const Lane inverse_both = 1.0 / (volume * volume_middle); // one division for two
    const Lane inverse_volume = inverse_both * volume_middle;
    const Tensor3<Lane> gradient = (inverse_both * volume) * volume_gradient(b_middle, velocity);
    const SymmetricTensor<Lane> strain_rate = symmetric_part(gradient);
    const Lane expansion = trace(strain_rate);
    const Lane relative_volume = volume * constants[inverse_volume_constant];
    const Lane inverse_length = inverse_cube_root(volume);

    const SymmetricTensor<Lane> increment = step * strain_rate; // in the axes of mid-step
    const Vector3<Lane> half_turn = (0.5 * step) * axial_vector(gradient);
    SolidMotion<Lane> motion{turned_half(increment, half_turn),
                             incremental_rotation(half_turn),
                             relative_volume,
                             step * expansion * volume_middle * constants[inverse_volume_constant],
                             {},
                             {},
                             {},
                             history[internal_energy_history] * constants[inverse_volume_constant],
                             time_step,
                             position,
                             constants + point_constants};
    constexpr bool compatible = Point::modulus_changes && sizeof...(Averaged) == 0;
    motion.change_at_start = motion.change_at_end = motion.volume_change;
    if constexpr (compatible) {
        const Tensor3<Lane> end = volume_gradient(b, velocity);
        motion.change_at_end = step * (end.xx + end.yy + end.zz) * constants[inverse_volume_constant];
        motion.change_at_start = 8.0 * motion.volume_change + 5.0 * motion.change_at_end -
                                 24.0 * (volume - volume_middle) * constants[inverse_volume_constant];
    }
    if constexpr (sizeof...(Averaged) > 0) replace_volume(motion, Lane{step * expansion}, averaged...);
    const HistoryView<Lane> point_variables{history + point_history};

    // Bulk viscosity.
    const auto seen = seen_by(point, motion);
    Lane wave_modulus = wave_modulus_of(point, motion, point_variables, seen);
    Lane sound_speed = sqrt((1.0 / parameters.density) * wave_modulus * relative_volume);
    const Lane length = volume * inverse_length * inverse_length;
    const Lane viscosity = parameters.viscosity.pressure(constants[mass_constant] * inverse_volume, length,
                                                         sound_speed, expansion);
    if constexpr (compatible) {
        motion.viscous_work =
            -0.5 * (history[viscosity_history] * motion.change_at_start + viscosity * motion.change_at_end);
        vote.viscous_work = motion.viscous_work * reference_volume;
    } else {
        const Lane mean = 0.5 * (viscosity + history[viscosity_history]);
        motion.viscous_work = -mean * motion.volume_change;
        vote.viscous_work = -mean * step * expansion * volume_middle;
    }
    history[viscosity_history] = viscosity;

    // Stress, and its work by the trapezoidal rule: nodal forces of both ends on the way between them, to
    // second order. The old stress stands in its own place, unturned, as its forces did.
    SymmetricTensor<Lane> stress = tensor_at(history);
    const SymmetricTensor<Lane> stress_before = stress;
    stress = rotated(stress, motion.rotation);
    update_point(point, stress, point_variables, motion, seen);
    if constexpr (Point::can_fail) vote.failed = point.failed(point_variables, motion);
    put_tensor(history, stress);
    Lane work = 0.5 * volume_middle * contract(stress_before + stress, increment);
    if constexpr (compatible) {
        work += (reference_volume / 6.0) *
                (trace(stress_before) * (motion.change_at_start - motion.volume_change) +
                 trace(stress) * (motion.change_at_end - motion.volume_change));
    }
    history[internal_energy_history] += vote.inverted ? Lane{} : work + vote.viscous_work;

    // Stable step.
    if constexpr (Point::modulus_changes) {
        motion.energy_density = history[internal_energy_history] * constants[inverse_volume_constant];
        wave_modulus = wave_modulus_of(point, motion, point_variables, seen);
        sound_speed = sqrt((1.0 / parameters.density) * wave_modulus * relative_volume);
    }
    const Lane crossing = parameters.length_factor * volume / sqrt(largest_face_squared(position));
    vote.stable_step = parameters.viscosity.stable_step(crossing, length, sound_speed, expansion);

    // Forces: stress and viscosity, and what the hourglass forces take out of the linear field.
    Tensor3<Lane> flux{viscosity - stress.xx, -stress.xy, -stress.zx, -stress.xy,
                       viscosity - stress.yy, -stress.yz, -stress.zx, -stress.yz,
                       viscosity - stress.zz};
    const SolidHourglass& control = parameters.hourglass;
    if (control.form == SolidHourglass::Form::none) {
        return {stress_divergence(b, flux), vote};
    }
    if (control.form == SolidHourglass::Form::total_strain) {
        const TotalHourglass<Lane> total =
            total_hourglass(control, position, history + hourglass_history,
                            constants + point_constants + Point::constant_size);
        history[hourglass_energy_history] = total.energy;
        SolidModes<Lane> forces = stress_divergence(b, flux);
        for (int i = 0; i < 3; ++i) forces.linear[i] += total.force.linear[i];
        for (int mode = 0; mode < 4; ++mode) forces.hourglass[mode] += total.force.hourglass[mode];
        return {forces, vote};
    }
    const HourglassVectors<Lane> rate = hourglass_rates(control.orthogonal, middle, velocity, gradient);
    Lane* const stored = history + hourglass_history;
    const HourglassVectors<Lane> old = each_hourglass_mode([&](int mode) {
        const Lane* m = stored + 3 * mode;
        return Vector3<Lane>{m[0], m[1], m[2]};
    });
    const HourglassVectors<Lane> turned =
        each_hourglass_mode([&](int mode) { return motion.rotation * old[mode]; });
    const HourglassVectors<Lane> force =
        hourglass_forces(control,
                         HourglassInput<Lane>{middle, rate, time_step, constants[mass_constant], sound_speed,
                                              wave_modulus, inverse_length, inverse_volume},
                         b, turned);
    Lane power{};
    for (int mode = 0; mode < 4; ++mode) {
        power += dot(old[mode] + force[mode], rate[mode]);
        stored[3 * mode] = force[mode].x;
        stored[3 * mode + 1] = force[mode].y;
        stored[3 * mode + 2] = force[mode].z;
        if (control.orthogonal) flux.add_dyad(inverse_volume * force[mode], position.hourglass[mode]);
    }
    history[hourglass_energy_history] += vote.inverted ? Lane{} : 0.5 * step * power;
    SolidModes<Lane> forces = stress_divergence(b, flux);
    for (int mode = 0; mode < 4; ++mode) forces.hourglass[mode] -= force[mode];
    return {forces, vote};
}

} // namespace plash
