#pragma once

#include "ale/fluid_law.h"
#include "model/model.h"

namespace plash {

/// A material group of a deck, in the deck's order: *ALE_MULTI-MATERIAL_GROUP, or what the parts of one
/// material make up where cells hold a single material (and void).
struct DeckGroup {
    std::string name;
    std::vector<Index> parts; ///< whose cells start full of it; the first one carries its sums in matsum
    int fluid = none;         ///< number among the groups that are not empty space; none: vacuum
    FluidGroup law;
    double density = 0;         ///< at the start [density]
    double energy_per_mass = 0; ///< at the start [energy/mass]
};

/// All groups of a Model's Eulerian meshes.
struct DeckGroups {
    std::vector<DeckGroup> groups;
    bool void_allowed = false; ///< cells may be partly or wholly empty

    std::vector<FluidGroup> fluids() const;
    /// Position of the group that a part belongs to; none: no group (a structured mesh).
    int group_of_part(Index part) const;
    /// Position of the empty space among `groups`; none: there is none.
    int vacuum() const;
};

/// The groups of a *SET_MULTI-MATERIAL_GROUP_LIST, by number or by name, as bits of their numbers among the
/// fluids. DeckError when there is no such set, which `field` of `record` names, or no such group.
unsigned fluids_of_set(const Model& model, const Record& record, const std::string& field, Id set,
                       const DeckGroups& groups);

/// DeckError when a group's material or equation of state is not there.
DeckGroups deck_groups_of(const Model& model);

} // namespace plash
