#include "core/prescribed_rate.h"

namespace plash {

double curve_value(const Model& model, Index curve, double time)
{
    return curve == none ? 1.0 : model.curves[curve].curve(time);
}

bool acts_now(const Model& model, Index curve, const Clock& clock)
{
    if (curve == none) return true;
    return clock.relaxing ? model.curves[curve].in_relaxation : model.curves[curve].in_transient;
}

double load_value(const Model& model, Index curve, const Clock& clock, double time)
{
    return acts_now(model, curve, clock) ? curve_value(model, curve, time) : 0;
}

double body_load_value(const Model& model, const BodyLoad& load, const Clock& clock)
{
    const bool acts = load.phase == BodyLoad::Phase::of_curve
                          ? acts_now(model, load.curve, clock)
                          : clock.relaxing == (load.phase == BodyLoad::Phase::relaxation);
    return acts ? load.scale * curve_value(model, load.curve, clock.time) : 0;
}

double prescribed_rate(const Model& model, const PrescribedMotion& motion, const Clock& clock,
                       double velocity, double& travelled)
{
    const auto prescribed = [&](double time) {
        return motion.scale * curve_value(model, motion.curve, time - motion.birth);
    };
    double next = 0;
    switch (motion.kind) {
    case PrescribedMotion::Kind::velocity:
        next = prescribed(clock.time + 0.5 * clock.step);
        break;
    case PrescribedMotion::Kind::acceleration:
        next = velocity + prescribed(clock.time) * clock.velocity_step();
        break;
    case PrescribedMotion::Kind::displacement:
        next = (prescribed(clock.time + clock.step) - travelled) / clock.step;
        break;
    case PrescribedMotion::Kind::velocity_of_displacement:
        next = motion.scale * curve_value(model, motion.curve, travelled);
        break;
    case PrescribedMotion::Kind::relative_displacement: // between rigid bodies, which see to it themselves
        break;
    }
    travelled += next * clock.step;
    return next;
}

} // namespace plash
