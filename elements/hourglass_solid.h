#pragma once

#include "elements/solid_kinematics.h"

namespace plash {

/// Hourglass control of a one-point solid, by *HOURGLASS or *CONTROL_HOURGLASS.
///
/// All forms work on the rates q = (hourglass base vector) . velocities, one vector for each of the four
/// modes, and give one force vector a mode. `orthogonal` takes the linear velocity field out of the base
/// vectors (gamma of Flanagan & Belytschko 1981), so that no rigid or linear motion is resisted whatever the
/// shape of the element.
struct SolidHourglass {
    enum class Form {
        none,
        viscous,        ///< IHQ 1 (plain base vectors), 2 and 3
        stiffness,      ///< IHQ 4 and 5: Flanagan & Belytschko (1981)
        assumed_strain, ///< IHQ 6: Belytschko & Bindeman (1993), ASQBI
        total_strain,   ///< IHQ 7: the same for the whole displacement (elements/hourglass_total.h)
        assumed_rate,   ///< IHQ 6 of fluids: the same field, resisted by their viscosity
    };
    Form form = Form::viscous;
    bool orthogonal = false;
    double coefficient = 0.1; ///< QM
    double shear_modulus = 0; ///< [stress], zero in a fluid; of assumed_rate: viscosity [stress time]
    double poisson_ratio = 0;
};

/// One vector for each hourglass mode.
template <class Lane>
using HourglassVectors = std::array<Vector3<Lane>, 4>;

/// function(0), ... function(3) as an array.
template <class Function>
inline auto each_hourglass_mode(Function&& function)
{
    return std::array{function(0), function(1), function(2), function(3)};
}

/// Rates of the four hourglass modes [velocity].
/// gradient  velocity gradient in the same configuration as `position`
template <class Lane>
inline HourglassVectors<Lane> hourglass_rates(bool orthogonal, const SolidModes<Lane>& position,
                                              const SolidModes<Lane>& velocity, const Tensor3<Lane>& gradient)
{
    return each_hourglass_mode([&](int mode) {
        const Vector3<Lane>& plain = velocity.hourglass[mode];
        return orthogonal ? plain - gradient * position.hourglass[mode] : plain;
    });
}

/// Damping [force/velocity] of the viscous form: QM/4 rho V^(2/3) c (Hallquist 2006, 'Hourglass control').
template <class Lane>
inline Lane hourglass_damping(const SolidHourglass& control, const Lane& mass, const Lane& sound_speed,
                              const Lane& inverse_length)
{
    return (0.25 * control.coefficient) * mass * sound_speed * inverse_length;
}

/// Stiffness [force/length] of the stiffness form: QM/2 times 2 mu B.B / V with base vectors of length one,
/// which are sqrt(8) times shorter than ours (Flanagan & Belytschko 1981, with the shear modulus as in Taylor
/// & Flanagan 1989, PRONTO 3D: with lambda + 2 mu a nearly incompressible rubber would not bend at all, and
/// metals stiffen in plastic flow). Fluids have no mu: theirs is the bulk modulus.
template <class Lane, SolidGradientRule rule>
inline Lane hourglass_stiffness(const SolidHourglass& control, const Lane& wave_modulus,
                                const SolidGradient<Lane, rule>& b, const Lane& inverse_volume)
{
    Lane square =
        dot(b.linear[0], b.linear[0]) + dot(b.linear[1], b.linear[1]) + dot(b.linear[2], b.linear[2]);
    for (const Vector3<Lane>& part : b.bilinear) square += dot(part, part);
    const Lane modulus =
        control.shear_modulus > 0 ? broadcast<Lane>(2 * control.shear_modulus) : wave_modulus;
    // B.B = 8 / 64^2 of the modal square; another 1/8 from the length of the base vectors.
    return (0.5 * control.coefficient / 4096) * modulus * square * inverse_volume;
}

/// Orthonormal axes of an element: the first along the natural axis a, the second in the plane of a and b.
template <class Lane>
inline Tensor3<Lane> element_axes(const SolidModes<Lane>& position)
{
    const Vector3<Lane>& a = position.linear[0];
    const Vector3<Lane> first = (1.0 / sqrt(dot(a, a))) * a;
    const Vector3<Lane> beside = position.linear[1] - dot(position.linear[1], first) * first;
    const Vector3<Lane> second = (1.0 / sqrt(dot(beside, beside))) * beside;
    const Vector3<Lane> third = cross(first, second);
    return {first.x, first.y, first.z, second.x, second.y, second.z, third.x, third.y, third.z};
}

/// Lengths of an element along its own axes, as sums over the corners: 8 times half the edge of a box.
template <class Lane>
inline Vector3<Lane> modal_lengths(const SolidModes<Lane>& position, const Tensor3<Lane>& axes)
{
    const auto& p = position.linear;
    return {axes.xx * p[0].x + axes.xy * p[0].y + axes.xz * p[0].z,
            axes.yx * p[1].x + axes.yy * p[1].y + axes.yz * p[1].z,
            axes.zx * p[2].x + axes.zy * p[2].y + axes.zz * p[2].z};
}

/// Forces of the four modes by the assumed strain field of Belytschko & Bindeman (1993, ASQBI), which bends
/// like an elastic beam when the coefficient is 1 and does not lock in shear or volume.
///
/// axes     of the element; length  of it along them (modal_lengths)
/// way      what the modes have done [length], or their rates where `factor` is the step
template <class Lane>
inline HourglassVectors<Lane> assumed_strain_stiffness(const SolidHourglass& control,
                                                       const Tensor3<Lane>& axes, const Vector3<Lane>& length,
                                                       const HourglassVectors<Lane>& way, double factor)
{
    // H_ii = 1/3 l_j l_k / l_i and H_ij = 1/3 l_k; 1/64 since ways are 8 times the mode's amplitude, twice.
    const double scale = control.coefficient * control.shear_modulus * factor / (64 * 3);
    const double nu = control.poisson_ratio;
    const Vector3<Lane> off = broadcast<Lane>(scale) * length;
    const Lane product = off.x * length.y * length.z;
    const Vector3<Lane> diagonal{product / (length.x * length.x), product / (length.y * length.y),
                                 product / (length.z * length.z)};
    const HourglassVectors<Lane> q = each_hourglass_mode([&](int mode) { return axes * way[mode]; });
    const double bending = 2 / (1 - nu), warping = 2 * (1 + nu) / 3;
    const HourglassVectors<Lane> local{
        Vector3<Lane>{(diagonal.y + diagonal.z) * q[0].x + off.z * q[1].y + off.y * q[2].z,
                      bending * (diagonal.y * q[0].y + nu * off.z * q[1].x),
                      bending * (diagonal.z * q[0].z + nu * off.y * q[2].x)},
        Vector3<Lane>{bending * (diagonal.x * q[1].x + nu * off.z * q[0].y),
                      (diagonal.z + diagonal.x) * q[1].y + off.x * q[2].z + off.z * q[0].x,
                      bending * (diagonal.z * q[1].z + nu * off.x * q[2].y)},
        Vector3<Lane>{bending * (diagonal.x * q[2].x + nu * off.y * q[0].z),
                      bending * (diagonal.y * q[2].y + nu * off.x * q[1].z),
                      (diagonal.x + diagonal.y) * q[2].z + off.y * q[0].x + off.x * q[1].y},
        Vector3<Lane>{warping * diagonal.x * q[3].x, warping * diagonal.y * q[3].y,
                      warping * diagonal.z * q[3].z}};
    return each_hourglass_mode([&](int mode) { return transposed_times(axes, local[mode]); });
}

/// Force increments of the four modes over a step.
template <class Lane>
inline HourglassVectors<Lane> assumed_strain_forces(const SolidHourglass& control,
                                                    const SolidModes<Lane>& position,
                                                    const HourglassVectors<Lane>& rate, double time_step)
{
    const Tensor3<Lane> axes = element_axes(position);
    return assumed_strain_stiffness(control, axes, modal_lengths(position, axes), rate, time_step);
}

/// What hourglass control needs to know of a batch.
template <class Lane>
struct HourglassInput {
    const SolidModes<Lane>& middle;     ///< positions in the middle of the step
    const HourglassVectors<Lane>& rate; ///< hourglass_rates
    double time_step;
    const Lane& mass;
    const Lane& sound_speed;
    const Lane& wave_modulus;
    const Lane& inverse_length; ///< volume^(-1/3)
    const Lane& inverse_volume;
};

/// Force of each mode at the end of the step [force].
/// before  forces at its start, turned with the material
template <class Lane, SolidGradientRule rule>
inline HourglassVectors<Lane> hourglass_forces(const SolidHourglass& control, const HourglassInput<Lane>& in,
                                               const SolidGradient<Lane, rule>& b,
                                               const HourglassVectors<Lane>& before)
{
    if (control.form == SolidHourglass::Form::viscous) {
        const Lane damping = hourglass_damping(control, in.mass, in.sound_speed, in.inverse_length);
        return each_hourglass_mode([&](int mode) { return damping * in.rate[mode]; });
    }
    if (control.form == SolidHourglass::Form::stiffness) {
        const Lane stiffness =
            in.time_step * hourglass_stiffness(control, in.wave_modulus, b, in.inverse_volume);
        return each_hourglass_mode([&](int mode) { return before[mode] + stiffness * in.rate[mode]; });
    }
    if (control.form == SolidHourglass::Form::assumed_rate) {
        return assumed_strain_forces(control, in.middle, in.rate, 1.0);
    }
    const auto change = assumed_strain_forces(control, in.middle, in.rate, in.time_step);
    return each_hourglass_mode([&](int mode) { return before[mode] + change[mode]; });
}

} // namespace plash
