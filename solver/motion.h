#pragma once

#include "core/clock.h"
#include "core/state.h"

namespace plash {

/// v(n+1/2) = v(n-1/2) + force / mass * velocity_step for every node that has mass, and the same for
/// rotations. Returns the kinetic energy at n as sum of mass v(n-1/2) . v(n+1/2) / 2, the form that central
/// difference conserves together with the strain energy at n for a linear system.
double advance_velocities(const Clock& clock, State& state);

/// x(n+1) = x(n) + v(n+1/2) * step.
void advance_positions(const Clock& clock, State& state);

} // namespace plash
