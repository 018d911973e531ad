#pragma once

#include "solver/fluids/new_water.h"

namespace plash {

/// What stood between the water and structures (contacts, couplings, shared nodes), taken out of a Model, and
/// what stands for it with the new water.
class WaterContacts {
public:
    /// Reads the Model as the deck has it: elements and nodes of the old water are still there.
    WaterContacts(const Model& model, const Water& water);

    /// Nodes of the structures that meet the water.
    std::vector<Vec3> structure_points(const Model& model) const;

    /// Replaces the contacts of the Model by those of the new water; `changed` by part of the old one.
    void translate(Model& model, FluidForm form, const Water& water, const std::vector<bool>& changed,
                   const NewWater& made, std::vector<std::string>& lines) const;

private:
    /// A surface of a structure that meets the water.
    struct Meeting {
        Id id = 0;        ///< of the contact or coupling; 0: none
        std::string name; ///< for the user
        std::string title;
        Location where;
        ContactSide structure;
        std::vector<Index> water_parts; ///< that it meets; empty: all
        bool structure_is_slave = false;
        bool sticks = false; ///< tied
        double friction = 0;
        double birth = 0, death = forever;
        std::size_t contact = 0; ///< position among the Model's contacts, if it comes from one
        bool from_contact = false;
        bool replaced = true; ///< the contact has no other work
    };
    std::vector<Meeting> meetings_;
    std::vector<std::size_t> among_water_; ///< contacts between parts of the water

    void read_contact(const Model& model, const Water& water, std::size_t index);
    void read_couplings(const Model& model);
    void read_shared_nodes(const Model& model, const Water& water);
    void add_coupling(Model& model, const Meeting& meeting, const NewWater& made,
                      std::vector<std::string>& lines) const;
    void add_contact(Model& model, const Meeting& meeting, FluidForm form, const Water& water,
                     const NewWater& made, std::vector<std::string>& lines) const;
};

} // namespace plash
