#include "contact/segment_overlap.h"

#include "contact/closest_point.h"
#include "contact/penalty_law.h"

#include <algorithm>
#include <cmath>
#include <tuple>
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

/// Pair by pair: a chain of eight additions would take three times as long.
double sum_of(const Lanes& lanes)
{
    const Lanes four = lanes + __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7, 0, 1, 2, 3);
    const Lanes two = four + __builtin_shufflevector(four, four, 2, 3, 0, 1, 6, 7, 4, 5);
    return two[0] + two[1];
}

} // namespace

SegmentOverlap::SegmentOverlap(const Corners& first, const Corners& second, const Vec3& normal, double gap)
    : normal_(normal), gap_(gap)
{
    std::tie(along_, beside_) = across(normal);
    const Vec3 origin = 0.25 * (second[0] + second[1] + second[2] + second[3]);
    const auto project = [&](const Corners& corners, Shadow& shadow) {
        for (int i = 0; i < 4; ++i) {
            const Vec3 reach = corners[i] - origin;
            shadow.at[i] = {dot(reach, along_), dot(reach, beside_)};
            shadow.height[i] = dot(reach, normal);
        }
        const Vec3 last = corners[3] - corners[2];
        shadow.triangle = dot(last, last) == 0;
        const Point2 one{shadow.at[2].x - shadow.at[0].x, shadow.at[2].y - shadow.at[0].y};
        const Point2 other{shadow.at[3].x - shadow.at[1].x, shadow.at[3].y - shadow.at[1].y};
        shadow.area = 0.5 * std::abs(one.x * other.y - one.y * other.x);
        const auto& q = shadow.at;
        const int end = shadow.triangle ? 2 : 3;
        shadow.u = {q[1].x - q[0].x, q[1].y - q[0].y};
        shadow.v = {q[end].x - q[0].x, q[end].y - q[0].y};
        shadow.twist = shadow.triangle
                           ? Point2{}
                           : Point2{q[2].x - q[1].x - q[3].x + q[0].x, q[2].y - q[1].y - q[3].y + q[0].y};
        const double round = shadow.u.x * shadow.v.y - shadow.u.y * shadow.v.x;
        shadow.turn = round < 0 ? -1 : 1;
        shadow.square = shadow.turn * round;
        shadow.bend = shadow.turn * (shadow.v.x * shadow.twist.y - shadow.v.y * shadow.twist.x);
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
        const Lanes distance = height_at(place_at(first_, x, y).share, first_) -
                               height_at(place_at(second_, x, y).share, second_);
        for (int i = begin; i < std::min(count_, begin + lane_count); ++i) {
            vertex_[i].distance = distance[i - begin];
            least_ = std::min(least_, vertex_[i].distance);
            most_ = std::max(most_, vertex_[i].distance);
        }
    }
}

void SegmentOverlap::turn_round()
{
    normal_ = -normal_;
    for (double& height : first_.height) height = -height;
    for (double& height : second_.height) height = -height;
    for (int i = 0; i < count_; ++i) vertex_[i].distance = -vertex_[i].distance;
    least_ = std::exchange(most_, -least_);
    least_ = -least_;
}

