#pragma once

#include "model/model.h"
#include "rigid/rigid_body.h"

#include <vector>

namespace plash {

/// Adds the lumped masses of all parts of *MAT_RIGID to the state, so that loads and the bodies' properties
/// see them. Call before initial velocities.
void add_rigid_masses(const Model& model, State& state);

/// The bodies that these parts are, with the mass of everything on their nodes and the velocity that the
/// nodes have now. DeckError for a node of two bodies, a body without mass, or constraints that are not
/// supported.
std::vector<RigidBody> make_rigid_bodies(const Model& model, const State& state);

} // namespace plash
