#include "solver/rigid_parts.h"

#include "elements/shell_mass.h"
#include "elements/solid_groups.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

bool is_rigid(const Model& model, Index part)
{
    const Index material = model.parts[part].material;
    return material != none && model.materials[material].keyword == "MAT_RIGID";
}

/// Freedoms of the code that CON1 and CON2 share: 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 xyz.
FreedomMask freedoms_of_code(const Record& material, std::string_view field)
{
    constexpr FreedomMask masks[8] = {0, 1, 2, 4, 3, 6, 5, 7};
    const Id code = material.integer(field);
    if (code < 0 || code > 7) {
        throw DeckError(material.where, fmt::format("*{}, field {}: {} is not a constraint code from 0 to 7",
                                                    material.keyword, field, code));
    }
    return masks[code];
}

FreedomMask fixed_freedoms(const Model& model, Index part)
{
    const Record& material = model.materials[model.parts[part].material];
    const double option = material.real("CMO");
    if (option == 0) return 0;
    if (option < 0) {
        throw DeckError(material.where,
                        fmt::format("*{}, field CMO: {:g}: constraints in a local system are not "
                                    "supported yet (CMO = 1 with global directions is)",
                                    material.keyword, option));
    }
    return freedoms_of_code(material, "CON1") | freedoms_of_code(material, "CON2") << 3;
}

/// Nodes of a rigid part in rising order.
std::vector<Index> nodes_of(const Model& model, Index part)
{
    std::vector<Index> nodes;
    const auto take = [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (elements.part[i] == part)
                nodes.insert(nodes.end(), elements.nodes[i].begin(), elements.nodes[i].end());
        }
    };
    take(model.shells);
    take(model.solids);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

} // namespace

void add_rigid_masses(const Model& model, State& state)
{
    for (Index part = 0; part < static_cast<Index>(model.parts.size()); ++part) {
        if (!is_rigid(model, part)) continue;
        const SolidMasses solids = solid_masses(model, part);
        for (std::size_t i = 0; i < solids.nodes.size(); ++i) state.mass[solids.nodes[i]] += solids.mass[i];
    }
    for (std::size_t element = 0; element < model.shells.size(); ++element) {
        if (!is_rigid(model, model.shells.part[element])) continue;
        const Index index = static_cast<Index>(element);
        const ShellMass shell = shell_mass(model, index);
        const auto corners = shell_corners(model, index);
        for (int corner = 0; corner < 4; ++corner) state.mass[corners[corner]] += shell.corner_mass[corner];
    }
}

std::vector<RigidBody> make_rigid_bodies(const Model& model, const State& state)
{
    std::vector<RigidBody> bodies;
    std::vector<Index> owner(state.size(), none);
    for (Index part = 0; part < static_cast<Index>(model.parts.size()); ++part) {
        if (!is_rigid(model, part)) continue;
        const std::vector<Index> nodes = nodes_of(model, part);
        std::vector<double> mass;
        double total = 0;
        for (Index node : nodes) {
            if (owner[node] != none) {
                throw DeckError(model.parts[part].where,
                                fmt::format("node {} belongs to the rigid parts {} and {}; merge them with "
                                            "*CONSTRAINED_RIGID_BODIES or separate their nodes",
                                            model.nodes.id[node], model.parts[owner[node]].id,
                                            model.parts[part].id));
            }
            owner[node] = part;
            mass.push_back(state.mass[node]);
            total += state.mass[node];
        }
        if (nodes.empty()) continue;
        if (total <= 0) {
            throw DeckError(
                model.parts[part].where,
                fmt::format("rigid part {} '{}' has no mass", model.parts[part].id, model.parts[part].title));
        }
        bodies.push_back(rigid_body_of(part, nodes, mass, {}, state, fixed_freedoms(model, part)));
    }
    return bodies;
}

} // namespace plash