/// The shadow of the first segment, cut by the sides of the second one after the other.
void SegmentOverlap::clip()
{
    const int sides = second_.sides();
    double area = 0;
    for (int i = 0; i < sides; ++i) {
        const Point2 &a = second_.at[i], &b = second_.at[(i + 1) % sides];
        area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    const double turn = area < 0 ? -1 : 1;
    std::array<Corner, most_corners> room[2];
    Corner *from = room[0].data(), *to = room[1].data();
    int count = first_.sides();
    for (int i = 0; i < count; ++i) from[i] = {first_.at[i], i};
    for (int side = 0; side < sides && count > 0; ++side) {
        const Point2 &a = second_.at[side], &b = second_.at[(side + 1) % sides];
        const double along_x = turn * (b.x - a.x), along_y = turn * (b.y - a.y);
        std::array<double, most_corners> inside;
        double least = 1e300;
        for (int i = 0; i < count; ++i) {
            inside[i] = along_x * (from[i].at.y - a.y) - along_y * (from[i].at.x - a.x);
            least = std::min(least, inside[i]);
        }
        if (least >= 0) continue;
        int kept = 0;
        for (int i = 0; i < count; ++i) {
            const int next = i + 1 < count ? i + 1 : 0;
            const Point2 &p = from[i].at, &q = from[next].at;
            if (inside[i] >= 0 && kept < most_corners) to[kept++] = from[i];
            if ((inside[i] >= 0) == (inside[next] >= 0) || kept >= most_corners) continue;
            const double along = inside[i] / (inside[i] - inside[next]);
            const int from_here = inside[i] >= 0 ? 4 + side : from[i].side;
            to[kept++] = {{p.x + along * (q.x - p.x), p.y + along * (q.y - p.y)}, from_here};
        }
        count = kept;
        std::swap(from, to);
    }
    double common = 0;
    for (int i = 1; i + 1 < count; ++i) {
        const Point2 &p = from[0].at, &q = from[i].at, &r = from[i + 1].at;
        common += 0.5 * ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
    }
    // Neighbours that only share a line overlap by round-off.
    if (std::abs(common) <= 1e-9 * std::abs(area)) return;
    count_ = count;
    std::copy_n(from, count, vertex_.begin());
}

/// Shape functions where the shadow of a segment has a point: the bilinear map p = s u + t v + s t w
/// inverted. p - t v is along u + t w, which is a quadratic equation in t, (p x u) + t (u x v + p x w) - t^2
/// (v x w) = 0; its root near the parallelogram's is found without cancellation. Points lie within the shadow
/// or close to it.
template <class Lane>
SegmentOverlap::Place<Lane> SegmentOverlap::place_at(const Shadow& shadow, const Lane& x, const Lane& y)
{
    const Point2 &u = shadow.u, &v = shadow.v, &twist = shadow.twist, &origin = shadow.at[0];
    const double turn = shadow.turn, square = shadow.square, bend = shadow.bend;
    const Lane zero{}, one = broadcast<Lane>(1), low = broadcast<Lane>(-0.5), high = broadcast<Lane>(1.5);
    const Lane tiny = broadcast<Lane>(1e-300);
    const Lane p_x = x - origin.x, p_y = y - origin.y;
    const Lane constant = turn * (p_x * u.y - p_y * u.x);
    const Lane slope = square + turn * (p_x * twist.y - p_y * twist.x);
    const Lane root = sqrt(max(slope * slope + (4 * bend) * constant, zero));
    const Lane t = min(max(-2.0 * constant / max(slope + root, tiny), low), high);
    const Lane along_x = u.x + t * twist.x, along_y = u.y + t * twist.y;
    const Lane rest_x = p_x - t * v.x, rest_y = p_y - t * v.y;
    const Lane length2 = max(along_x * along_x + along_y * along_y, tiny);
    const Lane s = min(max((rest_x * along_x + rest_y * along_y) / length2, low), high);
    if (shadow.triangle) return {s, t, {one - s - t, s, t, zero}};
    return {s, t, {(one - s) * (one - t), s * (one - t), s * t, (one - s) * t}};
}

/// From the derivatives of place and height by s and t. Where a crumpled segment's shadow folds, the slope is
/// that of a part twenty times steeper than its middle at most.
template <class Lane>
SegmentOverlap::Slope<Lane> SegmentOverlap::slope_at(const Shadow& shadow, const Place<Lane>& place)
{
    const auto& q = shadow.at;
    const auto& h = shadow.height;
    const int last = shadow.triangle ? 2 : 3;
    const double bent = shadow.triangle ? 0 : 1;
    const auto by = [&](double first, double other, double twist, const Lane& rest) {
        return (other - first) + (bent * twist) * rest;
    };
    const double twist_x = q[2].x - q[1].x - q[3].x + q[0].x, twist_y = q[2].y - q[1].y - q[3].y + q[0].y;
    const double twist_h = h[2] - h[1] - h[3] + h[0];
    const Lane x_s = by(q[0].x, q[1].x, twist_x, place.t), x_t = by(q[0].x, q[last].x, twist_x, place.s);
    const Lane y_s = by(q[0].y, q[1].y, twist_y, place.t), y_t = by(q[0].y, q[last].y, twist_y, place.s);
    const Lane h_s = by(h[0], h[1], twist_h, place.t), h_t = by(h[0], h[last], twist_h, place.s);
    const double one_way =
        (q[2].x - q[0].x) * (q[last].y - q[1].y) - (q[2].y - q[0].y) * (q[last].x - q[1].x);
    const double turn = one_way < 0 ? -1 : 1;
    const Lane size = max(turn * (x_s * y_t - y_s * x_t), broadcast<Lane>(0.05 * shadow.area + 1e-300));
    return {turn * (h_s * y_t - h_t * y_s) / size, turn * (h_t * x_s - h_s * x_t) / size};
}

template <class Lane>
Lane SegmentOverlap::height_at(const Shares<Lane>& share, const Shadow& shadow)
{
    return share[0] * shadow.height[0] + share[1] * shadow.height[1] + share[2] * shadow.height[2] +
           share[3] * shadow.height[3];
}

SegmentOverlap::Point2 SegmentOverlap::middle() const
{
    Point2 sum{};
    for (int i = 0; i < count_; ++i) {
        sum.x += vertex_[i].at.x / count_;
        sum.y += vertex_[i].at.y / count_;
    }
    return sum;
}

std::array<double, 4> SegmentOverlap::first_middle() const
{
    const Point2 at = middle();
    return place_at(first_, at.x, at.y).share;
}

std::array<double, 4> SegmentOverlap::second_middle() const
{
    const Point2 at = middle();
    return place_at(second_, at.x, at.y).share;
}

/// The part of the overlap that is deeper than the baseline: the force sets in smoothly where segments are
/// tilted.
SegmentOverlap::Polygon SegmentOverlap::deeper_than(double baseline) const
{
    Polygon deep;
    for (int i = 0; i < count_; ++i) {
        const Corner &p = vertex_[i], &q = vertex_[(i + 1) % count_];
        const double at_p = gap_ - p.distance - baseline, at_q = gap_ - q.distance - baseline;
        if (at_p > 0) deep.corner[deep.count++] = p;
        if ((at_p > 0) == (at_q > 0)) continue;
        const double along = at_p / (at_p - at_q);
        const Point2 at{p.at.x + along * (q.at.x - p.at.x), p.at.y + along * (q.at.y - p.at.y)};
        deep.corner[deep.count++] = {at, at_p > 0 ? no_side : p.side};
    }
    return deep;
}

/// Triangles with three points each. Returns their area.
template <class Points>
double SegmentOverlap::add_area_points(const Polygon& deep, Points& points)
{
    double whole = 0;
    for (int i = 1; i + 1 < deep.count; ++i) {
        const Point2 &a = deep.corner[0].at, &b = deep.corner[i].at, &c = deep.corner[i + 1].at;
        const double area = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        if (area == 0) continue;
        whole += area;
        constexpr double far = 2.0 / 3, near = 1.0 / 6;
        points.add(far * a.x + near * (b.x + c.x), far * a.y + near * (b.y + c.y), area / 3);
        points.add(far * b.x + near * (a.x + c.x), far * b.y + near * (a.y + c.y), area / 3);
        points.add(far * c.x + near * (a.x + b.x), far * c.y + near * (a.y + b.y), area / 3);
    }
    return whole;
}

/// Two points a side, without weight in the area.
template <class Points>
SegmentOverlap::SidePoints SegmentOverlap::add_side_points(const Polygon& deep, Points& points)
{
    SidePoints sides;
    double turn = 0;
    for (int i = 1; i + 1 < deep.count; ++i) {
        const Point2 &a = deep.corner[0].at, &b = deep.corner[i].at, &c = deep.corner[i + 1].at;
        turn += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }
    turn = turn < 0 ? -1 : 1;
    for (int i = 0; i < deep.count; ++i) {
        if (deep.corner[i].side == no_side) continue;
        const Point2 &p = deep.corner[i].at, &q = deep.corner[(i + 1) % deep.count].at;
        const Point2 way{q.x - p.x, q.y - p.y};
        for (const double along : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}) {
            sides.outward[sides.count] = {0.5 * turn * way.y, -0.5 * turn * way.x};
            sides.side[sides.count++] = deep.corner[i].side;
            points.add(p.x + along * way.x, p.y + along * way.y, 0);
        }
    }
    return sides;
}

