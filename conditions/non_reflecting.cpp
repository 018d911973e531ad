#include "conditions/non_reflecting.h"

#include "core/parallel.h"
#include "model/eulerian.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace plash {

namespace {

struct Impedance {
    double dilatational = 0, shear = 0; ///< rho c [stress time/length]
};

/// Elastic impedances of a material: from E and PR, from G and K, or from G and BULK.
Impedance impedance_of(const Record& material, const Part& part, const NonReflectingBoundary& boundary)
{
    const double density = material.real("RO"), young = material.real("E"), poisson = material.real("PR");
    double shear = material.real("G"), bulk = material.real("K", material.real("BULK"));
    if (young > 0) {
        shear = young / (2 * (1 + poisson));
        bulk = young / (3 * (1 - 2 * poisson));
    }
    if (!(density > 0) || !(bulk > 0)) {
        throw DeckError(
            boundary.where,
            fmt::format("*BOUNDARY_NON_REFLECTING needs elastic moduli, but *{} {} of part {} has no "
                        "density, or neither E and PR nor G and K",
                        material.keyword, material.id, part.id));
    }
    return {std::sqrt(density * (bulk + 4.0 / 3 * shear)), std::sqrt(density * shear)};
}

/// Part of the solid that has all corners of a segment.
Index part_under(const SegmentNodes& segment, const Model& model,
                 const std::vector<std::vector<Index>>& solids_of_node)
{
    for (Index solid : solids_of_node[segment[0]]) {
        const auto& nodes = model.solids.nodes[solid];
        const bool all = std::all_of(segment.begin(), segment.end(), [&](Index node) {
            return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
        });
        if (all) return model.solids.part[solid];
    }
    return none;
}

} // namespace

NonReflecting::NonReflecting(const Model& model, const State& state)
{
    std::vector<std::vector<Index>> solids_of_node(model.nodes.size());
    for (std::size_t solid = 0; solid < model.solids.size(); ++solid) {
        for (Index node : model.solids.nodes[solid])
            solids_of_node[node].push_back(static_cast<Index>(solid));
    }
    std::map<Index, Node> by_node;
    for (const NonReflectingBoundary& boundary : model.non_reflecting_boundaries) {
        for (const SegmentNodes& segment : boundary.segments) {
            const Index number = part_under(segment, model, solids_of_node);
            if (number != none && is_eulerian(model, number)) continue; // the fluid sees to it
            const Part* part = number == none ? nullptr : &model.parts[number];
            if (!part || part->material == none) {
                throw DeckError(
                    boundary.where,
                    fmt::format("*BOUNDARY_NON_REFLECTING: the segment at node {} lies on no solid",
                                model.nodes.id[segment[0]]));
            }
            const Impedance impedance = impedance_of(model.materials[part->material], *part, boundary);
            const auto shares = unit_pressure_forces(segment, state.position);
            const double area = segment_area(segment, state.position);
            Vec3 whole{};
            for (const Vec3& share : shares) whole += share;
            const int corners = segment[2] == segment[3] ? 3 : 4;
            for (int c = 0; c < corners; ++c) {
                Node& node = by_node[segment[c]];
                node.node = segment[c];
                node.normal += whole;
                if (boundary.dilatational) node.normal_damping += impedance.dilatational * area / corners;
                if (boundary.shear) node.tangent_damping += impedance.shear * area / corners;
            }
        }
    }
    for (auto& [index, node] : by_node) {
        node.normal = unit(node.normal);
        nodes_.push_back(node);
    }
    last_.resize(nodes_.size());
}

void NonReflecting::constrain(const Clock& clock, State& state)
{
    const double span = clock.velocity_step();
    const double power = sum_chunks(nodes_.size(), [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const Node& node = nodes_[i];
            const double mass = state.mass[node.node];
            if (mass == 0) continue;
            const Vec3& velocity = state.velocity[node.node];
            Vec3& force = state.force[node.node];
            // Mean velocity over the step, from m (v+ - v) / h = f - c (v+ + v) / 2 along each direction.
            const double a = 0.5 * span / mass;
            const Vec3 unbraked = velocity + a * force;
            const double normal = dot(unbraked, node.normal);
            const Vec3 tangent = unbraked - normal * node.normal;
            const Vec3 added = (-node.normal_damping * normal / (1 + a * node.normal_damping)) * node.normal -
                               (node.tangent_damping / (1 + a * node.tangent_damping)) * tangent;
            force += added;
            sum += dot(added + last_[i], velocity);
            last_[i] = added;
        }
        return sum;
    });
    work_ += 0.5 * clock.last_step * power;
}

} // namespace plash
