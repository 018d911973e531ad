#include "conditions/loaded_elements.h"

#include <algorithm>

namespace plash {

LoadedElements::LoadedElements(const Model& model, std::span<const SegmentNodes> segments)
    : shell_(segments.size(), none), solid_(segments.size(), none)
{
    std::vector<std::vector<Index>> segments_of(model.nodes.size()); // by their first corner
    for (std::size_t i = 0; i < segments.size(); ++i)
        segments_of[segments[i][0]].push_back(static_cast<Index>(i));
    const auto find = [&](const auto& elements, std::vector<Index>& owner) {
        for (std::size_t e = 0; e < elements.size(); ++e) {
            const auto& nodes = elements.nodes[e];
            const auto has = [&](Index node) {
                return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
            };
            for (std::size_t c = 0; c < nodes.size(); ++c) {
                if (std::find(nodes.begin(), nodes.begin() + c, nodes[c]) != nodes.begin() + c) continue;
                for (Index segment : segments_of[nodes[c]]) {
                    const SegmentNodes& corners = segments[segment];
                    if (std::all_of(corners.begin(), corners.end(), has))
                        owner[segment] = static_cast<Index>(e);
                }
            }
        }
    };
    find(model.shells, shell_);
    find(model.thick_shells, solid_);
    for (Index& solid : solid_)
        if (solid != none) solid += static_cast<Index>(model.solids.size());
    find(model.solids, solid_);
    if (model.solids.ten_nodes.empty()) return;
    std::vector<Index> row(segments.size(), none);
    find(model.tetrahedra, row);
    std::vector<Index> solid_of(model.tetrahedra.size());
    for (std::size_t solid = 0; solid < model.solids.ten_nodes.size(); ++solid)
        if (model.solids.ten_nodes[solid] != none)
            solid_of[model.solids.ten_nodes[solid]] = static_cast<Index>(solid);
    for (std::size_t i = 0; i < row.size(); ++i)
        if (row[i] != none) solid_[i] = solid_of[row[i]];
}

} // namespace plash
