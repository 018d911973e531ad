#pragma once

#include <filesystem>

namespace plash::testing {

/// Writes a deck that holds what an Eulerian fluid carries from cycle to cycle: a structured mesh that moves,
/// with water, oil and void, an elastic plate that falls into it, and a mesh of oblique
/// hexahedra with a viscous liquid, an ambient cell layer and a rigid plate.
void write_splash_deck(const std::filesystem::path& path);

} // namespace plash::testing
