#pragma once

#include "elements/solid_modes.h"
#include "math/tensor3.h"

#include <array>

namespace plash {

/// Which gradient operator a one-point hexahedron has. They are the same for parallelepipeds.
enum class SolidGradientRule {
    centre, ///< derivatives at the centre, volume = 8 |J(0)| (Goudreau & Hallquist 1982): the cheap one
    mean,   ///< exact volume and its derivatives (Flanagan & Belytschko 1981): passes the patch test
};

/// Volume of a hexahedron with its derivatives by the modes of the positions:
/// B_a = dV/dx_a = 1/64 (sum of pattern(a) linear[i] + sum of pattern(a) bilinear[i]) over the patterns of
/// SolidModes; the fourth hourglass pattern does not enter the volume.
template <class Lane, SolidGradientRule rule>
struct SolidGradient {
    static constexpr bool mean = rule == SolidGradientRule::mean;
    Vector3<Lane> linear[3];
    std::array<Vector3<Lane>, mean ? 3 : 0> bilinear;
    Lane volume; ///< [volume]
};

template <SolidGradientRule rule, class Lane>
inline SolidGradient<Lane, rule> gradient_of(const SolidModes<Lane>& x)
{
    const auto& s = x.linear;
    const Vector3<Lane> s12 = cross(s[1], s[2]), s20 = cross(s[2], s[0]), s01 = cross(s[0], s[1]);
    if constexpr (rule == SolidGradientRule::centre) {
        return {{s12, s20, s01}, {}, (1.0 / 64) * dot(s[0], s12)};
    } else {
        // 64 V = s0.(s1 x s2) + 1/3 (s0.(g2 x g1) + s1.(g0 x g2) + s2.(g1 x g0)), from the Jacobian
        // determinant integrated term by term; odd powers and the trilinear pattern drop out.
        const Lane third = broadcast<Lane>(1.0 / 3);
        const auto& g = x.hourglass;
        const Vector3<Lane> g0 = third * g[0], g1 = third * g[1], g2 = third * g[2];
        const Vector3<Lane> b0 = s12 + cross(g[2], g1), c1 = cross(g[0], g2), c2 = cross(g[1], g0);
        return {{b0, s20 + c1, s01 + c2},
                {cross(s[2], g1) + cross(g2, s[1]), cross(g0, s[2]) + cross(s[0], g2),
                 cross(s[1], g0) + cross(g1, s[0])},
                (1.0 / 64) * (dot(s[0], b0) + dot(s[1], c1) + dot(s[2], c2))};
    }
}

/// Volume times the gradient of a corner field: V L_ij = sum over corners v_ai B_aj.
template <class Lane, SolidGradientRule rule>
inline Tensor3<Lane> volume_gradient(const SolidGradient<Lane, rule>& b, const SolidModes<Lane>& v)
{
    Tensor3<Lane> sum;
    for (int i = 0; i < 3; ++i) sum.add_dyad(v.linear[i], b.linear[i]);
    for (std::size_t i = 0; i < b.bilinear.size(); ++i) sum.add_dyad(v.hourglass[i], b.bilinear[i]);
    return broadcast<Lane>(1.0 / 64) * sum;
}

/// Modal forces of a stress that may be unsymmetric: component i of corner a is sum over j of B_aj m_ij.
template <class Lane, SolidGradientRule rule>
inline SolidModes<Lane> stress_divergence(const SolidGradient<Lane, rule>& b, const Tensor3<Lane>& m)
{
    const Tensor3<Lane> scaled = broadcast<Lane>(1.0 / 64) * m;
    if constexpr (rule == SolidGradientRule::centre) {
        return {{scaled * b.linear[0], scaled * b.linear[1], scaled * b.linear[2]}, {}};
    } else {
        return {{scaled * b.linear[0], scaled * b.linear[1], scaled * b.linear[2]},
                {scaled * b.bilinear[0], scaled * b.bilinear[1], scaled * b.bilinear[2], {}}};
    }
}

/// Square of the area of the largest face, where the area of a quadrilateral is half the cross product of
/// its diagonals [area^2].
template <class Lane>
inline Lane largest_face_squared(const SolidModes<Lane>& x)
{
    const auto face_pair = [&](int p, int q) {
        // On the two faces across the third axis the diagonals are 1/4 (u + w) and 1/4 (u - w), where u and w
        // are sums over the edges along p and q.
        const auto& g = x.hourglass;
        const Vector3<Lane> up = x.linear[p] + g[q], um = x.linear[p] - g[q];
        const Vector3<Lane> wp = x.linear[q] + g[p], wm = x.linear[q] - g[p];
        const Vector3<Lane> front = cross(up, wp), back = cross(um, wm);
        return max(dot(front, front), dot(back, back));
    };
    return (1.0 / 256) * max(face_pair(0, 1), max(face_pair(1, 2), face_pair(2, 0)));
}

} // namespace plash
