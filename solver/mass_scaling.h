#pragma once

#include "core/selective_masses.h"
#include "solver/scene.h"

namespace plash {

/// Mass scaling of *CONTROL_TIMESTEP, before the first cycle: DT2MS, the step that the deck wants, bought
/// with mass; negative: only where it is needed; DT2MSF: so many times the smallest step that elements have
/// now. Books what it adds in the scene. With IMSCL, the mass that parts get selectively is listed and not
/// added.
SelectiveMasses scale_masses(Scene& scene);

} // namespace plash
