#pragma once

#include "solver/fluids/fluid_choice.h"

namespace plash {

/// Turns the water of a Model into the form that is chosen: its elements, what fills them, the walls that
/// hold it, and the contacts, couplings and ties between it and structures. All else stays as the deck has
/// it. Returns what became of what, a line each; nothing when no form is chosen. DeckError says why a deck
/// cannot be translated. See docs/fluids.md.
std::vector<std::string> translate_fluid(Model& model, const FluidChoice& choice);

} // namespace plash
