#pragma once

#include "core/clock.h"
#include "model/model.h"

namespace plash {

/// Value of a curve of the Model at a time; 1 when there is no curve.
double curve_value(const Model& model, Index curve, double time);

/// Velocity over the step from n to n+1 that a prescribed motion asks for.
/// velocity   the freedom's velocity at n-1/2
/// travelled  displacement (or angle) of the freedom up to n; advanced to n+1
double prescribed_rate(const Model& model, const PrescribedMotion& motion, const Clock& clock,
                       double velocity, double& travelled);

} // namespace plash
