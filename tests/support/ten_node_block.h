#pragma once

#include "tests/support/solid_block.h"

#include <map>

namespace plash::testing {

/// Turns the hexahedra of a block into six ten-node tetrahedra each, around the diagonal 1-7, with nodes in
/// the middle of their edges. formulation  ELFORM of the section
inline void cut_into_ten_node_tetrahedra(Model& model, int formulation)
{
    constexpr int around[] = {1, 2, 3, 7, 4, 5};
    constexpr int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    const SolidElements bricks = std::exchange(model.solids, {});
    std::map<std::pair<Index, Index>, Index> middle;
    const auto node_between = [&](Index a, Index b) {
        const auto [entry, is_new] =
            middle.try_emplace(std::minmax(a, b), static_cast<Index>(model.nodes.size()));
        if (is_new) {
            model.nodes.id.push_back(static_cast<Id>(model.nodes.id.size()) + 1);
            model.nodes.position.push_back(0.5 * (model.nodes.position[a] + model.nodes.position[b]));
        }
        return entry->second;
    };
    for (const auto& n : bricks.nodes) {
        for (int i = 0; i < 6; ++i) {
            const std::array<Index, 4> corner{n[0], n[around[i]], n[around[(i + 1) % 6]], n[6]};
            std::array<Index, 10> nodes{corner[0], corner[1], corner[2], corner[3]};
            for (int edge = 0; edge < 6; ++edge)
                nodes[4 + edge] = node_between(corner[edges[edge][0]], corner[edges[edge][1]]);
            const auto id = static_cast<Id>(model.solids.size()) + 1;
            model.solids.id.push_back(id);
            model.solids.part.push_back(0);
            model.solids.nodes.push_back(
                {corner[0], corner[1], corner[2], corner[3], corner[3], corner[3], corner[3], corner[3]});
            model.solids.ten_nodes.push_back(static_cast<Index>(model.tetrahedra.size()));
            model.tetrahedra.id.push_back(id);
            model.tetrahedra.part.push_back(0);
            model.tetrahedra.nodes.push_back(nodes);
        }
    }
    model.sections[0] = record_of("SECTION_SOLID", 1, {{"ELFORM", static_cast<double>(formulation)}});
}

} // namespace plash::testing
