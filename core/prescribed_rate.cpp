#include "core/prescribed_rate.h"

namespace plash {

double curve_value(const Model& model, Index curve, double time)
{
    return curve == none ? 1.0 : model.curves[curve].curve(time);
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
    }
    travelled += next * clock.step;
    return next;
}

} // namespace plash
