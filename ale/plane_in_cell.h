#pragma once

#include "math/lanes.h"
#include "math/vector3.h"

/// A plane that cuts the unit cell: which share of the cell lies below it, and where it must stand for a
/// given share. The cell is the unit cube in index space, so that all this holds for any parallelepiped.
/// Source: Scardovelli & Zaleski (2000), J. Comput. Phys. 164, 228-237, equations 15 to 17.
namespace plash {

namespace plane_detail {

/// Smallest component that a normal is taken to have; below, the formulas lose their digits, and the volume
/// changes by less than this.
inline constexpr double smallest_component = 1e-10;

/// Components in ascending order.
template <class Lane>
inline Vector3<Lane> ascending(const Vector3<Lane>& m)
{
    const Lane low = min(m.x, m.y), high = max(m.x, m.y);
    const Lane least = broadcast<Lane>(smallest_component);
    return {max(min(low, m.z), least), max(min(high, max(low, m.z)), least), max(high, m.z)};
}

/// Volume below the plane and its derivative with respect to the distance, for distance <= 1/2 and ascending
/// components that add up to one.
template <class Lane>
struct LowerHalf {
    Lane volume, slope;
};

template <class Lane>
inline LowerHalf<Lane> lower_half(const Vector3<Lane>& m, Lane d)
{
    const Lane m12 = m.x + m.y;
    const Lane product = 1.0 / (6.0 * m.x * m.y * m.z);
    const Lane two = 1.0 / (2.0 * m.y * m.z);
    const Lane squares = m.x * m.x + m.y * m.y;
    const Lane cubes = m.x * m.x * m.x + m.y * m.y * m.y;
    LowerHalf<Lane> result;
    // Corner: a tetrahedron.
    result.volume = d * d * d * product;
    result.slope = 3.0 * d * d * product;
    // The plane has passed the corner of the smallest component.
    const auto beyond_first = d > m.x;
    result.volume = beyond_first ? (d * (d - m.x) + m.x * m.x * (1.0 / 3)) * two : result.volume;
    result.slope = beyond_first ? (2.0 * d - m.x) * two : result.slope;
    const auto beyond_second = d > m.y;
    result.volume =
        beyond_second ? (d * d * (3.0 * m12 - d) + cubes - 3.0 * d * squares) * product : result.volume;
    result.slope = beyond_second ? (3.0 * d * (2.0 * m12 - d) - 3.0 * squares) * product : result.slope;
    // Either a hexagon, or a prism through four parallel edges.
    const auto hexagon = (d > m.z) & (m.z < m12);
    const Lane all_squares = squares + m.z * m.z;
    result.volume =
        hexagon ? (d * d * (3.0 - 2.0 * d) + cubes + m.z * m.z * m.z - 3.0 * d * all_squares) * product
                : result.volume;
    result.slope = hexagon ? (6.0 * d * (1.0 - d) - 3.0 * all_squares) * product : result.slope;
    const auto prism = (d > m12) & (m12 <= m.z);
    result.volume = prism ? (d - 0.5 * m12) / m.z : result.volume;
    result.slope = prism ? 1.0 / m.z : result.slope;
    return result;
}

} // namespace plane_detail

/// Share of the unit cell with normal . x < distance.
/// normal  components >= 0 whose sum is one
template <class Lane>
inline Lane volume_below_plane(const Vector3<Lane>& normal, Lane distance)
{
    const Lane zero{}, one = broadcast<Lane>(1);
    const Lane inside = min(max(distance, zero), one);
    const auto upper = inside > 0.5;
    const Lane near = upper ? 1.0 - inside : inside;
    const Lane volume = plane_detail::lower_half(plane_detail::ascending(normal), near).volume;
    return min(max(upper ? 1.0 - volume : volume, zero), one);
}

/// Distance at which the plane leaves `volume` of the unit cell below it: Newton's method on the lower half,
/// where volume is a convex function of the distance, from the largest of three lower bounds. normal
/// components >= 0 whose sum is one volume  between 0 and 1
template <class Lane>
inline Lane plane_distance(const Vector3<Lane>& normal, Lane volume)
{
    const Vector3<Lane> m = plane_detail::ascending(normal);
    const auto upper = volume > 0.5;
    const Lane target = upper ? 1.0 - volume : volume;
    const Lane corner =
        map_lanes(6.0 * m.x * m.y * m.z * target, [](double cube) { return std::cbrt(cube); });
    Lane d = max(max(corner, sqrt(2.0 * m.y * m.z * target)), m.z * target);
    d = min(d, broadcast<Lane>(0.5));
    for (int iteration = 0; iteration < 20; ++iteration) {
        const auto here = plane_detail::lower_half(m, d);
        const Lane miss = target - here.volume;
        if (!any(abs(miss) > 1e-15 + 1e-13 * target)) break;
        const Lane step = here.slope > 0.0 ? miss / here.slope : Lane{};
        d = min(max(d + step, Lane{}), broadcast<Lane>(0.5));
    }
    return upper ? 1.0 - d : d;
}

/// Share of material in the slab of a cell that leaves through one face, when the material lies below the
/// plane. normal    components >= 0 whose sum is one along     the component along the face's axis start
/// where the slab begins along that axis, 0 at the face on the material's side thickness of the slab, > 0
template <class Lane>
inline Lane share_of_slab(const Vector3<Lane>& normal, Lane distance, int axis, Lane start, Lane thickness)
{
    const Lane along = axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z;
    const Lane squeezed = along * thickness;
    const Lane sum = (1.0 - along) + squeezed;
    const Lane scale = sum > 1e-300 ? 1.0 / sum : Lane{};
    Vector3<Lane> scaled = scale * normal;
    (axis == 0 ? scaled.x : axis == 1 ? scaled.y : scaled.z) = squeezed * scale;
    return volume_below_plane(scaled, (distance - along * start) * scale);
}

} // namespace plash
