#pragma once

#include "math/lanes.h"
#include "math/tensor3.h"

#include <array>
#include <cmath>

namespace plash {

inline constexpr int ten_points = 4; ///< integration points of a ten-node tetrahedron

/// What a ten-node tetrahedron takes for the derivative of a nodal field f: linear over the element, with the
/// value E_k = df/dL_k (L barycentric coordinates) at corner b
///   E_k = a f_bk + o f_opposite(bk) + c f_k          for k other than b
///   E_b = d f_b + p (sum of f_bm) + r (sum of the nodes on the edges that do not meet b)
/// with f_bk at the node on edge bk. Only differences E_k - E_0 count.
struct TenNodeRule {
    double edge, opposite, far_corner; ///< a, o, c
    double corner, near, far;          ///< d, p, r
    double corner_mass;                ///< share of a corner in the mass
    double highest, sum;               ///< bounds of the frequency, see stiffest_length
    double edge_mass() const { return (1 - 4 * corner_mass) / 6; }
};

/// ELFORM 16: quadratic displacements, mass by the diagonal of the consistent matrix (Hinton, Rock &
/// Zienkiewicz 1976, Earthq. Engng Struct. Dyn. 4, 245-249): the integrals of N_a^2 of corners and edges are
/// as 3 to 16.
inline constexpr TenNodeRule quadratic_tetrahedron{4, 0, -1, 3, 0, 0, 1. / 36, 60.2, 25.3};

/// ELFORM 17: displacements are linear in twelve tetrahedra around the mean of the edges' nodes, and their
/// gradient is projected onto a linear field over the whole (Thoutireddy, Molinari, Repetto & Ortiz 2002,
/// Int. J. Numer. Meth. Engng 53, 1337-1351, section 3). The least squares are done here for the undeformed
/// element: with
/// the shares v of the parts in its volume (1/8 at corners, 1/16 around the middle) and their centroids L,
/// the value at corner b is 20 times the sum of v (L_b - 1/5) grad f. Mass: that of the parts in quarters,
/// the middle's on the edges.
inline constexpr TenNodeRule composite_tetrahedron{13. / 4, 1. / 2,  -3. / 8, 17. / 8, 1. / 3,
                                                   1. / 12, 1. / 32, 38.8,    9.95};

/// Derivatives of a nodal field by the natural coordinates L_1, L_2, L_3 at the four corners, between which
/// they are linear.
template <class Lane>
struct TenNodeModes {
    Vector3<Lane> at[4][3];

