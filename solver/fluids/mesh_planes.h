#pragma once

#include "solver/fluids/water_walls.h"

namespace plash {

/// Planes of a box mesh along its three axes, ascending [length].
using MeshPlanes = std::array<std::vector<double>, 3>;

/// Planes for an Eulerian mesh that takes the water and what it may flow into. Where water stands, cells are
/// as large as its pieces (the smallest, where several lie beside one another along an axis; `choice.size`
/// sets the smallest of all); from fine to coarse they grow by at most a tenth from one to the next. Towards
/// walls the mesh reaches up to them (a gap of less than half a cell belongs to the last cells of the water);
/// elsewhere as far as the structures at `structure`, or as the choice says.
///
/// up  direction against gravity: 2 axis + 1 for the positive one; none: not known
MeshPlanes mesh_planes(const Water& water, const std::vector<WaterWall>& walls, const FluidChoice& choice,
                       const std::vector<Vec3>& structure, int up);

/// Planes from `begin` to `end`, the first left away: cells of size `wanted` inside, and at the ends not
/// larger than `first` and `last` times 1.1, 1.1^2, ... (0: no limit).
void append_interval(std::vector<double>& planes, double end, double wanted, double first, double last);

} // namespace plash