/// Pressure over the area (exact for a constant pressure on parallelograms, whose shape functions are
/// quadratic), and what the sides do, whose points fill the same batches. A point of a segment that moves in
/// the plane takes its height along: at a place that stays, this changes by the slope. Returns the area.
double SegmentOverlap::press_area(const Polygon& deep, const Law& law, Forces& forces) const
{
    PointBatches<3 * most_corners + SidePoints::room> points;
    const double whole = add_area_points(deep, points);
    const int inside = points.count;
    SidePoints sides;
    if (law.lateral > 0) sides = add_side_points(deep, points);
    points.fill_up();
    alignas(sizeof(Lanes)) std::array<double, decltype(points)::room> density; ///< energy per area
    struct LaneForces {
        Lanes x[4] = {}, y[4] = {}, along[4] = {};
    } on[2];
    Lanes energy{}, force{};
    for (int begin = 0; begin < points.count; begin += lane_count) {
        const Lanes x = plash::load<Lanes>(&points.x[begin]), y = plash::load<Lanes>(&points.y[begin]);
        const Lanes weight = plash::load<Lanes>(&points.weight[begin]);
        const auto on_first = place_at(first_, x, y), on_second = place_at(second_, x, y);
        const Lanes active =
            gap_ - law.baseline - height_at(on_first.share, first_) + height_at(on_second.share, second_);
        const Lanes rounding = broadcast<Lanes>(law.rounding), stiffness = broadcast<Lanes>(1);
        const Lanes part = weight * rounded_force(stiffness, active, rounding);
        const Lanes per_area = rounded_energy(stiffness, active, rounding);
        if (begin + lane_count > inside) store(&density[begin], per_area);
        if (begin >= inside) continue;
        energy += weight * per_area;
        force += part;
        const auto press = [&](const auto& place, const Shadow& shadow, double sign, LaneForces& sum) {
            const auto slope = slope_at(shadow, place);
            for (int i = 0; i < 4; ++i) {
                const Lanes share = (sign * part) * place.share[i];
                sum.along[i] += share;
                sum.x[i] -= share * slope.x;
                sum.y[i] -= share * slope.y;
            }
        };
        press(on_first, first_, 1, on[0]);
        press(on_second, second_, -1, on[1]);
    }
    forces.energy = sum_of(energy);
    forces.force = sum_of(force);
    for (int of = 0; of < 2; ++of) {
        for (int i = 0; i < 4; ++i) {
            forces.on[of].along[i] = sum_of(on[of].along[i]);
            forces.on[of].in_plane[i] = {sum_of(on[of].x[i]), sum_of(on[of].y[i])};
        }
    }
    press_sides(sides, &points.x[inside], &points.y[inside], &density[inside], forces);
    return whole;
}

