#include "ale/mesh_boundary.h"

#include "core/prescribed_rate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <unordered_map>

namespace plash {

namespace {

constexpr unsigned all_axes = 7;

int axis_of(const Vec3& direction)
{
    const double parts[3] = {direction.x, direction.y, direction.z};
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(std::abs(parts[axis]) - 1) < 1e-12) return axis;
    return -1;
}

/// Sums of the areas of outer faces by node; faces that meet at an edge of the mesh apart.
using WallDirections = std::map<std::ptrdiff_t, std::vector<Vec3>>;

/// A wall that is bent by less than 30 degrees is one.
void add_wall(std::vector<Vec3>& directions, const Vec3& area)
{
    for (Vec3& known : directions)
        if (dot(unit(known), unit(area)) > 0.866) {
            known += area;
            return;
        }
    directions.push_back(area);
}

} // namespace

MeshBoundary mesh_boundary_of(const Fluid& fluid, const MeshBlock& block, const FluidSettings& settings,
                              const Model& model)
{
    MeshBoundary boundary;
    std::unordered_map<Index, std::ptrdiff_t> place; // of the mesh's nodes
    place.reserve(block.nodes.size());
    for (std::size_t number = 0; number < block.nodes.size(); ++number)
        place.emplace(block.nodes[number], fluid.node_place(number));

    std::unordered_map<std::ptrdiff_t, std::size_t> known;
    const auto hold = [&](std::ptrdiff_t node, unsigned axes) {
        const auto [found, added] = known.try_emplace(node, boundary.held.size());
        if (added) boundary.held.push_back({node, 0, {}, {}});
        boundary.held[found->second].axes |= axes;
        return found->second;
    };
    using Boundary = FluidSettings::Boundary;
    WallDirections oblique;
    const auto exempt = [&](const OuterNode& node) {
        return !settings.exempt.empty() && settings.exempt[block.nodes[node.number]];
    };
    if (settings.boundary != Boundary::open) {
        for (const OuterNode& node : fluid.outer_nodes()) {
            if (exempt(node)) continue;
            if (settings.boundary == Boundary::stick)
                hold(fluid.node_place(node.number), all_axes);
            else if (node.axis >= 0)
                hold(fluid.node_place(node.number), 1u << node.axis);
            else
                add_wall(oblique[fluid.node_place(node.number)], node.area);
        }
    }
    for (const FixedNodes& fixed : model.fixed_nodes) {
        if ((fixed.freedoms & all_axes) == 0) continue;
        for (Index node : fixed.nodes) {
            const auto found = place.find(node);
            if (found == place.end()) continue;
            if (fixed.birth > 0 || fixed.death < forever)
                throw DeckError(fixed.where, fmt::format("node {} of an Eulerian mesh is held for a time "
                                                         "only; there it can be held for good",
                                                         model.nodes.id[node]));
            hold(found->second, fixed.freedoms & all_axes);
        }
    }
    for (const PrescribedMotion& motion : model.prescribed_motions) {
        for (Index node : motion.nodes) {
            const auto found = place.find(node);
            if (found == place.end()) continue;
            const int axis = axis_of(motion.direction);
            if (axis < 0 || motion.rotation || motion.kind != PrescribedMotion::Kind::velocity ||
                motion.birth > 0 || motion.death < forever)
                throw DeckError(motion.where, fmt::format("node {} of an Eulerian mesh can be driven by a "
                                                          "velocity along a global axis for the whole run "
                                                          "only",
                                                          model.nodes.id[node]));
            boundary.driven.push_back({hold(found->second, 1u << axis), axis, &motion});
        }
    }
    for (auto& [node, directions] : oblique) {
        const auto found = known.find(node);
        const unsigned axes = found == known.end() ? 0 : boundary.held[found->second].axes;
        for (int axis = 0; axis < 3; ++axis)
            if (axes & (1u << axis))
                directions.push_back(axis == 0 ? Vec3{1, 0, 0} : axis == 1 ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
        // Axes first: a velocity that they hold stays held.
        std::rotate(directions.begin(), directions.end() - std::popcount(axes), directions.end());
        std::array<Vec3, 3> across;
        const int count = span_of(directions, across);
        if (count == 3)
            hold(node, all_axes);
        else
            boundary.slipping.push_back({node, count, {across[0], across[1]}});
    }
    std::unordered_map<std::ptrdiff_t, unsigned> outer; // axes across whose outer faces a node lies
    for (const OuterNode& node : fluid.outer_nodes())
        if (node.axis >= 0 || settings.boundary != Boundary::slip || exempt(node))
            outer[fluid.node_place(node.number)] |= node.axis < 0 ? all_axes : 1u << node.axis;
    for (const auto& [node, axes] : outer) {
        const auto found = known.find(node);
        const unsigned held = found == known.end() ? 0 : boundary.held[found->second].axes;
        boundary.open = boundary.open || (axes & ~held) != 0;
    }
    // A velocity along an outer face's normal lets fluid in or out.
    for (const DrivenHold& driven : boundary.driven) {
        const auto found = outer.find(boundary.held[driven.held].place);
        boundary.open = boundary.open || (found != outer.end() && (found->second & (1u << driven.axis)) != 0);
    }
    return boundary;
}

void MeshBoundary::follow(const Model& model, double time, double step)
{
    for (const DrivenHold& entry : driven) {
        const PrescribedMotion& motion = *entry.motion;
        const Vec3& d = motion.direction;
        const double sign = entry.axis == 0 ? d.x : entry.axis == 1 ? d.y : d.z;
        const auto at = [&](double when) {
            return sign * motion.scale * curve_value(model, motion.curve, when);
        };
        held[entry.held].before[entry.axis] = at(time);
        held[entry.held].after[entry.axis] = at(time + step);
    }
}

} // namespace plash
