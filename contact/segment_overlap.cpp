#include "contact/segment_overlap.h"

#include "contact/closest_point.h"
#include "contact/penalty_law.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plash {

namespace {

/// Two unit vectors across a unit vector.
std::pair<Vec3, Vec3> across(const Vec3& normal)
{
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    const Vec3 least = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 first = unit(cross(normal, least));
    return {first, cross(normal, first)};
}

double height_at(const std::array<double, 4>& share, const std::array<double, 4>& height)
{
    return share[0] * height[0] + share[1] * height[1] + share[2] * height[2] + share[3] * height[3];
}

} // namespace

SegmentOverlap::SegmentOverlap(const Corners& first, const Corners& second, const Vec3& normal, double gap)
    : gap_(gap)
{
    const auto [along, beside] = across(normal);
    const Vec3 origin = 0.25 * (second[0] + second[1] + second[2] + second[3]);
    const auto project = [&, along = along, beside = beside](const Corners& corners, Shadow& shadow) {
        for (int i = 0; i < 4; ++i) {
            const Vec3 reach = corners[i] - origin;
            shadow.at[i] = {dot(reach, along), dot(reach, beside)};
            shadow.height[i] = dot(reach, normal);
        }
        const Vec3 last = corners[3] - corners[2];
        shadow.triangle = dot(last, last) == 0;
        const Point2 one{shadow.at[2].x - shadow.at[0].x, shadow.at[2].y - shadow.at[0].y};
        const Point2 other{shadow.at[3].x - shadow.at[1].x, shadow.at[3].y - shadow.at[1].y};
        shadow.area = 0.5 * std::abs(one.x * other.y - one.y * other.x);
    };
    project(first, first_);
    project(second, second_);
    clip();
    for (int i = 0; i < count_; ++i) {
        vertex_[i].penetration = penetration_at(vertex_[i].at);
        deepest_ = std::max(deepest_, vertex_[i].penetration);
    }
}

bool SegmentOverlap::apart(const Corners& first, const Corners& second, const Vec3& normal, double gap,
                           double depth)
{
    const auto clear = [&](const Vec3& axis, double above, double below) {
        double first_low = 1e300, first_high = -1e300, second_low = 1e300, second_high = -1e300;
        for (int i = 0; i < 4; ++i) {
            const double a = dot(first[i], axis), b = dot(second[i], axis);
            first_low = std::min(first_low, a);
            first_high = std::max(first_high, a);
            second_low = std::min(second_low, b);
            second_high = std::max(second_high, b);
        }
        return first_low > second_high + above || second_low > first_high + below;
    };
    if (clear(normal, gap, std::max(gap, depth))) return true;
    const auto [along, beside] = across(normal);
    return clear(along, 0, 0) || clear(beside, 0, 0);
}

/// The shadow of the first segment, cut by the sides of the second one after the other.
void SegmentOverlap::clip()
{
    const int sides = second_.triangle ? 3 : 4;
    double area = 0;
    for (int i = 0; i < sides; ++i) {
        const Point2 &a = second_.at[i], &b = second_.at[(i + 1) % sides];
        area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    const double turn = area < 0 ? -1 : 1;
    std::array<Point2, most> from{}, to{};
    int count = first_.triangle ? 3 : 4;
    for (int i = 0; i < count; ++i) from[i] = first_.at[i];
    for (int side = 0; side < sides && count > 0; ++side) {
        const Point2 &a = second_.at[side], &b = second_.at[(side + 1) % sides];
        const auto inside = [&](const Point2& p) {
            return turn * ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x));
        };
        int kept = 0;
        for (int i = 0; i < count; ++i) {
            const Point2 &p = from[i], &q = from[(i + 1) % count];
            const double at_p = inside(p), at_q = inside(q);
            if (at_p >= 0 && kept < most) to[kept++] = p;
            if ((at_p >= 0) == (at_q >= 0) || kept >= most) continue;
            const double along = at_p / (at_p - at_q);
            to[kept++] = {p.x + along * (q.x - p.x), p.y + along * (q.y - p.y)};
        }
        count = kept;
        std::swap(from, to);
    }
    double common = 0;
    for (int i = 1; i + 1 < count; ++i) {
        common += 0.5 * ((from[i].x - from[0].x) * (from[i + 1].y - from[0].y) -
                         (from[i].y - from[0].y) * (from[i + 1].x - from[0].x));
    }
    // Neighbours that only share a line overlap by round-off.
    if (std::abs(common) <= 1e-9 * std::abs(area)) return;
    count_ = count;
    for (int i = 0; i < count; ++i) vertex_[i].at = from[i];
}

