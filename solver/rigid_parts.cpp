#include "solver/rigid_parts.h"

#include "elements/beam_groups.h"
#include "elements/shell_mass.h"
#include "elements/solid_groups.h"
#include "solver/rigid_fixity.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace plash {

namespace {

/// Nodes of the elements of every part.
std::vector<std::vector<Index>> nodes_of_rigid_parts(const Model& model)
{
    std::vector<std::vector<Index>> nodes(model.parts.size());
    for_each_topology(model, [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const Index part = elements.part[i];
            if (part == none || !model.is_rigid(part)) continue;
            for (Index node : elements.nodes[i])
                if (node != none) nodes[part].push_back(node);
        }
    });
    return nodes;
}

class Builder {
public:
    Builder(const Model& model, const State& state) : model_(model), state_(state)
    {
        const std::size_t part_count = model.parts.size();
        lead_.resize(part_count + model.nodal_rigid_bodies.size());
        for (std::size_t i = 0; i < lead_.size(); ++i) lead_[i] = static_cast<Index>(i);
    }

    RigidSetup run()
    {
        collect_nodes();
        merge();
        RigidSetup setup;
        setup.of_number.assign(lead_.size(), none);
        std::vector<Index> owner(state_.size(), none);
        for (std::size_t number = 0; number < lead_.size(); ++number) {
            if (lead_[number] != static_cast<Index>(number) || nodes_[number].empty()) continue;
            setup.of_number[number] = static_cast<Index>(setup.bodies.size());
            setup.bodies.push_back(build(static_cast<Index>(number), owner));
        }
        for (std::size_t number = 0; number < lead_.size(); ++number)
            setup.of_number[number] = setup.of_number[lead_[number]];
        add_welds(setup, owner);
        give_card_velocities(setup);
        note_driven_nodes(setup, owner);
        return setup;
    }

private:
    const Model& model_;
    const State& state_;
    std::vector<std::vector<Index>> nodes_; ///< by body number
    std::vector<Index> lead_;               ///< by body number: the body that it is part of
    bool is_part(BodyNumber number) const { return number < static_cast<Index>(model_.parts.size()); }
    Location where(BodyNumber number) const
    {
        return is_part(number) ? model_.parts[number].where
                               : model_.nodal_rigid_bodies[number - model_.parts.size()].where;
    }

    void collect_nodes()
    {
        nodes_ = nodes_of_rigid_parts(model_);
        for (const NodalRigidBody& body : model_.nodal_rigid_bodies) {
            nodes_.push_back(body.nodes);
            if (body.center_node != none) nodes_.back().push_back(body.center_node);
        }
        for (const ExtraNodes& extra : model_.extra_nodes) {
            if (is_part(extra.body) && !model_.is_rigid(extra.body)) {
                throw DeckError(extra.where, fmt::format("part {} is not rigid: it cannot carry extra nodes",
                                                         model_.body_id(extra.body)));
            }
            auto& nodes = nodes_[extra.body];
            nodes.insert(nodes.end(), extra.nodes.begin(), extra.nodes.end());
        }
    }

    void merge()
    {
        for (const RigidMerge& merge : model_.rigid_merges) {
            for (BodyNumber body : {merge.lead, merge.follower}) {
                if (is_part(body) && !model_.is_rigid(body)) {
                    throw DeckError(merge.where, fmt::format("part {} is not rigid: only rigid bodies can be "
                                                             "merged",
                                                             model_.body_id(body)));
                }
            }
            const Index lead = lead_[merge.lead], follower = lead_[merge.follower];
            if (lead == follower) continue;
            for (Index& entry : lead_)
                if (entry == follower) entry = lead;
            nodes_[lead].insert(nodes_[lead].end(), nodes_[follower].begin(), nodes_[follower].end());
        }
    }

    const PartInertia* inertia_of(BodyNumber number) const
    {
        if (!is_part(number)) {
            const auto& inertia = model_.nodal_rigid_bodies[number - model_.parts.size()].inertia;
            return inertia ? &*inertia : nullptr;
        }
        const auto found = model_.part_inertias.find(number);
        return found == model_.part_inertias.end() ? nullptr : &found->second;
    }

