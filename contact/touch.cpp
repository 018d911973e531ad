#include "contact/touch.h"

#include "contact/closest_point.h"
#include "contact/lane_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace plash {

namespace {

using Facet = ContactMesh::Facet;

/// Share of its size by which an oriented facet reaches beyond its sides (as MAXPAR = 1.025 of LS-DYNA).
constexpr double overhang = 0.025;

/// Share of its depth behind the face of a solid up to which a node counts as having just come in.
constexpr double entry = 0.1;

} // namespace

/// Normal in the middle of a facet.
Vec3 TouchFinder::facet_normal(Index facet) const
{
    const auto& corner = mesh_.facets[facet].corner;
    const auto& p = motion_.position;
    return segment_normal(SegmentCorners<double>{p[corner[0]], p[corner[1]], p[corner[2]], p[corner[3]]}, 0.5,
                          0.5);
}

/// +1 if two facets that share an edge have their normals on the same side of the sheet, -1 if not, 0 if they
/// share no edge.
int TouchFinder::same_sense(Index facet, Index other) const
{
    if (facet == other) return 1;
    const auto& edges = mesh_.facet_edges[facet];
    const auto& other_edges = mesh_.facet_edges[other];
    for (int i = 0; i < 4; ++i) {
        if (edges[i] == none) continue;
        for (int j = 0; j < 4; ++j) {
            if (other_edges[j] != edges[i]) continue;
            return mesh_.facets[facet].corner[i] == mesh_.facets[other].corner[j] ? -1 : 1;
        }
    }
    return 0;
}

void TouchFinder::find(PairList& pairs, std::size_t begin, std::size_t end, TouchTable& table,
                       Room& room) const
{
    collect_near(pairs, begin, end, table, room);
    const std::span<const Near> near = room.near;
    std::vector<Touch>& touches = room.touches;
    std::size_t i = 0;
    for (std::size_t owner = begin; owner < end; ++owner) {
        const double now = pairs.paths.now(owner);
        const bool quiet = pairs.quiet[owner] > now;
        if (quiet) {
            table.set_followed(owner, true);
            continue;
        }
        std::vector<Touch>& before = room.before;
        before.clear();
        for (int layer = 0; layer < table.count(owner); ++layer)
            before.push_back(touch_before(table, owner, layer));
        std::size_t next = i;
        while (next < near.size() && near[next].node == pairs.owner[owner]) ++next;
        touches.clear();
        if (next > i) resolve(near.subspan(i, next - i), before, room.order, touches);
        table.set_followed(owner, false);
        table.put(owner, touches);
        pairs.quiet[owner] = 0;
        const bool moved = call_again(pairs, owner, before, touches);
        if (!moved) pairs.quiet[owner] = quiet_until(pairs, owner, near.subspan(i, next - i), touches);
        for (std::size_t layer = 0; pairs.quiet[owner] > now && layer < touches.size(); ++layer) {
            const double along = dot(facet_normal(touches[layer].facet), touches[layer].normal);
            table.value(TouchTable::side, static_cast<int>(layer), owner) = along < 0 ? -1 : 1;
        }
        i = next;
    }
}

/// A touch with the penetration that it had a step ago: that of a followed one is known as it is now.
Touch TouchFinder::touch_before(const TouchTable& table, std::size_t owner, int layer) const
{
    Touch touch = table.touch(mesh_, motion_, owner, layer);
    if (table.followed(owner))
        touch.penetration -= approach(touch.node, touch.facet, touch.s, touch.t, touch.normal);
    return touch;
}

/// Pairs are put off by what their node touches (wait_for_sheet(), wait_for_solid()): those that may reach
/// further since it touches another facet are due again. Returns whether it does.
bool TouchFinder::call_again(PairList& pairs, std::size_t owner, std::span<const Touch> before,
                             std::span<const Touch> touches) const
{
    std::array<const Facet*, TouchTable::layers> entered{};
    std::size_t count = 0;
    for (const Touch& touch : touches) {
        const auto same = [&](const Touch& one) { return one.facet == touch.facet; };
        if (std::none_of(before.begin(), before.end(), same)) entered[count++] = &mesh_.facets[touch.facet];
    }
    if (count == 0) return false;
    const Index close_end = pairs.begin[owner] + pairs.close[owner];
    for (Index pair = pairs.begin[owner]; pair < pairs.begin[owner + 1]; ++pair) {
        if (!std::isfinite(pairs.due[pair])) continue;
        const Facet& facet = mesh_.facets[pairs.facet[pair]];
        const auto beside = [&](const Facet* one) { return one == &facet || share_a_corner(*one, facet); };
        const bool reaches_further =
            facet.one_sided ? before.empty() : std::any_of(entered.begin(), entered.begin() + count, beside);
        if (!reaches_further) continue;
        pairs.due[pair] = 0;
        if (pair >= close_end) pairs.others_due[owner] = 0;
    }
    return true;
}

