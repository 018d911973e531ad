#include "contact/tied_points.h"

#include "contact/bounding_tree.h"
#include "contact/closest_point.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

/// How far beyond its sides, in its own coordinates, a segment still takes nodes: they may stand on the rim
/// of a curved or coarser surface.
constexpr double overlap = 0.05;

/// Coordinates of the foot of the perpendicular from `place`, also beyond the sides (Newton's method).
void project(const Vec3& place, const std::array<Vec3, 4>& corners, bool triangle, double& s, double& t)
{
    for (int iteration = 0; iteration < 20; ++iteration) {
        const TieFrame frame(TieShape(s, t, triangle), corners);
        const Vec3 rest = place - frame.place;
        const double r1 = dot(rest, frame.g1), r2 = dot(rest, frame.g2);
        const double a = dot(frame.g1, frame.g1), b = dot(frame.g1, frame.g2), c = dot(frame.g2, frame.g2);
        Vec3 twist{};
        if (!triangle) twist = (corners[0] - corners[1]) + (corners[2] - corners[3]);
        const double mixed = b - dot(rest, twist);
        const double full = a * c - mixed * mixed, plain = a * c - b * b;
        const double off = full > 0.05 * a * c ? mixed : b, determinant = full > 0.05 * a * c ? full : plain;
        if (!(determinant > 0)) return;
        const double ds = (c * r1 - off * r2) / determinant, dt = (a * r2 - off * r1) / determinant;
        s = std::clamp(s + ds, -1.0, 2.0);
        t = std::clamp(t + dt, -1.0, 2.0);
        if (std::abs(ds) + std::abs(dt) < 1e-14) return;
    }
}

bool within(double s, double t, bool triangle)
{
    if (s < -overlap || t < -overlap) return false;
    return triangle ? s + t <= 1 + overlap : s <= 1 + overlap && t <= 1 + overlap;
}

double shorter_diagonal(const std::array<Vec3, 4>& corners, bool triangle)
{
    const double first = norm(corners[2] - corners[0]);
    const double second = norm(triangle ? corners[1] - corners[0] : corners[3] - corners[1]);
    return std::min(first, second);
}

} // namespace

TieShape::TieShape(double s, double t, bool triangle)
{
    value = corner_shares(s, t, triangle);
    if (triangle) {
        along_s = {-1, 1, 0, 0};
        along_t = {-1, 0, 1, 0};
    } else {
        along_s = {t - 1, 1 - t, t, -t};
        along_t = {s - 1, -s, s, 1 - s};
    }
}

TieFrame::TieFrame(const TieShape& shape, const std::array<Vec3, 4>& corners)
{
    for (int i = 0; i < 4; ++i) {
        place += shape.value[i] * corners[i];
        g1 += shape.along_s[i] * corners[i];
        g2 += shape.along_t[i] * corners[i];
    }
    const Vec3 across = cross(g1, g2);
    area = norm(across);
    normal = unit(across);
}

TieRates tie_rates(const TieShape& shape, const TieFrame& frame, double height,
                   const std::array<Vec3, 4>& corner_velocity)
{
    TieRates rates;
    Vec3 g1_rate{}, g2_rate{};
    for (int i = 0; i < 4; ++i) {
        rates.velocity += shape.value[i] * corner_velocity[i];
        g1_rate += shape.along_s[i] * corner_velocity[i];
        g2_rate += shape.along_t[i] * corner_velocity[i];
    }
    if (!(frame.area > 0)) return rates;
    const Vec3& n = frame.normal;
    const Vec3 across = (1 / frame.area) * (cross(g1_rate, frame.g2) + cross(frame.g1, g2_rate));
    const Vec3 normal_rate = across - dot(across, n) * n;
    rates.velocity += height * normal_rate;
    const double drill = 0.5 * (dot(cross(frame.g1, g1_rate), n) / dot(frame.g1, frame.g1) +
                                dot(cross(frame.g2, g2_rate), n) / dot(frame.g2, frame.g2));
    rates.spin = cross(n, normal_rate) + drill * n;
    return rates;
}

