#include "contact/closest_point.h"
#include "contact/touch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plash {

namespace {

/// Share of its size by which a node may slide over a facet until its touches are found anew. Beyond the
/// facet's sides it goes on in the facet's plane meanwhile, as LS-DYNA's MAXPAR = 1.025 lets it.
constexpr double free_path = 0.025;

/// Share of the contact thickness by which a node may slide over the free side of a sheet until then: the
/// round rim, whose distance grows with the square of that path, would let it go by less than a
/// five-thousandth of the thickness meanwhile.
constexpr double rim_path = 0.02;

/// Cosine of the angle up to which facets that meet at an edge count as one plane.
constexpr double nearly_flat = 0.99;

constexpr double any_path = std::numeric_limits<double>::infinity();

/// Of penetrations, as a share of a facet's size.
constexpr double same_depth = 1e-9;

} // namespace

/// Whether the facets around a facet lie nearly in its plane.
bool TouchFinder::flat_around(Index facet) const
{
    const Vec3 own = facet_normal(facet);
    const int corners = mesh_.facets[facet].triangle() ? 3 : 4;
    for (int i = 0; i < corners; ++i) {
        for (Index other : mesh_.facets_at_node(mesh_.facets[facet].corner[i]))
            if (std::abs(dot(facet_normal(other), own)) < nearly_flat) return false;
    }
    return true;
}

/// Whether a touch goes on at the same depth when its node is followed in the facet's plane. Where it turns
/// around an edge or a corner, and the plane is closer than that, the node would be pressed without having
/// moved: with foils even a thousandth of the thickness is more than a step brings.
bool TouchFinder::goes_on_in_plane(const Touch& touch) const
{
    const auto& facet = mesh_.facets[touch.facet];
    const auto& p = motion_.position;
    const SegmentCorners<double> corners{p[facet.corner[0]], p[facet.corner[1]], p[facet.corner[2]],
                                         p[facet.corner[3]]};
    const auto foot = foot_near(p[touch.node], corners, touch.s, touch.t);
    const Vec3 normal = segment_normal(corners, foot.s, foot.t);
    const double side = dot(facet_normal(touch.facet), touch.normal) < 0 ? -1 : 1;
    const double gap = mesh_.half_thickness[touch.node] + facet.half_thickness;
    return std::abs(gap - side * dot(foot.offset, normal) - touch.penetration) <= same_depth * facet.size;
}

/// Path that the node may go without leaving the facet; in a skewed one the sides are closer than its size
/// says.
double TouchFinder::within(const Touch& touch) const
{
    const auto& facet = mesh_.facets[touch.facet];
    const double inside = facet.triangle() ? std::min({touch.s, touch.t, 1 - touch.s - touch.t})
                                           : std::min({touch.s, 1 - touch.s, touch.t, 1 - touch.t});
    return 0.5 * std::max(0.0, inside) * facet.size;
}

/// Path that the node may go without leaving the facet, its plane, or the free side of its sheet by much.
double TouchFinder::room_of(const Touch& touch, int feature) const
{
    if (feature != 0 && !goes_on_in_plane(touch)) return 0;
    const auto& facet = mesh_.facets[touch.facet];
    const bool rim = std::any_of(facet.corner.begin(), facet.corner.end(),
                                 [&](Index corner) { return mesh_.on_rim[corner] != 0; });
    const bool round = !square_edges_ && !facet.one_sided;
    if ((!rim || round) && std::abs(dot(facet_normal(touch.facet), touch.normal)) > 0.999 &&
        flat_around(touch.facet)) {
        const double gap = mesh_.half_thickness[touch.node] + facet.half_thickness;
        return rim ? std::min(free_path * facet.size, rim_path * gap) : free_path * facet.size;
    }
    if (feature != 0) return 0;
    return std::min(free_path * facet.size, within(touch));
}

/// Whether a touch keeps its node from touching another facet: it presses from about the direction in which
/// the node lies from this. Faces of solids press along their normal from wherever a node is, and a node that
/// rests on many of them in one plane, as on a corner that several bodies have in common, touches one.
bool TouchFinder::holds_off(const Touch& touch, const Near& near) const
{
    if (mesh_.facets[near.facet].one_sided && dot(touch.normal, near.normal) > nearly_flat) return true;
    const double distance = std::sqrt(near.distance2);
    return !near.over && distance > 0 && dot(touch.normal, near.offset) >= 0.6 * distance;
}

/// Path before which a facet that is held off by a touch does not take the node over. In the plane of the
/// touch, one of the same sheet goes on at the same depth if it is as thick, else it begins where the node
/// leaves the facet; one of another surface has to become the closer one. One at an angle may come to be the
/// deeper by no more than a share of the contact thickness.
double TouchFinder::room_beside(const Near& near, std::span<const Touch> touches) const
{
    const ContactMesh::Facet& facet = mesh_.facets[near.facet];
    for (const Touch& touch : touches) {
        const bool in_plane = std::abs(dot(touch.normal, near.normal)) > nearly_flat;
        if (!in_plane || !holds_off(touch, near)) continue;
        const ContactMesh::Facet& touched = mesh_.facets[touch.facet];
        if (share_a_corner(touched, facet)) {
            return touched.half_thickness == facet.half_thickness ? any_path : within(touch);
        }
        const double gap = mesh_.half_thickness[touch.node] + touched.half_thickness;
        return 0.5 * std::max(0.0, std::sqrt(near.distance2) - std::abs(gap - touch.penetration));
    }
    return rim_path * (mesh_.half_thickness[near.node] + facet.half_thickness);
}

/// Path before which the touches of a node stay as they are but for where exactly on their facets, and no
/// other can begin: pairs that are near have to be held off by a touch.
double TouchFinder::quiet_until(const PairList& pairs, std::size_t owner, std::span<const Near> near,
                                std::span<const Touch> touches) const
{
    const auto touch_with = [&](const Near& one) {
        return std::find_if(touches.begin(), touches.end(),
                            [&](const Touch& touch) { return touch.facet == one.facet; });
    };
    for (const Near& one : near) {
        const bool held = std::any_of(touches.begin(), touches.end(),
                                      [&](const Touch& other) { return holds_off(other, one); });
        if (!held && touch_with(one) == touches.end()) return 0;
    }
    const double now = pairs.paths.now(owner);
    double until = pairs.others_due[owner];
    for (Index pair = pairs.begin[owner]; pair < pairs.begin[owner] + pairs.close[owner]; ++pair)
        if (pairs.due[pair] > now) until = std::min(until, pairs.due[pair]);
    for (const Near& one : near) {
        if (until <= now) break;
        const auto touch = touch_with(one);
        const double room = touch != touches.end() ? room_of(*touch, one.feature) : room_beside(one, touches);
        until = std::min(until, pairs.paths.travelled(owner) + room);
    }
    return until;
}

} // namespace plash