    RigidBody build(BodyNumber number, std::vector<Index>& owner)
    {
        std::vector<Index>& nodes = nodes_[number];
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        std::vector<double> mass, inertia;
        double total = 0;
        for (Index node : nodes) {
            if (owner[node] != none) {
                throw DeckError(where(number),
                                fmt::format("node {} belongs to the rigid bodies {} and {}; merge them with "
                                            "*CONSTRAINED_RIGID_BODIES or separate their nodes",
                                            model_.nodes.id[node], model_.body_id(owner[node]),
                                            model_.body_id(number)));
            }
            owner[node] = number;
            mass.push_back(state_.mass[node]);
            if (state_.rotational()) inertia.push_back(state_.inertia[node]);
            total += state_.mass[node];
        }
        std::vector<BodyNumber> carded; // pieces whose mass properties a card gives
        for (std::size_t piece = 0; piece < lead_.size(); ++piece)
            if (lead_[piece] == number && inertia_of(piece)) carded.push_back(static_cast<Index>(piece));
        if (total <= 0 && carded.empty()) {
            throw DeckError(where(number), fmt::format("rigid body {} '{}' has no mass",
                                                       model_.body_id(number), model_.body_title(number)));
        }
        // Without nodal masses the card's properties count alone; these are only to divide by.
        if (total <= 0) mass.assign(nodes.size(), 1e-200);
        const bool rigid_part = is_part(number);
        const BodyFixity fixity = rigid_part ? fixity_of_part(model_, number)
                                             : model_.nodal_rigid_bodies[number - model_.parts.size()].fixity;
        RigidBody body = rigid_body_of(number, nodes, mass, inertia, state_, fixity);
        if (rigid_part) body.local_axes = local_axes_of_part(model_, number);
        if (carded.empty()) return body;
        const PartInertia* card = inertia_of(number);
        give_properties(body, properties_of(number, nodes, carded), state_);
        if (card && !velocity_overrides_card(nodes))
            give_velocity(body, card->velocity, card->angular_velocity);
        return body;
    }

    /// Mass properties of a body some pieces of which have them from a card. The card of the lead speaks for
    /// all its nodes, but IFLAG = 1 adds followers and extra nodes to it; without one, the nodes that belong
    /// to no carded piece count with their own masses.
    MassProperties properties_of(BodyNumber number, const std::vector<Index>& nodes,
                                 const std::vector<BodyNumber>& carded) const
    {
        const bool led_by_card = inertia_of(number) != nullptr;
        std::vector<Index> counted;
        std::vector<BodyNumber> cards;
        if (led_by_card) {
            cards.push_back(number);
            for (const RigidMerge& merge : model_.rigid_merges) {
                if (!merge.add_inertia || lead_[merge.follower] != number) continue;
                if (inertia_of(merge.follower))
                    cards.push_back(merge.follower);
                else
                    counted.insert(counted.end(), nodes_[merge.follower].begin(),
                                   nodes_[merge.follower].end());
            }
            for (const ExtraNodes& extra : model_.extra_nodes)
                if (extra.add_inertia && lead_[extra.body] == number)
                    counted.insert(counted.end(), extra.nodes.begin(), extra.nodes.end());
        } else {
            cards = carded;
            counted = nodes;
            std::vector<Index> spoken_for;
            for (BodyNumber piece : carded)
                spoken_for.insert(spoken_for.end(), nodes_[piece].begin(), nodes_[piece].end());
            std::sort(spoken_for.begin(), spoken_for.end());
            std::erase_if(counted, [&](Index node) {
                return std::binary_search(spoken_for.begin(), spoken_for.end(), node);
            });
        }
        MassProperties properties;
        for (BodyNumber piece : cards) {
            const PartInertia& card = *inertia_of(piece);
            if (!(card.mass > 0)) {
                throw DeckError(card.where,
                                fmt::format("rigid body {}, field TM: the mass {:g} is not positive",
                                            model_.body_id(piece), card.mass));
            }
            properties.add(mass_properties_of(card, state_));
        }
        std::sort(counted.begin(), counted.end());
        counted.erase(std::unique(counted.begin(), counted.end()), counted.end());
        for (Index node : counted)
            properties.add_point(state_.mass[node], state_.position[node],
                                 state_.rotational() ? state_.inertia[node] : 0);
        return properties;
    }

    /// IRIGID = 1 of *INITIAL_VELOCITY_GENERATION on nodes of the body.
    bool velocity_overrides_card(const std::vector<Index>& nodes) const
    {
        for (const InitialVelocity& initial : model_.initial_velocities) {
            if (!initial.over_inertia) continue;
            for (Index node : initial.nodes)
                if (std::binary_search(nodes.begin(), nodes.end(), node)) return true;
        }
        return false;
    }

