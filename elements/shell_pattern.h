#pragma once

#include "math/lanes.h"
#include "math/vector3.h"

namespace plash {

/// What one-point quadrilaterals need of a nodal field: the differences along both diagonals, which make its
/// gradient at the centre, the hourglass sum f1 - f2 + f3 - f4 and the plain sum.
template <class Lane>
struct CornerPattern {
    Vector3<Lane> diagonal13; ///< f3 - f1
    Vector3<Lane> diagonal24; ///< f4 - f2
    Vector3<Lane> alternating;
    Vector3<Lane> sum;
};

/// Splits a field given at corners 1-4.
template <class Lane>
inline CornerPattern<Lane> pattern_of(const Vector3<Lane>& f1, const Vector3<Lane>& f2,
                                      const Vector3<Lane>& f3, const Vector3<Lane>& f4)
{
    const Vector3<Lane> odd = f1 + f3, even = f2 + f4;
    return {f3 - f1, f4 - f2, odd - even, odd + even};
}

/// Transpose of pattern_of: calls take(corner, force) for corners 0-3 with the forces that the parts of
/// `conjugate` mean.
template <class Lane, class Take>
inline void each_corner(const CornerPattern<Lane>& conjugate, Take&& take)
{
    const Vector3<Lane> odd = conjugate.sum + conjugate.alternating;
    const Vector3<Lane> even = conjugate.sum - conjugate.alternating;
    take(0, odd - conjugate.diagonal13);
    take(1, even - conjugate.diagonal24);
    take(2, odd + conjugate.diagonal13);
    take(3, even + conjugate.diagonal24);
}

/// The co-rotational system of a quadrilateral and its flat geometry in it.
template <class Lane>
struct ShellFrame {
    Vector3<Lane> e1, e2, e3;
    Lane area;                     ///< of the quadrilateral projected on the plane of e1 and e2 [length^2]
    Lane x13, y13, x24, y24;       ///< diagonals from 1 to 3 and from 2 to 4 in the frame [length]
    Lane x_hourglass, y_hourglass; ///< x1 - x2 + x3 - x4 in the frame [length]
    Lane z_hourglass;              ///< the same of the heights: four times the warping [length]

    /// (v . e1, v . e2, v . e3)
    Vector3<Lane> to_local(const Vector3<Lane>& v) const { return {dot(v, e1), dot(v, e2), dot(v, e3)}; }
    Vector3<Lane> to_global(const Vector3<Lane>& v) const { return v.x * e1 + v.y * e2 + v.z * e3; }
};

/// Side from corner 1 to corner 2, which the pattern of positions holds implicitly.
template <class Lane>
inline Vector3<Lane> first_side(const CornerPattern<Lane>& position)
{
    return broadcast<Lane>(0.5) * (position.diagonal13 - position.diagonal24 - position.alternating);
}

/// Frame of Belytschko, Lin & Tsay (1984): e3 normal to both diagonals, e1 the direction of side 1-2 made
/// normal to e3 (Hallquist 2006, 'Co-rotational coordinates'; the frame thus follows side 1-2 and depends on
/// the node order, as LS-DYNA's does unless invariant numbering is asked for).
template <class Lane>
inline ShellFrame<Lane> shell_frame(const CornerPattern<Lane>& position)
{
    ShellFrame<Lane> frame;
    const Vector3<Lane> normal = cross(position.diagonal13, position.diagonal24);
    const Lane one = broadcast<Lane>(1.0);
    const Lane normal_length = sqrt(dot(normal, normal));
    frame.area = 0.5 * normal_length;
    frame.e3 = (one / normal_length) * normal;
    const Vector3<Lane> side = first_side(position);
    const Vector3<Lane> flat = side - dot(side, frame.e3) * frame.e3;
    frame.e1 = (one / sqrt(dot(flat, flat))) * flat;
    frame.e2 = cross(frame.e3, frame.e1);
    frame.x13 = dot(position.diagonal13, frame.e1);
    frame.y13 = dot(position.diagonal13, frame.e2);
    frame.x24 = dot(position.diagonal24, frame.e1);
    frame.y24 = dot(position.diagonal24, frame.e2);
    frame.x_hourglass = dot(position.alternating, frame.e1);
    frame.y_hourglass = dot(position.alternating, frame.e2);
    frame.z_hourglass = dot(position.alternating, frame.e3);
    return frame;
}

/// Square of the characteristic length of *CONTROL_TIMESTEP [length^2]. rule (ISDO):
///   0  area / longest side (triangles, corner 4 = corner 3: twice that),
///   1  area / longest diagonal (triangles: twice the area / longest side),
///   2  the larger of rule 0 and the shortest side.
/// Source: Hallquist (2006), chapter 'Time step control'.
template <class Lane>
inline Lane squared_length(const CornerPattern<Lane>& position, Lane area, int rule)
{
    const Vector3<Lane> side12 = first_side(position);
    const Vector3<Lane> side23 = position.diagonal13 - side12;
    const Vector3<Lane> side41 = position.diagonal24 + side12;
    const Vector3<Lane> side34 = position.diagonal24 - side23;
    const Lane l12 = dot(side12, side12), l23 = dot(side23, side23), l34 = dot(side34, side34);
    const Lane l41 = dot(side41, side41);
    // Sides come from differences, so the missing side of a triangle is zero up to round-off.
    const auto triangle = l34 < 1e-20 * l12;
    const Lane one = broadcast<Lane>(1.0), four = broadcast<Lane>(4.0);
    const Lane numerator = (triangle ? four : one) * area * area;
    const Lane longest_side = max(max(l12, l23), max(l34, l41));
    if (rule == 1) {
        const Lane d13 = dot(position.diagonal13, position.diagonal13);
        const Lane d24 = dot(position.diagonal24, position.diagonal24);
        return numerator / (triangle ? longest_side : max(d13, d24));
    }
    const Lane by_longest_side = numerator / longest_side;
    if (rule == 0) return by_longest_side;
    const Lane shortest_side = min(min(l12, l23), triangle ? l41 : min(l34, l41));
    return max(by_longest_side, shortest_side);
}

} // namespace plash
