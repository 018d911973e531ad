#pragma once

#include "core/state.h"
#include "model/model.h"

namespace plash {

/// Nodes of a Model at rest, without mass: what makers of element groups start from.
inline State bare_state(const Model& model)
{
    State state;
    state.position = model.nodes.position;
    state.velocity.resize(state.size());
    state.force.resize(state.size());
    state.mass.resize(state.size());
    return state;
}

} // namespace plash
