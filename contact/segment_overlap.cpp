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

/// Points of a plane in batches of lanes; the last batch is filled up with its first point.
template <int most>
struct PointBatches {
    static constexpr int room = (most + lane_count - 1) / lane_count * lane_count;
    alignas(sizeof(Lanes)) std::array<double, room> x;
    alignas(sizeof(Lanes)) std::array<double, room> y;
    alignas(sizeof(Lanes)) std::array<double, room> weight; ///< 0 of what fills up
    int count = 0;

    void add(double at_x, double at_y, double with_weight)
    {
        x[count] = at_x;
        y[count] = at_y;
        weight[count++] = with_weight;
    }
    void fill_up()
    {
        const int whole = (count + lane_count - 1) / lane_count * lane_count;
        for (int i = count; i < whole; ++i) {
            x[i] = x[0];
            y[i] = y[0];
            weight[i] = 0;
        }
    }
};

double sum_of(const Lanes& lanes)
{
    double sum = 0;
    for (int lane = 0; lane < lane_count; ++lane) sum += lanes[lane];
    return sum;
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
    measure();
}

/// Distances of the surfaces at the corners of the overlap.
void SegmentOverlap::measure()
{
    if (count_ == 0) return;
    PointBatches<most_corners> points;
    for (int i = 0; i < count_; ++i) points.add(vertex_[i].at.x, vertex_[i].at.y, 1);
    points.fill_up();
    for (int begin = 0; begin < count_; begin += lane_count) {
        const Lanes x = plash::load<Lanes>(&points.x[begin]), y = plash::load<Lanes>(&points.y[begin]);
        const Lanes distance =
            height_at(shares_at(first_, x, y), first_) - height_at(shares_at(second_, x, y), second_);
        for (int i = begin; i < std::min(count_, begin + lane_count); ++i) {
            vertex_[i].distance = distance[i - begin];
            least_ = std::min(least_, vertex_[i].distance);
            most_ = std::max(most_, vertex_[i].distance);
        }
    }
}

