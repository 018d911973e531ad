#pragma once

#include "solver/fluids/new_water.h"

namespace plash {

/// Takes the elements of the marked parts and what the deck says of their nodes out of a Model, before new
/// water is made. Throws DeckError where something acts on nodes of the old water that new ones cannot take
/// over.
class OldWater {
public:
    OldWater(Model& model, const Water& water, std::vector<bool> changed, FluidForm form);

    /// Nodes that have lost all their elements.
    const std::vector<bool>& orphans() const { return orphan_; }
    /// Gives the new water what the deck says of all nodes of a part alike: initial velocities, loads of the
    /// frame, nodes of rigid walls.
    void hand_over(const NewWater& made, std::vector<std::string>& lines);

private:
    Model& model_;
    std::vector<bool> changed_;                 ///< by part
    std::vector<bool> orphan_;                  ///< by node
    std::map<Index, std::vector<Index>> nodes_; ///< by changed part

    void find_nodes(const Water& water);
    void check_conditions(FluidForm form) const;
    void drop_elements();
};

} // namespace plash
