#pragma once

#include "core/clock.h"
#include "model/model.h"

namespace plash {

/// Value of a curve of the Model at a time; 1 when there is no curve.
double curve_value(const Model& model, Index curve, double time);

/// Whether a curve has a say in this phase of the run (SIDR of *DEFINE_CURVE). No curve: always.
bool acts_now(const Model& model, Index curve, const Clock& clock);

/// As curve_value for a load or a motion: zero in the phase in which its curve has no say.
double load_value(const Model& model, Index curve, const Clock& clock, double time);

/// Value of a body load's curve times its scale, in the phases in which it acts.
double body_load_value(const Model& model, const BodyLoad& load, const Clock& clock);

/// Velocity over the step from n to n+1 that a prescribed motion asks for.
/// velocity   the freedom's velocity at n-1/2
/// travelled  displacement (or angle) of the freedom up to n; advanced to n+1
double prescribed_rate(const Model& model, const PrescribedMotion& motion, const Clock& clock,
                       double velocity, double& travelled);

} // namespace plash