std::array<Vec3, 4> spread_to_corners(const TieShape& shape, const TieFrame& frame, double height,
                                      const Vec3& force, const Vec3& moment)
{
    std::array<Vec3, 4> corner{};
    Vec3 on_g1{}, on_g2{};
    if (frame.area > 0) {
        const Vec3& n = frame.normal;
        // What works on the rate of the normal: the force by its lever, and the moment as n x rate . M.
        const Vec3 lever = height * (force - dot(force, n) * n) + cross(moment, n);
        const Vec3 q = (1 / frame.area) * lever;
        const double drill = 0.5 * dot(moment, n);
        on_g1 = cross(frame.g2, q) + (drill / dot(frame.g1, frame.g1)) * cross(n, frame.g1);
        on_g2 = cross(q, frame.g1) + (drill / dot(frame.g2, frame.g2)) * cross(n, frame.g2);
    }
    for (int i = 0; i < 4; ++i) {
        corner[i] = shape.value[i] * force + shape.along_s[i] * on_g1 + shape.along_t[i] * on_g2;
    }
    return corner;
}

TieSearch find_tied_points(const Surface& slave, const Surface& master, const Contact& contact,
                           const std::vector<Vec3>& position)
{
    const double slave_given = -contact.slave.thickness, master_given = -contact.master.thickness;
    const bool given = slave_given > 0 || master_given > 0;
    const auto corners_of = [&](const Segment& segment) {
        std::array<Vec3, 4> corners;
        for (int i = 0; i < 4; ++i) corners[i] = position[segment.nodes[i]];
        return corners;
    };
    const auto reach = [&](const ContactNode& node, const Segment& segment) {
        if (given) return 0.6 * (std::max(slave_given, 0.0) + std::max(master_given, 0.0));
        const bool triangle = segment.nodes[3] == segment.nodes[2];
        return std::max(1.2 * (node.half_thickness + segment.half_thickness),
                        0.05 * shorter_diagonal(corners_of(segment), triangle));
    };
    double thickest = 0;
    for (const ContactNode& node : slave.nodes) thickest = std::max(thickest, node.half_thickness);
    ContactNode widest;
    widest.half_thickness = thickest;
    std::vector<Bounds> boxes(master.segments.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (const Vec3& corner : corners_of(master.segments[i])) boxes[i].add(corner);
        boxes[i].grow(reach(widest, master.segments[i]) + overlap * master.segments[i].size);
    }
    BoundingTree tree;
    tree.fit(boxes);

    TieSearch found;
    for (std::size_t number = 0; number < slave.nodes.size(); ++number) {
        const ContactNode& node = slave.nodes[number];
        const Vec3& place = position[node.node];
        TiedPoint best;
        double closest = 1e300;
        Bounds box;
        box.add(place);
        bool own = false;
        tree.query(box, [&](Index candidate) {
            const Segment& segment = master.segments[candidate];
            const auto& nodes = segment.nodes;
            if (std::find(nodes.begin(), nodes.end(), node.node) != nodes.end()) {
                own = true; // the meshes are joined there already
                return;
            }
            const bool triangle = nodes[3] == nodes[2];
            const auto corners = corners_of(segment);
            const SegmentCorners<double> quad{corners[0], corners[1], corners[2], corners[3]};
            const ClosestPoint<double> point = closest_point(place, quad);
            TiedPoint tied{node.node, nodes,   candidate, static_cast<Index>(number),
                           point.s,   point.t, 0,         segment.size};
            if (point.feature != 0) project(place, corners, triangle, tied.s, tied.t);
            if (!within(tied.s, tied.t, triangle)) return;
            const TieFrame frame(TieShape(tied.s, tied.t, triangle), corners);
            tied.height = dot(place - frame.place, frame.normal);
            const double distance2 = point.distance2;
            if (std::abs(tied.height) > reach(node, segment)) return;
            if (distance2 > closest || (distance2 == closest && candidate > best.segment)) return;
            closest = distance2;
            best = tied;
        });
        if (own) continue;
        if (best.node == none) {
            found.left_out.push_back(node.node);
        } else {
            found.points.push_back(best);
        }
    }
    return found;
}

} // namespace plash
