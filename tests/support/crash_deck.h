#pragma once

#include <filesystem>

namespace plash::testing {

/// A small deck with nearly everything in it that a run carries from cycle to cycle: a plastic sheet with
/// failing elements, a plastic block of solids that hits it (contact with friction), a rigid block that is
/// driven and tumbles, a wall with friction, gravity, loads, driven and held nodes, all result files, and
/// restart files every 40 (running) and 400 cycles. Millimetre, millisecond, kilogram, kilonewton.
void write_crash_deck(const std::filesystem::path& path);

} // namespace plash::testing
