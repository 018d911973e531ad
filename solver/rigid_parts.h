#pragma once

#include "model/model.h"
#include "rigid/rigid_bodies.h"

namespace plash {

/// Adds the lumped masses of all rigid parts to the state, so that loads and the bodies' properties see them.
/// Call before initial velocities.
void add_rigid_masses(const Model& model, State& state);

/// The bodies of the deck: rigid parts (merged by *CONSTRAINED_RIGID_BODIES) and nodal rigid bodies, with
/// extra nodes, with the mass of everything on their nodes or that of their cards, and with the velocities of
/// their nodes or their cards. DeckError for a node of two bodies, a body without mass, constraint codes that
/// make no sense.
RigidSetup make_rigid_bodies(const Model& model, const State& state);

} // namespace plash
