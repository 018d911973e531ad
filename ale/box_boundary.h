#pragma once

#include "ale/box_fields.h"
#include "ale/slip_nodes.h"

#include <span>

namespace plash {

/// A node whose velocity is given along some axes of the box: fixed, on a wall, or driven.
struct HeldNode {
    std::ptrdiff_t place = 0;
    unsigned axes = 0;              ///< bits 1, 2, 4
    std::array<double, 3> before{}; ///< velocities along these axes at t_n [velocity]
    std::array<double, 3> after{};  ///< and at the end of the step [velocity]
};

/// An outside force on a node.
struct NodeForceFromOutside {
    std::ptrdiff_t place = 0;
    std::array<double, 3> force{}; ///< [force]
};

/// Work done on the fluid in a step, for the energy balance [energy].
struct OutsideWork {
    double forces = 0;  ///< by outside forces
    double driving = 0; ///< by driven nodes
    double gravity = 0; ///< correction where nodes do not follow gravity alone
};

/// Adds the impulses of outside forces to the velocities that accelerate() has found: force times
/// `impulse_step`, the span over which the structures' side of the same force acts. Returns the correction of
/// gravity's work only.
OutsideWork push_nodes(FluidFields&, std::span<const NodeForceFromOutside>, double step, double impulse_step,
                       const std::array<double, 3>& gravity);
/// Work of outside forces in the step, once its mean velocities are known [energy].
double work_of_forces(const FluidFields&, std::span<const NodeForceFromOutside>, double impulse_step);

/// Adds outside forces to the velocities that accelerate() has found, then gives slipping and held nodes
/// theirs.
OutsideWork apply_outside(FluidFields&, std::span<const NodeForceFromOutside>, std::span<const HeldNode>,
                          std::span<const SlipNode>, double step, double impulse_step,
                          const std::array<double, 3>& gravity);

/// Velocities of held nodes after the remap; the kinetic energy that this takes counts as lost in the remap.
void hold_nodes(FluidFields&, std::span<const HeldNode>);

/// A pressure beyond the outer faces of the box: into the ghosts, for the forces of the coming step.
void press_on_sides(const BoxGrid&, FluidFields&, double pressure);
/// Its work in the step, once the volumes that pass the faces are known [energy].
double work_on_sides(const BoxGrid&, const FluidFields&, const BoxContents&, double pressure);

/// Kinetic energy that leaves through the outer faces across an axis in its sweep, with the masses that pass
/// there and the velocities which the nodes have before their momentum is swept [energy].
double motion_through_sides(const BoxGrid&, const FluidFields&, int axis);

/// Nodes of the box's sides, held against flow through them (slip walls); bit 2 axis + side of `sides` names
/// a side.
std::vector<HeldNode> walls_of_box(const BoxGrid&, unsigned sides = 0x3f);

} // namespace plash
