#include "ale/absorbing_nodes.h"

#include "conditions/segment_forces.h"
#include "model/eulerian.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <unordered_map>

namespace plash {

namespace {

using FaceNodes = std::array<Index, 4>;

FaceNodes in_rising_order(FaceNodes nodes)
{
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

/// Pressure and impedance of a cell as it stands at the start.
struct CellSide {
    double pressure = 0;  ///< [pressure]
    double impedance = 0; ///< density times speed of sound [pressure/velocity]
};

CellSide side_of(const Fluid& fluid, const FluidCell& cell)
{
    const FluidFields& fields = fluid.fields;
    CellSide side;
    double filled = 0;
    for (std::size_t g = 0; g < fields.groups.size(); ++g) {
        const GroupFields& own = fields.groups[g];
        const double mass = own.mass[cell.place];
        const double share = own.fraction.empty() ? 1 : own.fraction[cell.place];
        if (!(mass > 0 && share > 0)) continue;
        const double density = mass / (share * cell.volume);
        const double stiffness =
            fluid_state(fluid.groups[g], density, own.energy[cell.place] / mass).stiffness;
        side.impedance += share * std::sqrt(density * stiffness);
        filled += share;
    }
    if (filled > 0) side.pressure = fields.pressure[cell.place];
    return side;
}

} // namespace

std::vector<AbsorbingNode> absorbing_nodes_of(const Fluid& fluid, const MeshBlock& block, const Model& model)
{
    std::vector<AbsorbingNode> nodes;
    if (model.non_reflecting_boundaries.empty()) return nodes;
    std::unordered_map<Index, std::size_t> number; // of the mesh's nodes
    for (std::size_t i = 0; i < block.nodes.size(); ++i) number.emplace(block.nodes[i], i);
    // Outer faces have one cell.
    std::map<FaceNodes, std::pair<std::size_t, int>> faces; // cell, and how many there are
    for (std::size_t cell = 0; cell < block.solids.size(); ++cell) {
        const auto& corners = model.solids.nodes[block.solids[cell]];
        static constexpr int around[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
        for (const auto& face : around) {
            auto& known = faces[in_rising_order(
                {corners[face[0]], corners[face[1]], corners[face[2]], corners[face[3]]})];
            known.first = cell;
            ++known.second;
        }
    }
    std::map<Index, AbsorbingNode> by_node;
    for (const NonReflectingBoundary& boundary : model.non_reflecting_boundaries) {
        for (const FaceNodes& segment : boundary.segments) {
            if (!number.contains(segment[0]) || !boundary.dilatational) continue;
            const auto found = faces.find(in_rising_order(segment));
            if (found == faces.end()) continue; // of a structure that hangs on the mesh
            if (found->second.second != 1)
                throw DeckError(boundary.where,
                                fmt::format("*BOUNDARY_NON_REFLECTING: the segment at node {} lies inside an "
                                            "Eulerian mesh",
                                            model.nodes.id[segment[0]]));
            const FluidCell cell = fluid.cell(found->second.first);
            const CellSide side = side_of(fluid, cell);
            auto areas = unit_pressure_forces(segment, model.nodes.position);
            Vec3 middle{}, centre{}, whole{};
            for (int n = 0; n < 4; ++n) middle += 0.25 * model.nodes.position[segment[n]];
            for (const Vec3& point : cell.points) centre += 0.125 * point;
            for (const Vec3& area : areas) whole += area;
            const double outward = dot(whole, middle - centre) > 0 ? 1 : -1;
            for (int n = 0; n < 4; ++n) {
                AbsorbingNode& node = by_node[segment[n]];
                const Vec3 area = outward * areas[n];
                node.place = fluid.node_place(number.at(segment[n]));
                node.area += area;
                node.pressure_area += side.pressure * area;
                node.damping += side.impedance * norm(area);
            }
        }
    }
    for (const auto& [index, node] : by_node) nodes.push_back(node);
    return nodes;
}

void find_absorbing_forces(const FluidFields& fields, std::span<const AbsorbingNode> nodes, double step,
                           double outside_pressure, std::vector<NodeForceFromOutside>& forces)
{
    forces.clear();
    for (const AbsorbingNode& node : nodes) {
        const double mass = fields.node_mass[node.place];
        if (!(mass > 0)) continue;
        const Vec3 mean{fields.mean_velocity[0][node.place], fields.mean_velocity[1][node.place],
                        fields.mean_velocity[2][node.place]};
        const Vec3 steady = outside_pressure * node.area - node.pressure_area, normal = unit(node.area);
        // Both forces change the mean velocity by half of their impulse over the mass.
        const double half = 0.5 * step / mass;
        const double along = dot(mean + half * steady, normal) / (1 + half * node.damping);
        const Vec3 force = steady - (node.damping * along) * normal;
        forces.push_back({node.place, {force.x, force.y, force.z}});
    }
}

} // namespace plash
