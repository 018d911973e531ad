#include "contact/initial_penetrations.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

std::vector<InitialPenetration> initial_penetrations(const Contact& contact, const ContactMesh& mesh,
                                                     PairSearch& search, const State& state)
{
    ContactMotion motion;
    motion.load(mesh, Clock{}, state);
    search.update(mesh, motion);
    TouchTable table;
    table.set_owners(search.pairs().owner);
    TouchFinder::Room room;
    const TouchFinder finder(mesh, motion, contact.square_edges);
    finder.find(search.pairs(), 0, table.owners(), table, room);
    search.pairs().look_at_all();
    std::vector<InitialPenetration> found;
    for (const Touch& touch : table.list(mesh, motion).all) {
        // Surfaces that just touch are no mistake: round-off of their coordinates is not worth a line.
        const double gap = mesh.nodes[touch.node].half_thickness + mesh.facets[touch.facet].half_thickness;
        const double scale = std::max(gap, mesh.facets[touch.facet].size);
        if (touch.penetration > 1e-6 * scale) found.push_back({touch.node, touch.facet, touch.penetration});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.depth > b.depth; });
    return found;
}

std::vector<std::string> describe(const std::vector<InitialPenetration>& penetrations, const Contact& contact,
                                  const ContactMesh& mesh, const Model& model)
{
    std::vector<std::string> lines;
    if (penetrations.empty()) return lines;
    constexpr std::size_t most = 10;
    lines.push_back(
        fmt::format("contact {}{}: {} initial penetration{}, the deepest {:.4g}; {} without force as long "
                    "as {} no deeper",
                    contact.id, contact.title.empty() ? "" : " '" + contact.title + "'", penetrations.size(),
                    penetrations.size() == 1 ? "" : "s", penetrations.front().depth,
                    penetrations.size() == 1 ? "it stays" : "they stay",
                    penetrations.size() == 1 ? "it gets" : "they get"));
    const auto part_of = [&](Index part) {
        return part == none ? std::string() : fmt::format(" of part {}", model.parts[part].id);
    };
    for (std::size_t i = 0; i < std::min(most, penetrations.size()); ++i) {
        const InitialPenetration& one = penetrations[i];
        const Segment& segment = mesh.segments[one.facet];
        const Index node = mesh.nodes[one.node].node;
        const Vec3& place = model.nodes.position[node];
        const auto brick_name = [&](Index brick) {
            const auto solids = static_cast<Index>(model.solids.size());
            return brick < solids ? fmt::format("solid {}", model.solids.id[brick])
                                  : fmt::format("thick shell {}", model.thick_shells.id[brick - solids]);
        };
        const std::string element =
            segment.shell != none   ? fmt::format("shell {}", model.shells.id[segment.shell])
            : segment.solid != none ? brick_name(segment.solid)
                                    : fmt::format("the segment at node {}", model.nodes.id[segment.nodes[0]]);
        lines.push_back(fmt::format("  node {}{} by {:.4g} into {}{} at ({:.6g}, {:.6g}, {:.6g})",
                                    model.nodes.id[node], part_of(mesh.nodes[one.node].part), one.depth,
                                    element, part_of(segment.part), place.x, place.y, place.z));
    }
    if (penetrations.size() > most) lines.push_back(fmt::format("  and {} more", penetrations.size() - most));
    return lines;
}

} // namespace plash
