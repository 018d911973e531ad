#pragma once

#include "ale/deck_groups.h"
#include "ale/fluid.h"
#include "ale/mesh_block.h"

namespace plash {

/// Fills the cells of a block as the deck says at t = 0: by the parts of its elements, *INITIAL_VOID,
/// *INITIAL_VOLUME_FRACTION (by element) and *INITIAL_VOLUME_FRACTION_GEOMETRY (by containers that fill one
/// after the other). Nodes of the cells that a container fills with moving fluid get its velocity.
void fill_initial_state(Fluid& fluid, const MeshBlock& block, const DeckGroups& groups, const Model& model);

} // namespace plash
