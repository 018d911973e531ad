#pragma once

#include "elements/hourglass_solid.h"

namespace plash {

/// Where IHQ 7 keeps what it knows of the start: the shares of the linear modes in the hourglass modes take
/// the place of the hourglass forces in the history (mode x linear mode), the lengths stand behind the
/// constants of the material point.
inline constexpr int total_hourglass_constants = 3;

/// Shares c of the linear modes P in the hourglass modes H at the start, H = sum of c P: what any linear
/// deformation F keeps, since F H = sum of c F P.
template <class Lane>
inline void start_total_hourglass(const SolidModes<Lane>& position, Lane* shares, Lane* lengths)
{
    const auto& p = position.linear;
    const Vector3<Lane> dual[3] = {cross(p[1], p[2]), cross(p[2], p[0]), cross(p[0], p[1])};
    const Lane inverse = 1.0 / dot(p[0], dual[0]);
    for (int mode = 0; mode < 4; ++mode)
        for (int i = 0; i < 3; ++i) shares[3 * mode + i] = inverse * dot(dual[i], position.hourglass[mode]);
    const Vector3<Lane> length = modal_lengths(position, element_axes(position));
    lengths[0] = length.x;
    lengths[1] = length.y;
    lengths[2] = length.z;
}

/// What the total form gives: energy, and the forces on the modes with it.
template <class Lane>
struct TotalHourglass {
    Lane energy;            ///< [energy]
    SolidModes<Lane> force; ///< on the corners, as modes [force]
};

/// IHQ 7: type 6 for the whole hourglass displacement since the start in place of its rates (LS-DYNA keyword
/// manual, *HOURGLASS; the assumed strain field of Belytschko & Bindeman 1993, eq. 70 to 78). The
/// displacement of a mode is what its place h has beyond the linear deformation of the element, q = h - sum
/// of c p: no rigid or linear motion of any size has one. In the element's own axes A it stores the energy W
/// = 1/2 Aq . S Aq with the stiffness S of the shape at the start. The forces are the derivative of W by the
/// places of the corners, the turning of the axes with them included (the last lines below), so that they
/// keep momentum, angular momentum and energy, and an element that comes back has lost nothing. Not inlined:
/// other forms should not carry its code.
template <class Lane>
[[gnu::noinline]] inline TotalHourglass<Lane> total_hourglass(const SolidHourglass& control,
                                                              const SolidModes<Lane>& position,
                                                              const Lane* shares, const Lane* lengths)
{
    const auto& p = position.linear;
    const Tensor3<Lane> axes = element_axes(position);
    const HourglassVectors<Lane> q = each_hourglass_mode([&](int mode) {
        const Lane* c = shares + 3 * mode;
        return position.hourglass[mode] - (c[0] * p[0] + c[1] * p[1] + c[2] * p[2]);
    });
    const Vector3<Lane> length{lengths[0], lengths[1], lengths[2]};
    const HourglassVectors<Lane> gradient = assumed_strain_stiffness(control, axes, length, q, 1.0);
    TotalHourglass<Lane> result{};
    Vector3<Lane> turning{}; // moment on the axes
    for (int mode = 0; mode < 4; ++mode) {
        const Lane* c = shares + 3 * mode;
        result.energy += 0.5 * dot(gradient[mode], q[mode]);
        turning += cross(q[mode], gradient[mode]);
        result.force.hourglass[mode] = -gradient[mode];
        for (int i = 0; i < 3; ++i) result.force.linear[i] += c[i] * gradient[mode];
    }
    // The axes turn with p[0] and, about their first, with p[1]: dW = ... - turning . (angle of the axes).
    const Vector3<Lane> first{axes.xx, axes.xy, axes.xz}, second{axes.yx, axes.yy, axes.yz},
        third{axes.zx, axes.zy, axes.zz};
    const Lane inverse_first = 1.0 / dot(first, p[0]), inverse_second = 1.0 / dot(second, p[1]);
    const Lane about_first = dot(turning, first) * inverse_second;
    result.force.linear[0] +=
        (dot(turning, third) * inverse_first) * second -
        ((dot(turning, second) + about_first * dot(first, p[1])) * inverse_first) * third;
    result.force.linear[1] += about_first * third;
    return result;
}

} // namespace plash