    /// Place of a Gauss point: (5 + 3 sqrt 5) / 20 of its own corner and (5 - sqrt 5) / 20 of the others.
    static constexpr double own = 0.58541019662496845446, other = 0.13819660112501051518;
};

namespace ten_node {

/// Number of the node on the edge between two corners.
inline constexpr int edge_node[4][4] = {{-1, 4, 6, 7}, {4, -1, 5, 8}, {6, 5, -1, 9}, {7, 8, 9, -1}};
/// Of the node on the edge that the edge of a node does not meet.
inline constexpr int opposite_node[10] = {-1, -1, -1, -1, 9, 7, 8, 5, 6, 4};

} // namespace ten_node

template <class Lane>
inline TenNodeModes<Lane> ten_node_modes(const TenNodeRule& rule, const Vector3<Lane> (&f)[10])
{
    const Lane a = broadcast<Lane>(rule.edge), o = broadcast<Lane>(rule.opposite),
               c = broadcast<Lane>(rule.far_corner), d = broadcast<Lane>(rule.corner),
               p = broadcast<Lane>(rule.near), r = broadcast<Lane>(rule.far);
    Vector3<Lane> along[10]; // a f_edge + o f_opposite, by the node of the edge
    Vector3<Lane> all{};
    for (int node = 4; node < 10; ++node) {
        along[node] = a * f[node] + o * f[ten_node::opposite_node[node]];
        all += f[node];
    }
    TenNodeModes<Lane> modes;
    for (int b = 0; b < 4; ++b) {
        Vector3<Lane> e[4], met{};
        for (int k = 0; k < 4; ++k) {
            if (k == b) continue;
            const int edge = ten_node::edge_node[b][k];
            e[k] = along[edge] + c * f[k];
            met += f[edge];
        }
        e[b] = d * f[b] + p * met + r * (all - met);
        for (int k = 0; k < 3; ++k) modes.at[b][k] = e[k + 1] - e[0];
    }
    return modes;
}

/// Transpose of ten_node_modes: nodal forces that do the same work.
template <class Lane>
inline void ten_node_forces(const TenNodeRule& rule, const TenNodeModes<Lane>& modes,
                            Vector3<Lane> (&force)[10])
{
    const Lane a = broadcast<Lane>(rule.edge), o = broadcast<Lane>(rule.opposite),
               c = broadcast<Lane>(rule.far_corner), d = broadcast<Lane>(rule.corner),
               p = broadcast<Lane>(rule.near), r = broadcast<Lane>(rule.far);
    Vector3<Lane> along[10]{}, far{};
    for (Vector3<Lane>& one : force) one = {};
    for (int b = 0; b < 4; ++b) {
        const Vector3<Lane>(&m)[3] = modes.at[b];
        const Vector3<Lane> e[4] = {-(m[0] + m[1] + m[2]), m[0], m[1], m[2]};
        force[b] += d * e[b];
        far += r * e[b];
        const Vector3<Lane> more = (p - r) * e[b]; // on the edges that meet b, beside their share of `far`
        for (int k = 0; k < 4; ++k) {
            if (k == b) continue;
            const int edge = ten_node::edge_node[b][k];
            along[edge] += e[k];
            force[k] += c * e[k];
            force[edge] += more;
        }
    }
    for (int node = 4; node < 10; ++node)
        force[node] += far + a * along[node] + o * along[ten_node::opposite_node[node]];
}

template <class Lane>
inline TenNodeModes<Lane> moved(const TenNodeModes<Lane>& a, double factor, const TenNodeModes<Lane>& b)
{
    TenNodeModes<Lane> result;
    for (int corner = 0; corner < 4; ++corner)
        for (int k = 0; k < 3; ++k)
            result.at[corner][k] = a.at[corner][k] + broadcast<Lane>(factor) * b.at[corner][k];
    return result;
}

/// The derivatives at an integration point.
template <class Lane>
struct TenNodePoint {
    Vector3<Lane> by[3];
};

template <class Lane>
inline std::array<TenNodePoint<Lane>, ten_points> ten_node_points(const TenNodeModes<Lane>& modes)
{
    using Modes = TenNodeModes<Lane>;
    std::array<TenNodePoint<Lane>, ten_points> points;
    const Lane other = broadcast<Lane>(Modes::other), more = broadcast<Lane>(Modes::own - Modes::other);
    for (int k = 0; k < 3; ++k) {
        const Vector3<Lane> sum = other * (modes.at[0][k] + modes.at[1][k] + modes.at[2][k] + modes.at[3][k]);
        for (int q = 0; q < ten_points; ++q) points[q].by[k] = sum + more * modes.at[q][k];
    }
    return points;
}

/// Transpose of ten_node_points.
template <class Lane>
inline TenNodeModes<Lane> modes_of_points(const std::array<TenNodePoint<Lane>, ten_points>& points)
{
    using Modes = TenNodeModes<Lane>;
    TenNodeModes<Lane> modes;
    const Lane other = broadcast<Lane>(Modes::other), more = broadcast<Lane>(Modes::own - Modes::other);
    for (int k = 0; k < 3; ++k) {
        const Vector3<Lane> sum =
            other * (points[0].by[k] + points[1].by[k] + points[2].by[k] + points[3].by[k]);
        for (int b = 0; b < 4; ++b) modes.at[b][k] = sum + more * points[b].by[k];
    }
    return modes;
}

/// Jacobian at a point: its volume and six times the volume times the gradients of L_1, L_2, L_3.
template <class Lane>
struct TenNodeJacobian {
    Vector3<Lane> cofactor[3];
    Lane volume; ///< that belongs to the point [volume]
};

template <class Lane>
inline TenNodeJacobian<Lane> jacobian_of(const TenNodePoint<Lane>& x)
{
    const Vector3<Lane> c = cross(x.by[1], x.by[2]);
    return {{c, cross(x.by[2], x.by[0]), cross(x.by[0], x.by[1])}, (1.0 / 24) * dot(x.by[0], c)};
}

/// Square of 2 / (largest frequency times the speed of compression waves), from below [length^2].
///
/// An element alone vibrates with w^2 <= c^2 min(highest max |grad L_a|^2, sum times the sum of |grad
/// L_a|^2); both numbers were found by power iteration over thousands of straight and curved tetrahedra with
/// nu from 0 to 0.499 (docs/theory/elements.md). A point that has more than its quarter of the volume counts
/// more.
template <class Lane>
inline Lane stiffest_length_squared(const TenNodeRule& rule,
                                    const std::array<TenNodeJacobian<Lane>, ten_points>& points,
                                    const Lane& inverse_volume)
{
    Lane highest{}, sum{};
    for (const TenNodeJacobian<Lane>& point : points) {
        const Vector3<Lane>(&g)[3] = point.cofactor;
        const Vector3<Lane> first = g[0] + g[1] + g[2];
        const Lane s0 = dot(first, first), s1 = dot(g[0], g[0]), s2 = dot(g[1], g[1]), s3 = dot(g[2], g[2]);
        // |grad L|^2 = |g|^2 / (24 v)^2, times v / (V / 4)
        const Lane weight = (4.0 / 576) * inverse_volume / point.volume;
        highest = max(highest, weight * max(max(s0, s1), max(s2, s3)));
        sum = max(sum, weight * (s0 + s1 + s2 + s3));
    }
    return 4.0 / min(rule.highest * highest, rule.sum * sum);
}

} // namespace plash
