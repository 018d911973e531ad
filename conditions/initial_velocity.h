#pragma once

#include "core/state.h"
#include "model/model.h"

namespace plash {

/// Gives the nodes their velocities at t = 0 (*INITIAL_VELOCITY family), in deck order.
void apply_initial_velocities(const Model& model, State& state);

} // namespace plash
