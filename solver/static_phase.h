#pragma once

#include "solver/explicit_loop.h"

namespace plash {

/// Static start (*CONTROL_DYNAMIC_RELAXATION IDRFLG = 5): moves the nodes of a scene that has just been set
/// up to where nothing is accelerated, with the loads that act while relaxing as they are at DRTERM. Leaves
/// the state with the places and stresses found, the velocities of the start, and an energy book that begins
/// anew.
///
/// Steps with the stiffness of the elements (StaticTangent), then Newton's method with GMRES (SUNDIALS'
/// KINSOL; Hindmarsh et al. 2005, ACM Trans. Math. Softw. 31, 363-396; Brown & Saad 1990, SIAM J. Sci. Stat.
/// Comput. 11, 450-481). Unknown are displacements, and the residual is the acceleration that the first cycle
/// of the run would see: all terms and constraints count as they are. A trial displacement u is reached in
/// one step h from the state of the start, which is kept in a restart file meanwhile: a force m u / h^2 on
/// every node, so that supports, rigid bodies and ties let nodes go only where they may; then everything is
/// at rest, and forces are summed once more. Eulerian fluids stand still and press on what they are coupled
/// with as their pressure is.
///
/// term_seconds  by term of the scene; what each takes is added
RelaxationOutcome find_equilibrium(Scene& scene, std::vector<std::unique_ptr<Recorder>>& recorders,
                                   std::vector<double>& term_seconds);

} // namespace plash
