#pragma once

#include "model/model.h"

#include <optional>
#include <string>
#include <string_view>

namespace plash {

/// How the water of a deck is computed.
enum class FluidForm {
    lagrange, ///< solids that go with the water
    sph,      ///< particles
    ale       ///< an Eulerian mesh through which it flows
};

std::string_view to_string(FluidForm form);

/// What `--fluid` and *PLASH_FLUID ask for.
struct FluidChoice {
    std::optional<FluidForm> form; ///< nothing: the water stays as the deck has it
    double size = 0;           ///< SIZE: of the smallest cells, or spacing of the particles [length]; 0: of
                               ///< the deck's elements
    double height = 0;         ///< HEIGHT of the empty cells above the water [length]; 0: found
    std::optional<Box> region; ///< BOXID: what an Eulerian mesh covers
    Location where;            ///< of *PLASH_FLUID, where the deck has it
};

/// `asked` is the word behind --fluid, empty without it; it goes before FLUID of *PLASH_FLUID. DeckError for
/// words that name no form and values without meaning.
FluidChoice fluid_choice_of(const Model& model, std::string_view asked);

} // namespace plash
