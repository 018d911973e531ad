#include "ale/mesh_boundary.h"

#include "core/prescribed_rate.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unordered_map>

namespace plash {

namespace {

constexpr unsigned all_axes = 7;

/// Calls visit(i, j, k, axis) for every node of every outer face across an axis.
template <class Visit>
void for_outer_nodes(const BoxGrid& grid, Visit&& visit)
{
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        int index[3];
        for (int side = 0; side < 2; ++side) {
            index[axis] = side * grid.cells(axis);
            for (index[b] = 0; index[b] <= grid.cells(b); ++index[b])
                for (index[a] = 0; index[a] <= grid.cells(a); ++index[a])
                    visit(index[0], index[1], index[2], axis);
        }
    }
}

int axis_of(const Vec3& direction)
{
    const double parts[3] = {direction.x, direction.y, direction.z};
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(std::abs(parts[axis]) - 1) < 1e-12) return axis;
    return -1;
}

} // namespace

MeshBoundary mesh_boundary_of(const BoxGrid& grid, const MeshBlock& block, const FluidSettings& settings,
                              const Model& model)
{
    MeshBoundary boundary;
    std::unordered_map<Index, std::ptrdiff_t> place; // of the block's nodes
    place.reserve(block.nodes.size());
    for (int k = 0; k <= grid.cells(2); ++k)
        for (int j = 0; j <= grid.cells(1); ++j)
            for (int i = 0; i <= grid.cells(0); ++i)
                place.emplace(block.nodes[block.node(i, j, k)], grid.at(i, j, k));

    std::unordered_map<std::ptrdiff_t, std::size_t> known;
    const auto hold = [&](std::ptrdiff_t node, unsigned axes) {
        const auto [found, added] = known.try_emplace(node, boundary.held.size());
        if (added) boundary.held.push_back({node, 0, {}, {}});
        boundary.held[found->second].axes |= axes;
        return found->second;
    };
    using Boundary = FluidSettings::Boundary;
    if (settings.boundary != Boundary::open) {
        for_outer_nodes(grid, [&](int i, int j, int k, int axis) {
            if (!settings.exempt.empty() && settings.exempt[block.nodes[block.node(i, j, k)]]) return;
            hold(grid.at(i, j, k), settings.boundary == Boundary::stick ? all_axes : 1u << axis);
        });
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
    std::unordered_map<std::ptrdiff_t, unsigned> outer; // axes across whose outer faces a node lies
    for_outer_nodes(grid, [&](int i, int j, int k, int axis) { outer[grid.at(i, j, k)] |= 1u << axis; });
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