/// Path before which a pair cannot touch, for a sheet. Behind its plane a facet holds nodes that came there
/// in touch with it or with a facet beside it; others touch it only within its thickness, so that sheets far
/// thinner than their elements do not look at all that lie behind one another.
double TouchFinder::wait_for_sheet(const Near& near, double gap, const TouchTable& table,
                                   std::size_t owner) const
{
    const Facet& facet = mesh_.facets[near.facet];
    double reach = gap;
    for (int layer = 0; facet.depth > gap && layer < table.count(owner); ++layer) {
        const Index old = table.facets(layer)[owner];
        if (old == near.facet || share_a_corner(mesh_.facets[old], facet)) reach = facet.depth;
    }
    return std::sqrt(near.distance2) - reach;
}

/// The same for a solid: in front of its face within the thickness, behind it as deep as nodes are held that
/// touch something (from which side, touch_of() sees), or as those lie that have just come in.
/// step  path within which the pair is looked at anyway
double TouchFinder::wait_for_solid(const Near& near, double gap, bool touches, double step) const
{
    const Facet& facet = mesh_.facets[near.facet];
    const double inside = (touches || motion_.last_step == 0 ? 1 : entry) * facet.depth;
    const double distance = dot(near.offset, near.normal);
    const double over = distance > 0 ? distance - gap : -distance - inside;
    if (near.feature == 0) return over;
    const double beside =
        norm(near.offset - distance * near.normal) - std::max(0.0, overhang * facet.size - gap);
    const double face = std::max(beside, over), rim = std::sqrt(near.distance2) - std::max(gap, inside);
    if (rim > step || face <= step) return std::min(face, rim);
    return std::min(face, std::max(rim, wait_at_rim(near, gap)));
}

/// Puts the pairs of an owner first that will be due within the next cycles.
void TouchFinder::sort_pairs(PairList& pairs, std::size_t owner) const
{
    constexpr double cycles = 20;
    const double soon = pairs.paths.travelled(owner) + cycles * pairs.paths.step_range(owner);
    Index next = pairs.begin[owner];
    double others = std::numeric_limits<double>::infinity();
    for (Index pair = next; pair < pairs.begin[owner + 1]; ++pair) {
        if (pairs.due[pair] > soon) {
            others = std::min(others, pairs.due[pair]);
            continue;
        }
        std::swap(pairs.facet[pair], pairs.facet[next]);
        std::swap(pairs.due[pair], pairs.due[next]);
        ++next;
    }
    pairs.close[owner] = next - pairs.begin[owner];
    pairs.others_due[owner] = others;
}

/// Goes through the pairs that are due, but for quiet nodes, eight at a time. Facets and their corners lie
/// where the other body is: they are called for a few batches ahead.
void TouchFinder::collect_near(PairList& pairs, std::size_t begin, std::size_t end, const TouchTable& table,
                               Room& room) const
{
    std::vector<Due>& due = room.due;
    due.clear();
    room.near.clear();
    for (std::size_t owner = begin; owner < end; ++owner) {
        const double now = pairs.paths.now(owner);
        if (pairs.quiet[owner] > now) continue;
        if (pairs.others_due[owner] <= now) sort_pairs(pairs, owner);
        for (Index pair = pairs.begin[owner]; pair < pairs.begin[owner] + pairs.close[owner]; ++pair)
            if (pairs.due[pair] <= now) due.push_back({pair, static_cast<Index>(owner)});
    }
    constexpr std::size_t facets_ahead = 4 * lane_count, corners_ahead = 2 * lane_count;
    for (std::size_t first = 0; first < due.size(); first += lane_count) {
        const std::size_t last = std::min(first + lane_count, due.size());
        for (std::size_t i = first; i < last; ++i) {
            if (i + facets_ahead < due.size()) {
                __builtin_prefetch(&mesh_.facets[pairs.facet[due[i + facets_ahead].pair]]);
            }
            if (i + corners_ahead >= due.size()) continue;
            const auto& corner = mesh_.facets[pairs.facet[due[i + corners_ahead].pair]].corner;
            __builtin_prefetch(&motion_.position[corner[0]]);
            __builtin_prefetch(&motion_.position[corner[2]]);
        }
        measure(pairs, {due.data() + first, last - first}, table, room.near);
    }
}

