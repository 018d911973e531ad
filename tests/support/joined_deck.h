#pragma once

#include <string>

namespace plash::testing {

/// A small deck with everything that joins parts and carries a memory from cycle to cycle: blocks that are
/// tied by constraint, by springs and by a glue that breaks, struts of plastic beams that touch one another,
/// a spot weld beam that fails and a bolt with preload, springs and dampers, two rigid blocks on a hinge with
/// stiffness and friction, welds that fail, linear constraints, interpolation, a soft block with interior
/// contact. Restart files every 40 (running) and 400 cycles. Millimetre, millisecond, kilogram, kilonewton.
std::string joined_deck();

} // namespace plash::testing
