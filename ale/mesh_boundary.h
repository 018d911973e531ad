#pragma once

#include "ale/fluid.h"
#include "ale/fluid_settings.h"
#include "ale/mesh_block.h"

namespace plash {

/// A prescribed motion of a node of the mesh: the fluid there moves, the mesh does not.
struct DrivenHold {
    std::size_t held; ///< position among the held nodes
    int axis;
    const PrescribedMotion* motion;
};

/// Which nodes of a block are not free: *BOUNDARY_SPC, the columns of *NODE, *BOUNDARY_PRESCRIBED_MOTION
/// (velocities along an axis) and *CONTROL_ALE EBC.
struct MeshBoundary {
    std::vector<HeldNode> held;
    std::vector<SlipNode> slipping; ///< on walls that are oblique to the axes
    std::vector<DrivenHold> driven;
    bool open = false; ///< fluid may cross an outer face somewhere

    /// Velocities of driven nodes at both ends of a step.
    void follow(const Model& model, double time, double step);
};

MeshBoundary mesh_boundary_of(const Fluid& fluid, const MeshBlock& block, const FluidSettings& settings,
                              const Model& model);

} // namespace plash