void SegmentOverlap::turn_round()
{
    for (double& height : first_.height) height = -height;
    for (double& height : second_.height) height = -height;
    for (int i = 0; i < count_; ++i) vertex_[i].distance = -vertex_[i].distance;
    least_ = std::exchange(most_, -least_);
    least_ = -least_;
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
    std::array<Point2, most_corners> room[2];
    Point2 *from = room[0].data(), *to = room[1].data();
    int count = first_.triangle ? 3 : 4;
    for (int i = 0; i < count; ++i) from[i] = first_.at[i];
    for (int side = 0; side < sides && count > 0; ++side) {
        const Point2 &a = second_.at[side], &b = second_.at[(side + 1) % sides];
        const double along_x = turn * (b.x - a.x), along_y = turn * (b.y - a.y);
        std::array<double, most_corners> inside;
        double least = 1e300;
        for (int i = 0; i < count; ++i) {
            inside[i] = along_x * (from[i].y - a.y) - along_y * (from[i].x - a.x);
            least = std::min(least, inside[i]);
        }
        if (least >= 0) continue;
        int kept = 0;
        for (int i = 0; i < count; ++i) {
            const int next = i + 1 < count ? i + 1 : 0;
            const Point2 &p = from[i], &q = from[next];
            if (inside[i] >= 0 && kept < most_corners) to[kept++] = p;
            if ((inside[i] >= 0) == (inside[next] >= 0) || kept >= most_corners) continue;
            const double along = inside[i] / (inside[i] - inside[next]);
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

/// Shape functions where the shadow of a segment has a point: the bilinear map p = s u + t v + s t w
/// inverted. p - t v is along u + t w, which is a quadratic equation in t, (p x u) + t (u x v + p x w) - t^2
/// (v x w) = 0; its root near the parallelogram's is found without cancellation. Points lie within the shadow
/// or close to it.
template <class Lane>
SegmentOverlap::Shares<Lane> SegmentOverlap::shares_at(const Shadow& shadow, const Lane& x, const Lane& y)
{
    const auto& q = shadow.at;
    const int last = shadow.triangle ? 2 : 3;
    const Point2 u{q[1].x - q[0].x, q[1].y - q[0].y}, v{q[last].x - q[0].x, q[last].y - q[0].y};
    const Point2 twist = shadow.triangle
                             ? Point2{}
                             : Point2{q[2].x - q[1].x - q[3].x + q[0].x, q[2].y - q[1].y - q[3].y + q[0].y};
    const double turn = u.x * v.y - u.y * v.x < 0 ? -1 : 1; // of the corners
    const double square = turn * (u.x * v.y - u.y * v.x), bend = turn * (v.x * twist.y - v.y * twist.x);
    const Lane zero{}, one = broadcast<Lane>(1), low = broadcast<Lane>(-0.5), high = broadcast<Lane>(1.5);
    const Lane tiny = broadcast<Lane>(1e-300);
    const Lane p_x = x - q[0].x, p_y = y - q[0].y;
    const Lane constant = turn * (p_x * u.y - p_y * u.x);
    const Lane slope = square + turn * (p_x * twist.y - p_y * twist.x);
    const Lane root = sqrt(max(slope * slope + (4 * bend) * constant, zero));
    const Lane t = min(max(-2.0 * constant / max(slope + root, tiny), low), high);
    const Lane along_x = u.x + t * twist.x, along_y = u.y + t * twist.y;
    const Lane rest_x = p_x - t * v.x, rest_y = p_y - t * v.y;
    const Lane length2 = max(along_x * along_x + along_y * along_y, tiny);
    const Lane s = min(max((rest_x * along_x + rest_y * along_y) / length2, low), high);
    if (shadow.triangle) return {one - s - t, s, t, zero};
    return {(one - s) * (one - t), s * (one - t), s * t, (one - s) * t};
}

template <class Lane>
Lane SegmentOverlap::height_at(const Shares<Lane>& share, const Shadow& shadow)
{
    return share[0] * shadow.height[0] + share[1] * shadow.height[1] + share[2] * shadow.height[2] +
           share[3] * shadow.height[3];
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
    const Point2 at = middle();
    return shares_at(first_, at.x, at.y);
}

std::array<double, 4> SegmentOverlap::second_middle() const
{
    const Point2 at = middle();
    return shares_at(second_, at.x, at.y);
}

/// Cuts off what is not deeper than the baseline, so that the force sets in smoothly where segments are
/// tilted, and integrates by triangles with three points each (exact for a constant pressure on
/// parallelograms, whose shape functions are quadratic).
SegmentOverlap::Load SegmentOverlap::load(const Law& law) const
{
    std::array<Point2, most_corners + 1> deep;
    int count = 0;
    for (int i = 0; i < count_; ++i) {
        const Vertex &p = vertex_[i], &q = vertex_[(i + 1) % count_];
        const double at_p = gap_ - p.distance - law.baseline, at_q = gap_ - q.distance - law.baseline;
        if (at_p > 0) deep[count++] = p.at;
        if ((at_p > 0) == (at_q > 0)) continue;
        const double along = at_p / (at_p - at_q);
        deep[count++] = {p.at.x + along * (q.at.x - p.at.x), p.at.y + along * (q.at.y - p.at.y)};
    }
    Load load;
    PointBatches<3 * most_corners> points;
    for (int i = 1; i + 1 < count; ++i) {
        const Point2 &a = deep[0], &b = deep[i], &c = deep[i + 1];
        const double area = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        if (area == 0) continue;
        load.area += area;
        constexpr double far = 2.0 / 3, near = 1.0 / 6;
        points.add(far * a.x + near * (b.x + c.x), far * a.y + near * (b.y + c.y), area / 3);
        points.add(far * b.x + near * (a.x + c.x), far * b.y + near * (a.y + c.y), area / 3);
        points.add(far * c.x + near * (a.x + b.x), far * c.y + near * (a.y + b.y), area / 3);
    }
    points.fill_up();
    Lanes force{}, first[4] = {}, second[4] = {};
    for (int begin = 0; begin < points.count; begin += lane_count) {
        const Lanes x = plash::load<Lanes>(&points.x[begin]), y = plash::load<Lanes>(&points.y[begin]);
        const auto on_first = shares_at(first_, x, y), on_second = shares_at(second_, x, y);
        const Lanes active =
            gap_ - law.baseline - height_at(on_first, first_) + height_at(on_second, second_);
        const Lanes part =
            plash::load<Lanes>(&points.weight[begin]) *
            rounded_force(broadcast<Lanes>(law.stiffness), active, broadcast<Lanes>(law.rounding));
        force += part;
        for (int corner = 0; corner < 4; ++corner) {
            first[corner] += part * on_first[corner];
            second[corner] += part * on_second[corner];
        }
    }
    load.force = sum_of(force);
    for (int corner = 0; corner < 4; ++corner) {
        load.first[corner] = sum_of(first[corner]);
        load.second[corner] = sum_of(second[corner]);
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