    /// A weld is a body of its own as long as it holds.
    void add_welds(RigidSetup& setup, std::vector<Index>& owner) const
    {
        setup.welds = read_welds(model_);
        for (Weld& weld : setup.welds) {
            std::vector<double> mass, inertia;
            for (Index node : weld.nodes) {
                if (owner[node] != none) {
                    throw DeckError(weld.where,
                                    fmt::format("weld {}: node {} belongs to another weld or rigid "
                                                "body already",
                                                weld.id, model_.nodes.id[node]));
                }
                owner[node] = static_cast<Index>(lead_.size() + setup.bodies.size());
                mass.push_back(state_.mass[node]);
                if (state_.rotational()) inertia.push_back(state_.inertia[node]);
                if (!(state_.mass[node] > 0)) {
                    throw DeckError(weld.where, fmt::format("weld {}: node {} has no mass", weld.id,
                                                            model_.nodes.id[node]));
                }
            }
            weld.body = static_cast<Index>(setup.bodies.size());
            setup.bodies.push_back(rigid_body_of(none, weld.nodes, mass, inertia, state_, {}));
        }
    }

    void give_card_velocities(RigidSetup& setup) const
    {
        for (const RigidBodyVelocity& card : model_.rigid_body_velocities) {
            const Index body = setup.of_number[card.part];
            if (body == none) {
                throw DeckError(card.where, fmt::format("*INITIAL_VELOCITY_RIGID_BODY: part {} is not rigid",
                                                        model_.body_id(card.part)));
            }
            give_velocity(setup.bodies[body], card.translation, card.angular_velocity);
        }
    }

    /// *BOUNDARY_PRESCRIBED_MOTION of nodes that belong to bodies has no effect there, as in LS-DYNA.
    void note_driven_nodes(RigidSetup& setup, const std::vector<Index>& owner) const
    {
        for (const PrescribedMotion& motion : model_.prescribed_motions) {
            const auto count = std::count_if(motion.nodes.begin(), motion.nodes.end(),
                                             [&](Index node) { return owner[node] != none; });
            if (count == 0) continue;
            setup.notices.push_back(fmt::format("{}: prescribed motion of {} nodes of rigid bodies has no "
                                                "effect; *BOUNDARY_PRESCRIBED_MOTION_RIGID drives bodies",
                                                model_.place(motion.where), count));
        }
    }
};

/// Where the mass of a rigid part has to come from.
void check_mass_source(const Part& part)
{
    if (part.material != none && part.section != none) return;
    throw DeckError(part.where,
                    fmt::format("rigid part {} needs one section and one material for its mass", part.id));
}

/// Beams of parts whose mass properties a card gives add nothing.
void add_masses_of_rigid_beams(const Model& model, State& state)
{
    std::map<Index, std::vector<Index>> elements;
    for (std::size_t element = 0; element < model.beams.size(); ++element) {
        const Index part = model.beams.part[element];
        if (!model.is_rigid(part) || model.part_inertias.contains(part)) continue;
        elements[part].push_back(static_cast<Index>(element));
    }
    for (auto& [part, of_part] : elements) {
        check_mass_source(model.parts[part]);
        add_beam_masses({model, part, std::move(of_part)}, state);
    }
}

} // namespace

void add_rigid_masses(const Model& model, State& state)
{
    add_masses_of_rigid_beams(model, state);
    std::vector<bool> has_solids(model.parts.size());
    for (Index part : model.solids.part) has_solids[part] = true;
    for (Index part : model.thick_shells.part) has_solids[part] = true;
    for (Index part = 0; part < static_cast<Index>(model.parts.size()); ++part) {
        if (!model.is_rigid(part) || !has_solids[part]) continue;
        const SolidMasses solids = solid_masses(model, part);
        for (std::size_t i = 0; i < solids.nodes.size(); ++i) state.mass[solids.nodes[i]] += solids.mass[i];
    }
    for (std::size_t element = 0; element < model.shells.size(); ++element) {
        const Index part = model.shells.part[element];
        if (!model.is_rigid(part)) continue;
        check_mass_source(model.parts[part]);
        const Index index = static_cast<Index>(element);
        const ShellMass shell = shell_mass(model, index);
        const auto corners = shell_corners(model, index);
        for (int corner = 0; corner < 4; ++corner) state.mass[corners[corner]] += shell.corner_mass[corner];
    }
}

RigidSetup make_rigid_bodies(const Model& model, const State& state)
{
    return Builder(model, state).run();
}

} // namespace plash
