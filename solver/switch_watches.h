#pragma once

#include "core/term.h"
#include "rigid/part_switches.h"

#include <memory>
#include <vector>

namespace plash {

/// Tells the switches of parts whether their walls and contacts press. DeckError where there is no such wall
/// or contact of surfaces. Terms must outlive the switches.
void watch_forces(PartSwitches& switches, const Model& model,
                  const std::vector<std::unique_ptr<Term>>& terms);

} // namespace plash
