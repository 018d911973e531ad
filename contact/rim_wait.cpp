#include "contact/touch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plash {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Share of a facet's shortest side that the closest point may slide while a wait at the rim lasts.
constexpr double share_of_side = 0.5;

/// Of distances, as a share of a facet's size.
constexpr double round_off = 1e-9;

/// Bound of the rate at which the offset of a node from the closest point of an edge changes with the path of
/// the nodes relative to one another: the node and the edge's start go by that path, the edge's direction by
/// its ratio to the length, over the length up to the point and over the distance. Taken with some room.
double rate_at_edge(double distance, double length)
{
    return 2.5 + 2 * distance / length;
}

} // namespace

/// An edge or corner that the closest point may reach.
struct TouchFinder::Rim {
    Vec3 offset{};    ///< from its closest point to the node
    double rate = 1;  ///< of the offset with the path
    double slide = 0; ///< bound of the change of the offset while the wait lasts [length]

    /// Path over which the product of the offset with a vector stays above the tolerance. The vector is no
    /// longer than `size` and changes by `turn` of the path.
    double path(const Vec3& vector, double size, double turn, double tolerance) const
    {
        return (dot(offset, vector) - tolerance) / (rate * size + (norm(offset) + slide) * turn);
    }
};

/// Path before which an edge of a facet cannot touch a node that is farther than the thickness: another facet
/// is closer all the time, or (solids) the node stays in front.
double TouchFinder::wait_at_edge(const Near& near, int side, double slide) const
{
    const ContactMesh::Facet& facet = mesh_.facets[near.facet];
    const Index edge = mesh_.facet_edges[near.facet][side];
    if (edge == none) return never;
    const auto around = mesh_.facets_at_edge(edge);
    if (around.size() < 2) return facet.one_sided || square_edges_ ? never : 0;
    const auto place = [&](Index node) -> const Vec3& { return motion_.position[node]; };
    const Vec3 from = place(mesh_.edge_corner[edge][0]);
    const Vec3 reach = place(mesh_.edge_corner[edge][1]) - from;
    const double length = norm(reach);
    if (length == 0) return 0;
    const Vec3 along = (1 / length) * reach;
    Rim rim;
    rim.offset = place(near.node) - from;
    rim.offset -= std::clamp(dot(rim.offset, along), 0.0, length) * along;
    rim.rate = rate_at_edge(norm(rim.offset), length);
    rim.slide = slide;
    const double tolerance = 1e-9 * facet.size * facet.size;
    double wait = 0;
    for (Index other : around) {
        if (other == near.facet) continue;
        Vec3 inward{};
        for (Index corner : mesh_.facets[other].corner) inward += place(corner) - from;
        const double size = norm(inward);
        inward -= dot(inward, along) * along;
        wait = std::max(wait, rim.path(inward, size, 4 + 2 * size / length, tolerance));
    }
    return facet.one_sided ? std::max(wait, wait_in_front(rim, around)) : wait;
}

/// The same for a corner.
double TouchFinder::wait_at_corner(const Near& near, int corner, double slide) const
{
    const ContactMesh::Facet& facet = mesh_.facets[near.facet];
    const Index node = facet.corner[corner];
    if ((facet.one_sided || square_edges_) && mesh_.on_rim[node]) return never;
    Rim rim;
    rim.offset = motion_.position[near.node] - motion_.position[node];
    rim.slide = slide;
    const double tolerance = 1e-9 * facet.size * facet.size;
    double wait = 0;
    for (const Index far : mesh_.neighbours_of(node)) {
        const Vec3 edge = motion_.position[far] - motion_.position[node];
        wait = std::max(wait, rim.path(edge, norm(edge), 1, tolerance));
    }
    return facet.one_sided ? std::max(wait, wait_in_front(rim, mesh_.facets_at_node(node))) : wait;
}

/// Path before which a node cannot come behind the mean plane of some faces of solids. A unit normal turns by
/// at most twice the path times the sum of the middle lines over the area.
double TouchFinder::wait_in_front(const Rim& rim, std::span<const Index> around) const
{
    Vec3 outward{};
    double turn = 0;
    const auto& p = motion_.position;
    for (Index other : around) {
        const auto& corner = mesh_.facets[other].corner;
        const Vec3 first = 0.5 * (p[corner[1]] - p[corner[0]] + p[corner[2]] - p[corner[3]]);
        const Vec3 second = 0.5 * (p[corner[3]] - p[corner[0]] + p[corner[2]] - p[corner[1]]);
        const double area = norm(cross(first, second));
        if (area == 0) return 0;
        outward += facet_normal(other);
        turn += 2 * (norm(first) + norm(second)) / area;
    }
    return std::max(0.0, rim.path(outward, static_cast<double>(around.size()), turn, 0));
}

/// Path before which a node whose closest point lies on the rim of a facet, farther than the thickness,
/// cannot touch that rim, nor the edges and corners that the closest point may reach meanwhile: such a touch
/// is one from behind, and needs that no facet around is closer (touch_on_rim()).
double TouchFinder::wait_at_rim(const Near& near, double gap) const
{
    const ContactMesh::Facet& facet = mesh_.facets[near.facet];
    const bool triangle = facet.triangle();
    const int corners = triangle ? 3 : 4;
    const auto place = [&](int corner) -> const Vec3& { return motion_.position[facet.corner[corner]]; };
    double shortest = never;
    for (int i = 0; i < corners; ++i)
        shortest = std::min(shortest, norm(place((i + 1) % corners) - place(i)));
    if (shortest == 0) return 0;
    const double distance = std::sqrt(near.distance2), slide = share_of_side * shortest;
    // Nodes that stand at the thickness but for round-off may touch now.
    double wait = distance - gap - round_off * facet.size;
    wait = std::min(wait, slide / rate_at_edge(distance, shortest));

    // A triangle a b c c has its third side, c a, as number 3, and c as corner 2 and 3.
    const auto side_of = [&](int corner) { return triangle && corner == 2 ? 3 : corner; };
    int corner = near.feature - static_cast<int>(Feature::corner);
    if (corner < 0) {
        const int side = near.feature - static_cast<int>(Feature::edge);
        wait = std::min(wait, wait_at_edge(near, side, slide));
        const int from = triangle && side == 3 ? 2 : side, to = (from + 1) % corners;
        const Vec3 foot = motion_.position[near.node] - near.offset;
        const double to_start = norm(foot - place(from)), to_end = norm(foot - place(to));
        if (std::min(to_start, to_end) > slide) return wait;
        corner = to_start < to_end ? from : to;
    }
    corner = std::min(corner, corners - 1);
    if (wait > 0) wait = std::min(wait, wait_at_corner(near, corner, slide));
    Rim rim;
    rim.offset = motion_.position[near.node] - place(corner);
    rim.slide = slide;
    const int last = (corner + corners - 1) % corners, next = (corner + 1) % corners;
    for (const auto& [side, end] : {std::pair(corner, next), std::pair(last, last)}) {
        if (wait <= 0) break;
        const Vec3 back = place(corner) - place(end);
        const double off_edge = rim.path(back, norm(back), 1, 0); // it stays beyond the corner
        if (off_edge < wait)
            wait = std::min(wait, std::max(off_edge, wait_at_edge(near, side_of(side), slide)));
    }
    return wait;
}

} // namespace plash
