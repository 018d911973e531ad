#pragma once

#include "core/state.h"
#include "model/model.h"

#include <array>

namespace plash {

/// Axes of a coordinate system now: as at the start, or turned with its three nodes
/// (*DEFINE_COORDINATE_NODES, FLAG = 1).
std::array<Vec3, 3> axes_at(const CoordinateSystem& system, const State& state);

} // namespace plash