/// Shape functions where the shadow of a segment has a point: Newton's method on the bilinear map, exact in
/// one round on parallelograms.
std::array<double, 4> SegmentOverlap::shares_at(const Shadow& shadow, const Point2& point)
{
    const auto& q = shadow.at;
    const int last = shadow.triangle ? 2 : 3;
    const Point2 u{q[1].x - q[0].x, q[1].y - q[0].y}, v{q[last].x - q[0].x, q[last].y - q[0].y};
    const Point2 reach{point.x - q[0].x, point.y - q[0].y};
    const Point2 twist = shadow.triangle
                             ? Point2{}
                             : Point2{q[2].x - q[1].x - q[3].x + q[0].x, q[2].y - q[1].y - q[3].y + q[0].y};
    double s = 0.5, t = 0.5;
    for (int round = 0; round < 8; ++round) {
        const Point2 rest{reach.x - s * u.x - t * v.x - s * t * twist.x,
                          reach.y - s * u.y - t * v.y - s * t * twist.y};
        const Point2 along_s{u.x + t * twist.x, u.y + t * twist.y};
        const Point2 along_t{v.x + s * twist.x, v.y + s * twist.y};
        const double determinant = along_s.x * along_t.y - along_s.y * along_t.x;
        if (determinant == 0) break;
        const double more_s = (rest.x * along_t.y - rest.y * along_t.x) / determinant;
        const double more_t = (along_s.x * rest.y - along_s.y * rest.x) / determinant;
        s = std::clamp(s + more_s, -0.5, 1.5);
        t = std::clamp(t + more_t, -0.5, 1.5);
        if (std::abs(more_s) + std::abs(more_t) < 1e-15) break;
    }
    return corner_shares(s, t, shadow.triangle);
}

double SegmentOverlap::penetration_at(const Point2& point) const
{
    return gap_ - height_at(shares_at(first_, point), first_.height) +
           height_at(shares_at(second_, point), second_.height);
}

SegmentOverlap::Point2 SegmentOverlap::middle() const
{
    Point2 sum;
    for (int i = 0; i < count_; ++i) {
        sum.x += vertex_[i].at.x / count_;
        sum.y += vertex_[i].at.y / count_;
    }
    return sum;
}

std::array<double, 4> SegmentOverlap::first_middle() const
{
    return shares_at(first_, middle());
}

std::array<double, 4> SegmentOverlap::second_middle() const
{
    return shares_at(second_, middle());
}

/// Cuts off what is not deeper than the baseline, so that the force sets in smoothly where segments are
/// tilted, and integrates by triangles with three points each (exact for a constant pressure on
/// parallelograms, whose shape functions are quadratic).
SegmentOverlap::Load SegmentOverlap::load(const Law& law) const
{
    std::array<Vertex, most + 1> deep{};
    int count = 0;
    for (int i = 0; i < count_; ++i) {
        const Vertex &p = vertex_[i], &q = vertex_[(i + 1) % count_];
        const double at_p = p.penetration - law.baseline, at_q = q.penetration - law.baseline;
        if (at_p > 0) deep[count++] = p;
        if ((at_p > 0) == (at_q > 0)) continue;
        const double along = at_p / (at_p - at_q);
        deep[count++].at = {p.at.x + along * (q.at.x - p.at.x), p.at.y + along * (q.at.y - p.at.y)};
    }
    Load load;
    for (int i = 1; i + 1 < count; ++i) {
        const Point2 &a = deep[0].at, &b = deep[i].at, &c = deep[i + 1].at;
        const double area = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        if (area == 0) continue;
        load.area += area;
        constexpr double far = 2.0 / 3, near = 1.0 / 6;
        constexpr std::array<std::array<double, 3>, 3> points = {
            {{far, near, near}, {near, far, near}, {near, near, far}}};
        for (const auto& weight : points) {
            const Point2 at{weight[0] * a.x + weight[1] * b.x + weight[2] * c.x,
                            weight[0] * a.y + weight[1] * b.y + weight[2] * c.y};
            const auto on_first = shares_at(first_, at), on_second = shares_at(second_, at);
            const double penetration =
                gap_ - height_at(on_first, first_.height) + height_at(on_second, second_.height);
            const double force =
                area / 3 * rounded_force(law.stiffness, penetration - law.baseline, law.rounding);
            load.force += force;
            for (int corner = 0; corner < 4; ++corner) {
                load.first[corner] += force * on_first[corner];
                load.second[corner] += force * on_second[corner];
            }
        }
    }
    if (!(load.force > 0)) {
        load.force = 0;
        load.first = first_middle();
        load.second = second_middle();
        return load;
    }
    for (int corner = 0; corner < 4; ++corner) {
        load.first[corner] /= load.force;
        load.second[corner] /= load.force;
    }
    return load;
}

} // namespace plash
