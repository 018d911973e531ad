#include "contact/closest_point.h"
#include "contact/touch.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace plash {

namespace {

/// Share of its size by which a node may slide over a facet until its touches are found anew. Beyond the
/// facet's sides it goes on in the facet's plane meanwhile, as LS-DYNA's MAXPAR = 1.025 lets it.
constexpr double free_path = 0.025;

/// Cosine of the angle up to which facets that meet at an edge count as one plane.
constexpr double nearly_flat = 0.99;

} // namespace

/// Whether a facet has neighbours on all sides, nearly in its plane.
bool TouchFinder::flat_around(Index facet) const
{
    const Vec3 own = facet_normal(facet);
    const int corners = mesh_.facets[facet].triangle() ? 3 : 4;
    for (int i = 0; i < corners; ++i) {
        const auto around = mesh_.facets_at_node(mesh_.facets[facet].corner[i]);
        if (mesh_.on_rim[mesh_.facets[facet].corner[i]]) return false;
        for (Index other : around)
            if (std::abs(dot(facet_normal(other), own)) < nearly_flat) return false;
    }
    return true;
}

/// Path that the node may go without leaving the facet, or its plane.
double TouchFinder::room_of(const Touch& touch, int feature) const
{
    const auto& facet = mesh_.facets[touch.facet];
    if (flat_around(touch.facet) && std::abs(dot(facet_normal(touch.facet), touch.normal)) > 0.999)
        return free_path * facet.size;
    if (feature != 0) return 0;
    const double inside = facet.triangle() ? std::min({touch.s, touch.t, 1 - touch.s - touch.t})
                                           : std::min({touch.s, 1 - touch.s, touch.t, 1 - touch.t});
    // In a skewed facet the sides are closer than its size says.
    return std::min(free_path, 0.5 * inside) * facet.size;
}

/// Path before which the touches of a node stay as they are but for where exactly on their facets, and no
/// other can begin: pairs that are near have to be held off by a touch from about the same direction.
double TouchFinder::quiet_until(const PairList& pairs, std::size_t owner, std::span<const Near> near,
                                std::span<const Touch> touches) const
{
    double until = 1e300;
    for (Index pair = pairs.begin[owner]; pair < pairs.begin[owner + 1]; ++pair)
        if (pairs.due[pair] > motion_.travelled + motion_.step_range)
            until = std::min(until, pairs.due[pair]);
    for (const Near& one : near) {
        const auto own = [&](const Touch& touch) { return touch.facet == one.facet; };
        const auto touch = std::find_if(touches.begin(), touches.end(), own);
        if (touch != touches.end()) {
            until = std::min(until, motion_.travelled + room_of(*touch, one.feature));
            continue;
        }
        const double distance = std::sqrt(one.distance2);
        const bool held_off = std::any_of(touches.begin(), touches.end(), [&](const Touch& other) {
            return distance > 0 && dot(other.normal, one.offset) >= 0.6 * distance;
        });
        if (!held_off) return 0;
    }
    return until;
}

/// Brings touches to where their nodes are now. Returns whether one has ended (penetration not above zero).
bool TouchFinder::follow(std::span<Touch* const> batch) const
{
    alignas(sizeof(Lanes)) double place[17][lane_count];
    for (int lane = 0; lane < lane_count; ++lane) {
        const Touch& touch = *batch[std::min<std::size_t>(lane, batch.size() - 1)];
        const auto& facet = mesh_.facets[touch.facet];
        const auto put = [&](int row, const Vec3& p) {
            place[row][lane] = p.x;
            place[row + 1][lane] = p.y;
            place[row + 2][lane] = p.z;
        };
        put(0, motion_.position[touch.node]);
        for (int corner = 0; corner < 4; ++corner)
            put(3 + 3 * corner, motion_.position[facet.corner[corner]]);
        place[15][lane] = touch.s;
        place[16][lane] = touch.t;
    }
    const auto row = [&](int number) {
        Lanes lanes;
        std::memcpy(&lanes, place[number], sizeof lanes);
        return lanes;
    };
    const auto get = [&](int first) { return Vector3<Lanes>{row(first), row(first + 1), row(first + 2)}; };
    const SegmentCorners<Lanes> corners{get(3), get(6), get(9), get(12)};
    const auto foot = foot_near(get(0), corners, row(15), row(16));
    const auto normal = segment_normal(corners, foot.s, foot.t);
    const Lanes height = dot(foot.offset, normal);
    bool ended = false;
    for (int lane = 0; lane < static_cast<int>(batch.size()); ++lane) {
        Touch& touch = *batch[lane];
        const auto& facet = mesh_.facets[touch.facet];
        const Vec3 upward{normal.x[lane], normal.y[lane], normal.z[lane]};
        const double side = dot(upward, touch.normal) < 0 ? -1 : 1, distance = side * height[lane];
        const double gap = mesh_.nodes[touch.node].half_thickness + facet.half_thickness;
        touch.s = foot.s[lane];
        touch.t = foot.t[lane];
        touch.normal = side * upward;
        touch.penetration = distance < -facet.depth ? 0 : gap - distance;
        touch.baseline = std::min(touch.baseline, touch.penetration);
        ended = ended || touch.penetration <= 0;
    }
    return ended;
}

/// Nodes one of whose touches has ended are not quiet any more.
void TouchFinder::drop_ended(PairList& pairs, std::size_t begin, std::size_t end,
                             std::vector<Touch>& touches) const
{
    std::size_t kept = 0, owner = begin;
    for (std::size_t i = 0; i < touches.size(); ++i) {
        const Touch touch = touches[i];
        if (touch.penetration > 0) {
            touches[kept++] = touch;
            continue;
        }
        while (owner < end && pairs.owner[owner] < touch.node) ++owner;
        if (owner < end && pairs.owner[owner] == touch.node) pairs.quiet[owner] = 0;
    }
    touches.resize(kept);
    for (std::size_t i = kept; i-- > 0;) {
        const bool goes_on = i + 1 < kept && touches[i + 1].node == touches[i].node;
        touches[i].count = goes_on ? touches[i + 1].count + 1 : 1;
    }
}

} // namespace plash
