#pragma once

#include "math/lanes.h"
#include "math/vector3.h"

#include <array>

namespace plash {

/// Where on a segment the point closest to a node lies.
enum class Feature { inside = 0, edge = 1, corner = 5 };

/// The closest point of a segment: p(s, t) = a + s (b - a) + t (d - a) + s t (a - b + c - d) with 0 <= s, t
/// <= 1 for a quadrilateral (bilinear, so warped ones are smooth), and p = a + s (b - a) + t (c - a) with s +
/// t <= 1 for a triangle a b c c.
template <class Lane>
struct ClosestPoint {
    Lane s{}, t{};
    Vector3<Lane> offset; ///< from the closest point to the node [length]
    Lane distance2{};     ///< [length^2]
    Lane feature{};       ///< 0 inside, 1..4 edge from corner (feature - 1), 5..8 corner (feature - 5)
};

/// Corners of a segment, a lane each.
template <class Lane>
struct SegmentCorners {
    Vector3<Lane> a, b, c, d;
};

namespace detail {

template <class Lane>
struct EdgePoint {
    Lane along;
    Vector3<Lane> offset;
    Lane distance2;
};

template <class Lane>
inline EdgePoint<Lane> closest_on_edge(const Vector3<Lane>& x, const Vector3<Lane>& from,
                                       const Vector3<Lane>& to)
{
    const Vector3<Lane> edge = to - from, reach = x - from;
    const Lane length2 = max(dot(edge, edge), broadcast<Lane>(1e-300));
    const Lane zero{}, one = broadcast<Lane>(1);
    const Lane along = min(max(dot(reach, edge) / length2, zero), one);
    const Vector3<Lane> offset = reach - along * edge;
    return {along, offset, dot(offset, offset)};
}

} // namespace detail

/// Closest point of the segment to x. Inside by Newton's method for the foot of the perpendicular (exact in
/// one iteration on flat parallelograms and triangles, quadratic on others), else the nearest of the straight
/// edges.
template <class Lane>
inline ClosestPoint<Lane> closest_point(const Vector3<Lane>& x, const SegmentCorners<Lane>& q)
{
    const Lane zero{}, one = broadcast<Lane>(1);
    const Vector3<Lane> last = q.d - q.c;
    const auto triangle = dot(last, last) == zero;
    const Vector3<Lane> e1 = q.b - q.a, e2 = q.d - q.a;
    Vector3<Lane> twist = (q.a - q.b) + (q.c - q.d);
    twist.x = triangle ? zero : twist.x;
    twist.y = triangle ? zero : twist.y;
    twist.z = triangle ? zero : twist.z;
    const Vector3<Lane> reach = x - q.a;

    Lane s = broadcast<Lane>(0.5), t = s;
    const Lane settled = broadcast<Lane>(1e-12);
    for (int iteration = 0; iteration < 4; ++iteration) {
        const Vector3<Lane> along_s = e1 + t * twist, along_t = e2 + s * twist;
        const Vector3<Lane> rest = reach - s * e1 - t * along_t;
        const Lane g1 = dot(rest, along_s), g2 = dot(rest, along_t);
        const Lane h11 = dot(along_s, along_s), h22 = dot(along_t, along_t);
        const Lane plain = dot(along_s, along_t), newton = plain - dot(rest, twist);
        // Far from a warped segment the full Hessian is not definite: fall back on Gauss-Newton there.
        const Lane floor = 0.05 * h11 * h22;
        const Lane h12 = h11 * h22 - newton * newton > floor ? newton : plain;
        const Lane inverse = one / max(h11 * h22 - h12 * h12, broadcast<Lane>(1e-300));
        const Lane more_s = (h22 * g1 - h12 * g2) * inverse, more_t = (h11 * g2 - h12 * g1) * inverse;
        s = s + more_s;
        t = t + more_t;
        // Flat parallelograms and triangles are done after one iteration, which the second confirms.
        if (!any(max(max(more_s, -more_s), max(more_t, -more_t)) > settled)) break;
        s = min(max(s, -one), one + one);
        t = min(max(t, -one), one + one);
    }
    ClosestPoint<Lane> point;
    point.s = s;
    point.t = t;
    point.offset = reach - s * e1 - t * (e2 + s * twist);
    point.distance2 = dot(point.offset, point.offset);
    const Lane domain = triangle ? one - s - t : min(one - s, one - t);
    const auto inside = min(min(s, t), domain) > zero;

    const auto ab = detail::closest_on_edge(x, q.a, q.b);
    const auto bc = detail::closest_on_edge(x, q.b, q.c);
    const auto cd = detail::closest_on_edge(x, q.c, q.d);
    const auto da = detail::closest_on_edge(x, q.d, q.a);
    const Lane far = broadcast<Lane>(1e300);
    Lane best = inside ? point.distance2 : far;
    const auto take = [&](const detail::EdgePoint<Lane>& edge, double number, Lane edge_s, Lane edge_t) {
        const auto closer = inside ? broadcast<Lane>(0) > one : edge.distance2 < best;
        const Lane at_corner = edge.along == zero ? broadcast<Lane>(4 + number) : broadcast<Lane>(number);
        const Lane next = number < 4 ? broadcast<Lane>(5 + number) : broadcast<Lane>(5);
        const Lane feature = edge.along == one ? next : at_corner;
        best = closer ? edge.distance2 : best;
        point.distance2 = closer ? edge.distance2 : point.distance2;
        point.offset.x = closer ? edge.offset.x : point.offset.x;
        point.offset.y = closer ? edge.offset.y : point.offset.y;
        point.offset.z = closer ? edge.offset.z : point.offset.z;
        point.s = closer ? edge_s : point.s;
        point.t = closer ? edge_t : point.t;
        point.feature = closer ? feature : point.feature;
    };
    take(ab, 1, ab.along, zero);
    take(bc, 2, one - (triangle ? bc.along : zero), bc.along);
    take(cd, 3, triangle ? zero : one - cd.along, one);
    take(da, 4, zero, one - da.along);
    return point;
}

/// Foot of the perpendicular from x, found from a place close to it by one round of Newton's method; not held
/// within the segment. On flat parallelograms and triangles that is exact; on others a start that is off by e
/// (in s and t) leaves an error of the order of e^2 times the twist, and of e^4 in the distance: a foot that
/// is followed from cycle to cycle does not fall behind.
template <class Lane>
inline ClosestPoint<Lane> foot_near(const Vector3<Lane>& x, const SegmentCorners<Lane>& q, Lane s, Lane t)
{
    const Lane zero{}, one = broadcast<Lane>(1);
    const Vector3<Lane> last = q.d - q.c;
    const auto triangle = dot(last, last) == zero;
    const Vector3<Lane> e1 = q.b - q.a, e2 = q.d - q.a;
    Vector3<Lane> twist = (q.a - q.b) + (q.c - q.d);
    twist.x = triangle ? zero : twist.x;
    twist.y = triangle ? zero : twist.y;
    twist.z = triangle ? zero : twist.z;
    const Vector3<Lane> reach = x - q.a;
    const Vector3<Lane> along_s = e1 + t * twist, along_t = e2 + s * twist;
    const Vector3<Lane> rest = reach - s * e1 - t * along_t;
    const Lane g1 = dot(rest, along_s), g2 = dot(rest, along_t);
    const Lane h11 = dot(along_s, along_s), h22 = dot(along_t, along_t), plain = dot(along_s, along_t);
    const Lane newton = plain - dot(rest, twist);
    const Lane h12 = h11 * h22 - newton * newton > 0.05 * h11 * h22 ? newton : plain; // as in closest_point()
    const Lane inverse = one / max(h11 * h22 - h12 * h12, broadcast<Lane>(1e-300));
    ClosestPoint<Lane> point;
    point.s = s + (h22 * g1 - h12 * g2) * inverse;
    point.t = t + (h11 * g2 - h12 * g1) * inverse;
    point.offset = reach - point.s * e1 - point.t * (e2 + point.s * twist);
    point.distance2 = dot(point.offset, point.offset);
    return point;
}

/// Unit normal of the segment at (s, t), by the right-hand rule of its corners; zero where it degenerates.
template <class Lane>
inline Vector3<Lane> segment_normal(const SegmentCorners<Lane>& q, const Lane& s, const Lane& t)
{
    const Lane zero{}, one = broadcast<Lane>(1);
    const Vector3<Lane> last = q.d - q.c;
    const auto triangle = dot(last, last) == zero;
    // A triangle is flat: any (s, t) off its degenerate corner gives its normal.
    const Lane u = triangle ? zero : s, v = triangle ? zero : t;
    const Vector3<Lane> along_s = (one - v) * (q.b - q.a) + v * (q.c - q.d);
    const Vector3<Lane> along_t = (one - u) * (q.d - q.a) + u * (q.c - q.b);
    const Vector3<Lane> normal = cross(along_s, along_t);
    return (one / max(sqrt(dot(normal, normal)), broadcast<Lane>(1e-300))) * normal;
}

/// Shares of the four corners in the point (s, t).
inline std::array<double, 4> corner_shares(double s, double t, bool triangle)
{
    if (triangle) return {1 - s - t, s, t, 0};
    return {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
}

} // namespace plash
