#pragma once

#include "elements/corner_access.h"

namespace plash {

/// Eight corner vectors of a hexahedron written as sums over sign patterns (a Walsh-Hadamard transform of
/// the corners without the plain sum): `linear[i]` along the natural axis i, `hourglass` with the patterns of
/// the four hourglass base vectors. Positions, velocities and forces of an element are worked on in this
/// form, which makes strain operator and hourglass control short and the mid-step geometry almost free.
///
/// Patterns over the corners in LS-DYNA's numbering, with natural coordinates (a, b, c) = -1 or 1 of a
/// corner:
///   linear[0..2] = a, b, c     hourglass[0..3] = b c, c a, a b, a b c
template <class Lane>
struct SolidModes {
    Vector3<Lane> linear[3];
    Vector3<Lane> hourglass[4];
};

/// Modes of eight corner vectors: 23 additions a component.
template <class Lane>
inline SolidModes<Lane> modes_of(const Vector3<Lane> (&c)[8])
{
    const auto sum01 = c[0] + c[1], sum32 = c[3] + c[2], sum45 = c[4] + c[5], sum76 = c[7] + c[6];
    const auto step01 = c[1] - c[0], step32 = c[2] - c[3], step45 = c[5] - c[4], step76 = c[6] - c[7];
    const auto low = sum01 + sum32, high = sum45 + sum76;
    const auto low_b = sum32 - sum01, high_b = sum76 - sum45;
    const auto low_a = step01 + step32, high_a = step45 + step76;
    const auto low_ab = step32 - step01, high_ab = step76 - step45;
    return {{low_a + high_a, low_b + high_b, high - low},
            {high_b - low_b, high_a - low_a, low_ab + high_ab, high_ab - low_ab}};
}

/// Corner forces of modal forces, handed to take(corner, force): what does the same work on any corner
/// velocities as the modal forces do on the modes of those velocities.
template <class Lane, class Take>
inline void for_corners(const SolidModes<Lane>& modes, Take&& take)
{
    const auto& [a, b, c] = modes.linear;
    const auto& [bc, ca, ab, abc] = modes.hourglass;
    const auto low_a = a - ca, high_a = a + ca;
    const auto low_b = b - bc, high_b = b + bc;
    const auto low_ab = ab - abc, high_ab = ab + abc;
    const auto near_low = low_a - low_ab, far_low = low_a + low_ab;
    const auto near_high = high_a - high_ab, far_high = high_a + high_ab;
    const auto sum01 = c + low_b, sum32 = low_b - c, sum45 = c - high_b, sum76 = c + high_b;
    take(0, -(sum01 + near_low));
    take(1, near_low - sum01);
    take(2, sum32 + far_low);
    take(3, sum32 - far_low);
    take(4, sum45 - near_high);
    take(5, sum45 + near_high);
    take(6, sum76 + far_high);
    take(7, sum76 - far_high);
}

/// a + factor b, mode by mode.
template <class Lane>
inline SolidModes<Lane> moved(const SolidModes<Lane>& a, double factor, const SolidModes<Lane>& b)
{
    const Lane scale = broadcast<Lane>(factor);
    const auto at = [&](const Vector3<Lane>& start, const Vector3<Lane>& way) { return start + scale * way; };
    return {{at(a.linear[0], b.linear[0]), at(a.linear[1], b.linear[1]), at(a.linear[2], b.linear[2])},
            {at(a.hourglass[0], b.hourglass[0]), at(a.hourglass[1], b.hourglass[1]),
             at(a.hourglass[2], b.hourglass[2]), at(a.hourglass[3], b.hourglass[3])}};
}

} // namespace plash
