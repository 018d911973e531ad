#pragma once

#include "core/clock.h"
#include "solver/scene.h"
#include "solver/step_control.h"

#include <vector>

namespace plash {

/// The pieces of a cycle that the run and its phase of dynamic relaxation share. `seconds` takes what each
/// term of the scene takes.

/// Forces of all terms at n, and the step from n to n+1.
void sum_forces(Scene& scene, Clock& clock, StepControl& step_control, std::vector<double>& seconds);

/// Conditions change the forces.
void constrain_forces(Scene& scene, const Clock& clock, std::vector<double>& seconds);

/// Positions to n+1, and the clock with them.
void move_nodes(Scene& scene, Clock& clock, std::vector<double>& seconds);

/// Takes all energies at n.
void close_ledger(Scene& scene, double kinetic);

/// RunError for a kinetic energy that is not a number: says at which node it began.
void check_finite(const Scene& scene);

} // namespace plash