/// Whether a node stands over the face of a solid, if only just: bodies that rest on one another without
/// pressing have many such nodes.
bool TouchFinder::in_front(const Near& near, double gap) const
{
    const double distance = dot(near.offset, near.normal);
    if (distance < gap) return false;
    const double beyond = overhang * mesh_.facets[near.facet].size - gap;
    return near.feature == 0 || (beyond > 0 && norm(near.offset - distance * near.normal) <= beyond);
}

/// Closest points of some pairs: keeps those that may touch in this step, and tells the others when they are
/// due.
void TouchFinder::measure(PairList& pairs, std::span<const Due> batch, const TouchTable& table,
                          std::vector<Near>& near) const
{
    Index node[lane_count], corner[4][lane_count];
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const Index pair = batch[std::min(lane, batch.size() - 1)].pair;
        node[lane] = pairs.node[pair];
        for (int i = 0; i < 4; ++i) corner[i][lane] = mesh_.facets[pairs.facet[pair]].corner[i];
    }
    const Vec3* place = motion_.position.data();
    const SegmentCorners<Lanes> corners{points_in_lanes(place, corner[0]), points_in_lanes(place, corner[1]),
                                        points_in_lanes(place, corner[2]), points_in_lanes(place, corner[3])};
    const auto point = closest_point(points_in_lanes(place, node), corners);
    const auto normal = segment_normal(corners, point.s, point.t);
    const auto at = [](const Vector3<Lanes>& v, std::size_t lane) {
        return Vec3{v.x[lane], v.y[lane], v.z[lane]};
    };
    for (std::size_t lane = 0; lane < batch.size(); ++lane) {
        const auto [pair, owner] = batch[lane];
        Near one{node[lane],
                 pairs.facet[pair],
                 static_cast<int>(point.feature[lane]),
                 point.s[lane],
                 point.t[lane],
                 point.distance2[lane],
                 at(point.offset, lane),
                 at(normal, lane)};
        const Facet& facet = mesh_.facets[one.facet];
        const double gap = mesh_.nodes[one.node].half_thickness + facet.half_thickness;
        const double step = pairs.paths.step_range(owner);
        const double wait = facet.one_sided ? wait_for_solid(one, gap, table.count(owner) > 0, step)
                                            : wait_for_sheet(one, gap, table, owner);
        pairs.due[pair] = pairs.paths.travelled(owner) + wait;
        if (wait > step) continue;
        one.over = facet.one_sided && in_front(one, gap);
        near.push_back(one);
    }
}

/// The side of a sheet (+1 along its normal) on which the node was when it touched this facet or a neighbour.
bool TouchFinder::keeps_side(const Near& near, std::span<const Touch> before, const Vec3& normal,
                             double& side) const
{
    const Facet& facet = mesh_.facets[near.facet];
    for (const Touch& old : before) {
        const double along = dot(old.normal, normal);
        if (facet.one_sided) {
            if (along > 0.5) return true;
            continue;
        }
        if (old.facet == near.facet) {
            side = along < 0 ? -1 : 1;
            return true;
        }
        // Carried across the common edge, a side stays the same also where the sheet is folded.
        if (const int sense = same_sense(old.facet, near.facet); sense != 0) {
            side = dot(old.normal, facet_normal(old.facet)) < 0 ? -sense : sense;
            return true;
        }
        if (std::abs(along) > 0.7 && share_a_corner(mesh_.facets[old.facet], facet)) {
            side = along < 0 ? -1 : 1;
            return true;
        }
    }
    return false;
}

/// The side of a sheet on which a node was a step ago, if it was over the facet then; else the side it is on.
double TouchFinder::side_of_new(const Near& near, double distance) const
{
    const double now = distance < 0 ? -1 : 1;
    if (motion_.last_step == 0) return now;
    const auto& corner = mesh_.facets[near.facet].corner;
    const SegmentCorners<double> corners{motion_.previous(corner[0]), motion_.previous(corner[1]),
                                         motion_.previous(corner[2]), motion_.previous(corner[3])};
    const auto old = closest_point(motion_.previous(near.node), corners);
    if (old.feature != 0) return now;
    return dot(old.offset, segment_normal(corners, old.s, old.t)) < 0 ? -1 : 1;
}

/// What a node has come closer to a facet's point along the normal in the last step, to first order.
double TouchFinder::approach(Index node, Index number, double s, double t, const Vec3& normal) const
{
    const Facet& facet = mesh_.facets[number];
    const auto share = corner_shares(s, t, facet.triangle());
    Vec3 velocity = -motion_.velocity[node];
    for (int i = 0; i < 4; ++i) velocity += share[i] * motion_.velocity[facet.corner[i]];
    return motion_.last_step * dot(velocity, normal);
}

