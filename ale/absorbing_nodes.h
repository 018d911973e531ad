#pragma once

#include "ale/fluid.h"
#include "ale/mesh_block.h"

namespace plash {

/// Nodes of the segments of *BOUNDARY_NON_REFLECTING on outer faces of an Eulerian mesh, once its fluid has
/// started. DeckError where such a segment is no outer face of it.
std::vector<AbsorbingNode> absorbing_nodes_of(const Fluid& fluid, const MeshBlock& block, const Model& model);

/// The forces beyond the pressure that stands outside anyway, found from the velocities that accelerate() has
/// left: implicitly, with the mean of those before and after the step.
void find_absorbing_forces(const FluidFields& fields, std::span<const AbsorbingNode> nodes, double step,
                           double outside_pressure, std::vector<NodeForceFromOutside>& forces);

} // namespace plash
