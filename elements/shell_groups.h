#pragma once

#include "core/state.h"
#include "core/term.h"
#include "model/model.h"

#include <memory>
#include <vector>

namespace plash {

/// One term for each part of the Model that has deformable shells; allocates the State's rotational arrays
/// and adds the masses and inertias. Rigid parts (*MAT_RIGID) get none: see shell_mass.h for their masses.
/// Throws a DeckError for what a part asks that is not supported.
std::vector<std::unique_ptr<Term>> make_shell_groups(const Model& model, State& state);

} // namespace plash