/// Bound of what approach() leaves out: the facet turns while the node slides over it.
double TouchFinder::turned_under(Index node, Index number, double s, double t, const Vec3& normal) const
{
    const Facet& facet = mesh_.facets[number];
    const auto share = corner_shares(s, t, facet.triangle());
    Vec3 foot{};
    for (int i = 0; i < 4; ++i) foot += share[i] * motion_.velocity[facet.corner[i]];
    double turn2 = 0;
    for (const Index corner : facet.corner) {
        const Vec3 past = motion_.velocity[corner] - foot;
        turn2 = std::max(turn2, dot(past, past));
    }
    const Vec3 past = motion_.velocity[node] - foot;
    const double slide = norm(past - dot(past, normal) * normal);
    return 2 * motion_.last_step * motion_.last_step * std::sqrt(turn2) * slide / facet.size;
}

/// Whether a node inside a solid was outside a step ago (or is there in the first cycle).
bool TouchFinder::comes_from_outside(const Near& near, const Vec3& normal, double distance) const
{
    if (motion_.last_step == 0) return true;
    const double before = distance + approach(near.node, near.facet, near.s, near.t, normal);
    return before >= -entry * mesh_.facets[near.facet].depth;
}

/// Sum of the normals of the facets around an edge or corner.
Vec3 TouchFinder::normal_around(const Near& near) const
{
    const int corner = near.feature - static_cast<int>(Feature::corner);
    const auto around = corner < 0 ? mesh_.facets_at_edge(mesh_.facet_edges[near.facet][near.feature - 1])
                                   : mesh_.facets_at_node(mesh_.facets[near.facet].corner[corner]);
    Vec3 outward{};
    for (Index other : around) outward += facet_normal(other);
    return outward;
}

/// Whether no facet beside the edge or corner is closer.
bool TouchFinder::closest_of_feature(const Near& near) const
{
    const Facet& facet = mesh_.facets[near.facet];
    const auto place = [&](Index node) -> const Vec3& { return motion_.position[node]; };
    const double tolerance = 1e-9 * facet.size * facet.size;
    const bool needs_neighbour = facet.one_sided || square_edges_;
    if (near.feature < static_cast<int>(Feature::corner)) {
        const Index edge = mesh_.facet_edges[near.facet][near.feature - 1];
        if (edge == none) return false;
        const auto around = mesh_.facets_at_edge(edge);
        if (around.size() < 2) return !needs_neighbour;
        const Vec3 from = place(mesh_.edge_corner[edge][0]);
        const Vec3 along = unit(place(mesh_.edge_corner[edge][1]) - from);
        for (Index other : around) {
            if (other == near.facet) continue;
            Vec3 inward{};
            for (Index corner : mesh_.facets[other].corner) inward += place(corner) - from;
            inward -= dot(inward, along) * along;
            if (dot(near.offset, inward) > tolerance) return false;
        }
        return true;
    }
    const Index node = facet.corner[near.feature - static_cast<int>(Feature::corner)];
    if (needs_neighbour && mesh_.on_rim[node]) return false;
    for (const Index far : mesh_.neighbours_of(node))
        if (dot(near.offset, place(far) - place(node)) > tolerance) return false;
    return true;
}

/// Whether a node of a solid looks towards a surface with this normal: nodes of a face that slides along do
/// not catch on the flank of the other body.
bool TouchFinder::faces(Index node, const Vec3& normal) const
{
    Vec3 own{};
    for (Index facet : mesh_.facets_at_node(node)) {
        if (mesh_.segments[facet].solid != none) own += facet_normal(facet);
    }
    return dot(own, own) == 0 || dot(own, normal) < -0.05 * norm(own);
}

/// Normal and distance where the closest point lies on an edge or corner.
bool TouchFinder::touch_on_rim(const Near& near, std::span<const Touch> before, Vec3& normal,
                               double& distance, bool& known) const
{
    const Facet& facet = mesh_.facets[near.facet];
    const double gap = mesh_.nodes[near.node].half_thickness + facet.half_thickness;
    distance = std::sqrt(near.distance2);
    if (distance >= gap && !facet.one_sided && before.empty()) return false;
    if (!closest_of_feature(near)) return false;
    const bool at_surface = distance <= 1e-12 * facet.size;
    const Vec3 outward = facet.one_sided || at_surface ? normal_around(near) : Vec3{};
    normal = at_surface ? unit(outward) : (1 / distance) * near.offset;
    double side = 1;
    if (facet.one_sided) {
        if (dot(normal, outward) < 0) side = -1;
        known = keeps_side(near, before, side * normal, side);
    } else {
        // Around an edge the side turns with the node: what counts is where it was before.
        for (const Touch& old : before) {
            if (dot(old.normal, normal) < -0.7 && share_a_corner(mesh_.facets[old.facet], facet)) side = -1;
        }
    }
    normal = side * normal;
    distance = side * distance;
    return true;
}

