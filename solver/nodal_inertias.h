#pragma once

#include "core/state.h"
#include "model/model.h"

namespace plash {

/// *ELEMENT_INERTIA: adds rotary inertias and masses to nodes, those of rigid bodies too. DeckError for
/// moments of inertia that are not equal about all axes.
void add_nodal_inertias(const Model& model, State& state);

} // namespace plash
