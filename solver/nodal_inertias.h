#pragma once

#include "core/state.h"
#include "model/model.h"
#include "rigid/rigid_bodies.h"

namespace plash {

/// *ELEMENT_INERTIA with moments that are equal about all axes: adds rotary inertias and masses to nodes,
/// those of rigid bodies too.
void add_nodal_inertias(const Model& model, State& state);

/// All others of *ELEMENT_INERTIA, and *ELEMENT_INERTIA_OFFSET: their nodes turn by Euler's equations. Such a
/// node becomes a rigid body of its own, with what elements have given it and the mass at its offset; nodes
/// of rigid bodies add it to theirs, unless a card gives the mass properties of the body. DeckError for
/// tensors that no mass has, and for nodes that the deck drives.
void add_inertia_bodies(const Model& model, const State& state, RigidSetup& setup);

} // namespace plash
