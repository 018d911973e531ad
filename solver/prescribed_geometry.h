#pragma once

#include "solver/explicit_loop.h"

namespace plash {

/// *CONTROL_DYNAMIC_RELAXATION IDRFLG = 2: moves the nodes of a scene that has just been set up to a geometry
/// that the deck's user gives, in NC cycles and by equal parts of the way and of the rotation, so that
/// elements have the stresses that belong to it. Nodes without displacements stay; forces have no say. The
/// step is TSSFDR times the smallest vote, which matters to rate-dependent materials only. Leaves the state
/// with the places and stresses reached, the velocities of the start, and an energy book that begins anew.
///
/// term_seconds  by term of the scene; what each takes is added
RelaxationOutcome move_to_geometry(Scene& scene, const std::vector<NodeDisplacement>& geometry,
                                   std::vector<std::unique_ptr<Recorder>>& recorders,
                                   std::vector<double>& term_seconds);

} // namespace plash