/// A side of either segment that bounds the overlap gives up energy where it moves in: two points a side,
/// exact as long as the penetration changes evenly along it.
/// energy   per area at the points
void SegmentOverlap::press_sides(const SidePoints& sides, const double* x, const double* y,
                                 const double* energy, Forces& forces) const
{
    for (int i = 0; i < sides.count; ++i) {
        const int of = sides.side[i] / 4, from = sides.side[i] % 4;
        const Shadow& shadow = of == 0 ? first_ : second_;
        const int to = (from + 1) % shadow.sides();
        const Point2 &p = shadow.at[from], &q = shadow.at[to];
        const Point2 way{q.x - p.x, q.y - p.y};
        const double length2 = way.x * way.x + way.y * way.y;
        if (length2 == 0) continue;
        const double along = ((x[i] - p.x) * way.x + (y[i] - p.y) * way.y) / length2;
        const Point2& outward = sides.outward[i];
        auto& sum = forces.on[of].in_plane;
        sum[from].x -= (1 - along) * energy[i] * outward.x;
        sum[from].y -= (1 - along) * energy[i] * outward.y;
        sum[to].x -= along * energy[i] * outward.x;
        sum[to].y -= along * energy[i] * outward.y;
    }
}

/// Forces of an energy that falls as the shadow of a segment grows beyond its size at the start.
/// part  of the energy's factor that is size / area
void SegmentOverlap::scale_by_area(const Shadow& shadow, double size, double part, CornerForces& forces,
                                   double energy)
{
    if (shadow.area <= 0.25 * size) return; // the factor is at its bound
    const auto& q = shadow.at;
    const Point2 one{q[2].x - q[0].x, q[2].y - q[0].y}, other{q[3].x - q[1].x, q[3].y - q[1].y};
    const double turn = one.x * other.y - one.y * other.x < 0 ? -1 : 1;
    const double factor = 0.5 * turn * part * size / (shadow.area * shadow.area) * energy;
    const Point2 by_one{factor * other.y, -factor * other.x}, by_other{-factor * one.y, factor * one.x};
    auto& sum = forces.in_plane;
    const auto add = [&](int i, double sign, const Point2& more) {
        sum[i].x += sign * more.x;
        sum[i].y += sign * more.y;
    };
    add(2, 1, by_one);
    add(0, -1, by_one);
    add(3, 1, by_other);
    add(1, -1, by_other);
}