bool TouchFinder::touch_of(const Near& near, std::span<const Touch> before, Touch& touch) const
{
    const Facet& facet = mesh_.facets[near.facet];
    const double gap = mesh_.nodes[near.node].half_thickness + facet.half_thickness;
    Vec3 normal = near.normal;
    double distance = dot(near.offset, normal);
    bool known = false;
    // An oriented facet without thickness reaches a little beyond its sides: nodes of matching meshes must
    // not fall off at the rim. With a thickness the round rim holds them.
    const double beyond = facet.one_sided ? overhang * facet.size - gap : -1;
    if (near.feature == 0 || (beyond > 0 && norm(near.offset - distance * normal) <= beyond)) {
        double side = 1;
        known = keeps_side(near, before, normal, side);
        if (!facet.one_sided && !known) side = side_of_new(near, distance);
        normal = side * normal;
        distance = side * distance;
    } else if (!touch_on_rim(near, before, normal, distance, known)) {
        return false;
    }
    if (distance >= gap || distance < -facet.depth) return false;
    if (facet.one_sided && !known) {
        if (!faces(near.node, normal)) return false;
        if (distance < 0 && !comes_from_outside(near, normal, distance)) return false;
    }
    touch.node = near.node;
    touch.facet = near.facet;
    touch.s = near.s;
    touch.t = near.t;
    touch.normal = normal;
    touch.penetration = gap - distance;
    return true;
}

/// What a touch takes over from the one that it goes on with, or begins with.
void TouchFinder::inherit(std::span<const Touch> before, Touch& touch) const
{
    const Touch* nearest = nullptr;
    double best = 0.5;
    for (const Touch& old : before) {
        const double along = dot(old.normal, touch.normal);
        if (along <= best) continue;
        best = along;
        nearest = &old;
    }
    if (!nearest) {
        // What the approach of the last step does not explain was there before: it is kept as a baseline.
        const double closer =
            std::max(0.0, approach(touch.node, touch.facet, touch.s, touch.t, touch.normal));
        touch.baseline = std::max(0.0, touch.penetration - 1.5 * closer);
        touch.rounding = closer;
        return;
    }
    touch.baseline = std::min(nearest->baseline, touch.penetration);
    touch.rounding = nearest->rounding;
    touch.weight = nearest->weight;
    touch.friction = nearest->friction;
    if (nearest->facet == touch.facet) {
        touch.stiffness = nearest->stiffness;
        return;
    }
    // On one surface a touch gets deeper by what the node and the facets have moved towards one another:
    // outside it by no more than towards the new facet, which was not the closest before, and inside by no
    // more than towards the old one, which is not now. What is more is another surface, which was held off by
    // this touch so far: the node was that deep in it before.
    const auto closer_to = [&](const Touch& one) {
        return std::max(0.0, approach(one.node, one.facet, one.s, one.t, one.normal)) +
               turned_under(one.node, one.facet, one.s, one.t, one.normal);
    };
    const double explained =
        std::max(0.0, nearest->active_penetration()) + std::max(closer_to(touch), closer_to(*nearest));
    touch.baseline = std::max(touch.baseline, touch.penetration - explained);
}

/// Takes the closest facets first, and others only where they hold the node from clearly another direction.
void TouchFinder::resolve(std::span<const Near> near, std::span<const Touch> before,
                          std::vector<const Near*>& order, std::vector<Touch>& touches) const
{
    order.clear();
    for (const Near& one : near)
        if (!one.over) order.push_back(&one);
    std::sort(order.begin(), order.end(), [](const Near* a, const Near* b) {
        return std::pair(a->distance2, a->facet) < std::pair(b->distance2, b->facet);
    });
    for (const Near* nearest : order) {
        const Near& one = *nearest;
        if (touches.size() == TouchTable::layers) break;
        const auto beside = [&](const Vec3& direction, double length) {
            for (const Touch& other : touches) {
                if (dot(other.normal, direction) >= 0.5 * length) return true;
            }
            return false;
        };
        const double distance = std::sqrt(one.distance2);
        if (distance > 0 && beside(one.offset, distance)) continue;
        Touch touch;
        if (!touch_of(one, before, touch) || beside(touch.normal, 1)) continue;
        inherit(before, touch);
        touches.push_back(touch);
    }
}

} // namespace plash
