#pragma once

#include "model/model.h"

#include <string>
#include <vector>

namespace plash {

/// A node that was moved out of a surface before the start.
struct MovedNode {
    Index node = none;    ///< of the Model
    Index contact = none; ///< place among the Model's contacts
    double depth = 0;     ///< penetration at the start [length]
    Vec3 from{};          ///< where it was
};

/// IGNORE = 0 of *CONTACT or *CONTROL_CONTACT (SOFT = 0 or 1): moves the nodes that lie within the contact
/// thickness of a surface along its normal until they just touch, without stress, by changing the Model's
/// nodes; to be called before the scene is made. One contact after the other in the deck's order, nodes of
/// the first surface before those of the second, each once.
///
/// Nodes of rigid parts, of particles and of what is tied stay. A node is moved by more than a quarter of the
/// shortest edge of the elements at it (all contacts together) only along with its neighbours, beside which
/// it goes no farther than that: a sheet is lifted as a whole, but no element is spoiled. What is left of the
/// penetration gives no force as long as it gets no deeper.
std::vector<MovedNode> move_penetrating_nodes(Model& model);

/// Lines for people: how many nodes of each contact were moved, and the ten that were moved most.
std::vector<std::string> describe(const std::vector<MovedNode>& moved, const Model& model);

} // namespace plash
