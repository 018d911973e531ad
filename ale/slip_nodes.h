#pragma once

#include "ale/box_fields.h"
#include "math/vector3.h"

#include <span>
#include <vector>

namespace plash {

/// A node on walls that are oblique to the global axes and along which fluid slips: its velocity has no part
/// along one or two directions.
struct SlipNode {
    std::ptrdiff_t place = 0;
    int count = 0;
    std::array<Vec3, 2> directions; ///< unit, across one another
};

/// What spans the directions, of any number and length, that a node may not move along.
/// Returns how many directions that are across one another; 3: it may not move at all
int span_of(const std::vector<Vec3>& directions, std::array<Vec3, 3>& across);

/// Takes their velocities across the walls from the nodes, after accelerate() and forces from outside.
/// Returns by how much the work of gravity falls with that, of masses m g on the nodes [energy].
double slip_along(FluidFields&, std::span<const SlipNode>, double step, const std::array<double, 3>& gravity);
/// The same after the remap; the kinetic energy that this takes counts as lost in the remap.
void slip_after_remap(FluidFields&, std::span<const SlipNode>);

} // namespace plash