/// Takes out what the points of integration leave of the sum of all forces in the plane, which is nothing.
void SegmentOverlap::balance(const Load& load, Forces& forces) const
{
    Point2 left{};
    for (const CornerForces& on : forces.on) {
        for (const Point2& force : on.in_plane) {
            left.x += force.x;
            left.y += force.y;
        }
    }
    for (int i = 0; i < 4; ++i) {
        for (int of = 0; of < 2; ++of) {
            const double share = 0.5 * (of == 0 ? load.first : load.second)[i];
            forces.on[of].in_plane[i].x -= share * left.x;
            forces.on[of].in_plane[i].y -= share * left.y;
        }
    }
}

/// Forces and their moment in space. Like their sum, their moment about the normal is nothing, but for the
/// points of integration.
void SegmentOverlap::hand_over(const Forces& forces, Load& load) const
{
    Vec3 reach[2][4];
    double square = 0;
    Point2 middle{};
    for (const Shadow* shadow : {&first_, &second_}) {
        for (const Point2& at : shadow->at) {
            middle.x += at.x / 8;
            middle.y += at.y / 8;
        }
    }
    Vec3 moment{};
    std::array<Vec3, 4>* out[2] = {&load.on_first, &load.on_second};
    for (int of = 0; of < 2; ++of) {
        const Shadow& shadow = of == 0 ? first_ : second_;
        for (int i = 0; i < 4; ++i) {
            const double x = shadow.at[i].x - middle.x, y = shadow.at[i].y - middle.y;
            reach[of][i] = x * along_ + y * beside_ + shadow.height[i] * normal_;
            square += x * x + y * y;
            const Point2& in_plane = forces.on[of].in_plane[i];
            (*out[of])[i] = in_plane.x * along_ + in_plane.y * beside_ + forces.on[of].along[i] * normal_;
            moment += cross(reach[of][i], (*out[of])[i]);
        }
    }
    const double spin = square > 0 ? dot(moment, normal_) / square : 0;
    load.moment = {};
    for (int of = 0; of < 2; ++of) {
        for (int i = 0; i < 4; ++i) {
            (*out[of])[i] -= spin * cross(normal_, reach[of][i]);
            load.moment += cross(reach[of][i], (*out[of])[i]);
        }
    }
}

SegmentOverlap::Load SegmentOverlap::load(const Law& law) const
{
    const Polygon deep = deeper_than(law.baseline);
    Load load;
    Forces forces;
    load.area = press_area(deep, law, forces);
    if (!(forces.force > 0)) {
        load.first = first_middle();
        load.second = second_middle();
        return load;
    }
    for (int i = 0; i < 4; ++i) {
        load.first[i] = forces.on[0].along[i] / forces.force;
        load.second[i] = -forces.on[1].along[i] / forces.force;
    }
    const double second_share = 1 - law.first_share;
    const double factor = law.first_share * law.first_size / std::max(first_.area, 0.25 * law.first_size) +
                          second_share * law.second_size / std::max(second_.area, 0.25 * law.second_size);
    const double stiffness = factor * law.stiffness;
    for (CornerForces& on : forces.on) {
        for (int i = 0; i < 4; ++i) {
            on.along[i] *= stiffness;
            on.in_plane[i].x *= law.lateral * stiffness;
            on.in_plane[i].y *= law.lateral * stiffness;
        }
    }
    const double plain = law.lateral * law.stiffness * forces.energy;
    scale_by_area(first_, law.first_size, law.first_share, forces.on[0], plain);
    scale_by_area(second_, law.second_size, second_share, forces.on[1], plain);
    if (law.lateral > 0) balance(load, forces);
    load.force = stiffness * forces.force;
    load.energy = stiffness * forces.energy;
    load.stiffness = stiffness * load.area;
    hand_over(forces, load);
    return load;
}

} // namespace plash
