#include "solver/fluids/old_water.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

/// Keeps the entries of a list that a mark does not name; where each went, none for those that are gone.
template <class T>
void drop_marked(std::vector<T>& list, const std::vector<bool>& gone)
{
    if (list.empty()) return;
    std::size_t to = 0;
    for (std::size_t from = 0; from < list.size(); ++from)
        if (!gone[from]) list[to++] = list[from];
    list.resize(to);
}

} // namespace

OldWater::OldWater(Model& model, const Water& water, std::vector<bool> changed, FluidForm form)
    : model_(model), changed_(std::move(changed))
{
    find_nodes(water);
    check_conditions(form);
    drop_elements();
}

void OldWater::find_nodes(const Water& water)
{
    std::vector<bool> kept(model_.nodes.size());
    orphan_.assign(model_.nodes.size(), false);
    std::map<Index, std::vector<bool>> own;
    const auto visit = [&](Index part, Index node) {
        if (node == none) return;
        if (!changed_[part]) {
            kept[node] = true;
            return;
        }
        orphan_[node] = true;
        auto& marks = own[part];
        if (marks.empty()) marks.resize(model_.nodes.size());
        if (!marks[node]) nodes_[part].push_back(node);
        marks[node] = true;
    };
    for_each_topology(model_, [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i)
            for (Index node : elements.nodes[i]) visit(elements.part[i], node);
    });
    for (std::size_t i = 0; i < model_.particles.size(); ++i)
        visit(model_.particles.part[i], model_.particles.node[i]);
    for (std::size_t node = 0; node < kept.size(); ++node)
        if (kept[node]) orphan_[node] = false;
    // A mesh that holds the fluid of another part gives its nodes to that.
    if (water.mesh && nodes_.size() > water.parts.size()) {
        std::vector<Index> all;
        for (const auto& [part, nodes] : nodes_) all.insert(all.end(), nodes.begin(), nodes.end());
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        nodes_.clear();
        nodes_[water.parts.front()] = std::move(all);
    }
}

void OldWater::check_conditions(FluidForm form) const
{
    const auto refuse = [&](const auto& nodes, Location where, std::string_view what) {
        for (Index node : nodes)
            if (node != none && orphan_[node])
                throw DeckError(where,
                                fmt::format("{} names node {} of the water; it cannot be translated to "
                                            "--fluid {}",
                                            what, model_.nodes.id[node], to_string(form)));
    };
    for (const NodalLoad& load : model_.nodal_loads) refuse(load.nodes, load.where, "a nodal load");
    for (const PressureLoad& load : model_.pressure_loads)
        for (const auto& segment : load.segments) refuse(segment, load.where, "a pressure load");
    for (const PrescribedMotion& motion : model_.prescribed_motions)
        refuse(motion.nodes, motion.where, "a prescribed motion");
    for (const NonReflectingBoundary& boundary : model_.non_reflecting_boundaries)
        for (const auto& segment : boundary.segments)
            refuse(segment, boundary.where, "*BOUNDARY_NON_REFLECTING");
    for (const NodalRigidBody& body : model_.nodal_rigid_bodies)
        refuse(body.nodes, body.where, "a rigid body");
    for (const ExtraNodes& extra : model_.extra_nodes) refuse(extra.nodes, extra.where, "a rigid body");
    for (const CrossSection& section : model_.cross_sections)
        refuse(section.nodes, section.where, "a cross section");
    for (const NodeDamping& damping : model_.dampings)
        for (Index part : damping.parts)
            if (changed_[part] && form == FluidForm::ale)
                throw DeckError(damping.where,
                                fmt::format("damping of part {} has no counterpart in an Eulerian "
                                            "mesh",
                                            model_.parts[part].id));
    for (const Termination& termination : model_.terminations)
        if (termination.kind == Termination::Kind::contact)
            throw DeckError(termination.where,
                            "a termination by contact force cannot be kept, as contacts with "
                            "the water are replaced");
}

void OldWater::drop_elements()
{
    const std::size_t count = model_.solids.size();
    std::vector<bool> gone(count);
    for (std::size_t i = 0; i < count; ++i) gone[i] = changed_[model_.solids.part[i]];
    std::vector<Index> moved(count, none);
    Index next = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (!gone[i]) moved[i] = next++;
    const auto follow = [&](std::vector<Index>& elements) {
        for (Index& element : elements) element = moved[element];
        std::erase(elements, none);
    };
    for (ElementSet& set : model_.solid_sets) follow(set.elements);
    for (CrossSection& section : model_.cross_sections) follow(section.solids);
    follow(model_.controls.output.history_solids);
    drop_marked(model_.solids.axes, gone);
    drop_marked(model_.solids.ten_nodes, gone);
    drop_marked(model_.solids.id, gone);
    drop_marked(model_.solids.part, gone);
    drop_marked(model_.solids.nodes, gone);

    gone.assign(model_.particles.size(), false);
    for (std::size_t i = 0; i < gone.size(); ++i) gone[i] = changed_[model_.particles.part[i]];
    drop_marked(model_.particles.node, gone);
    drop_marked(model_.particles.part, gone);
    drop_marked(model_.particles.mass, gone);

    const auto forget = [&](std::vector<Index>& nodes) {
        std::erase_if(nodes, [&](Index node) { return orphan_[node]; });
    };
    for (FixedNodes& fixed : model_.fixed_nodes) forget(fixed.nodes);
    std::erase_if(model_.fixed_nodes, [](const FixedNodes& fixed) { return fixed.nodes.empty(); });
    forget(model_.controls.output.history_nodes);
    forget(model_.controls.output.history_particles);
}

void OldWater::hand_over(const NewWater& made, std::vector<std::string>& lines)
{
    // A list that holds all nodes of a part gets those of the new water, and loses the old ones.
    const auto hand = [&](std::vector<Index>& nodes, Location where, std::string_view what) {
        std::vector<bool> listed(model_.nodes.size());
        for (Index node : nodes) listed[node] = true;
        bool any = false;
        for (const auto& [part, old] : nodes_) {
            const auto among =
                std::count_if(old.begin(), old.end(), [&](Index node) { return listed[node]; });
            if (among == 0) continue;
            const bool only_shared = std::none_of(old.begin(), old.end(),
                                                  [&](Index node) { return listed[node] && orphan_[node]; });
            if (only_shared) continue;
            if (among != static_cast<std::ptrdiff_t>(old.size()))
                throw DeckError(where,
                                fmt::format("{} speaks of {} of the {} nodes of the water in part {}; only "
                                            "what speaks of all or none can be translated",
                                            what, among, old.size(), model_.parts[part].id));
            if (const auto found = made.nodes.find(part); found != made.nodes.end())
                nodes.insert(nodes.end(), found->second.begin(), found->second.end());
            any = true;
        }
        if (!any) return;
        std::erase_if(nodes, [&](Index node) {
            return static_cast<std::size_t>(node) < orphan_.size() && orphan_[node];
        });
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        lines.push_back(fmt::format("{} goes to the new water", what));
    };
    for (InitialVelocity& velocity : model_.initial_velocities)
        hand(velocity.nodes, velocity.where, "an initial velocity");
    for (BodyLoad& load : model_.body_loads) hand(load.nodes, load.where, "a load of the frame");
    for (RigidWall& wall : model_.rigid_walls) {
        hand(wall.nodes, wall.where, fmt::format("rigid wall {}", wall.id));
        hand(wall.excluded, wall.where, fmt::format("rigid wall {} (nodes left out)", wall.id));
    }
}

} // namespace plash
