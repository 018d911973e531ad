#include "solver/step_control.h"

#include "core/run_error.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

void StepControl::choose(Clock& clock, const std::vector<std::unique_ptr<Term>>& terms)
{
    owner_ = StepVote::nothing();
    for (const auto& term : terms) {
        const StepVote vote = term->stable_step();
        if (vote.step < owner_.step) owner_ = vote;
    }
    constexpr double rise = 1.0 / 50;  // of the way to what the vote allows, a cycle
    constexpr double band = 1.0 / 200; // of the vote, which elastic swings of metals do not leave
    const double allowed = (1 - band) * owner_.step;
    if (stable_ == 0 || !std::isfinite(stable_) || !std::isfinite(owner_.step) || owner_.step < stable_) {
        stable_ = owner_.step;
    } else if (allowed > stable_) {
        stable_ += rise * (allowed - stable_);
    }
    const TimeControls& control = model_.controls.time;
    const double scale = scale_;
    double step = scale * stable_;
    // Masses are scaled once: where elements, or contacts, ask for less later on, the step follows them.
    if (control.mass_scaled_step > 0) step = std::min(step, scale * control.mass_scaled_step);
    const NamedCurve* limit = nullptr; // where it is that of LCTM
    if (control.largest_step_curve != none) {
        const NamedCurve& curve = model_.curves[control.largest_step_curve];
        const double largest = curve.curve(clock.time);
        if (largest < step) limit = &curve;
        step = std::min(step, largest);
    }
    if (clock.cycle == 0 && control.initial_step > 0) step = std::min(step, control.initial_step);
    if (!std::isfinite(step)) {
        if (!(control.end_time > 0)) {
            throw RunError("nothing limits the step (all bodies are rigid or free) and the deck names no end "
                           "time: give ENDTIM of *CONTROL_TERMINATION, a thousandth of which is the step "
                           "then, or a curve of steps as LCTM of *CONTROL_TIMESTEP");
        }
        step = control.end_time / 1000;
    }
    if (!(step > 0) && limit) {
        const Location& where = limit->where;
        throw RunError(fmt::format("{}:{}: curve {}, LCTM of *CONTROL_TIMESTEP, lets the step be {:g} at t = "
                                   "{:g}; it must be above 0 "
                                   "up to the end of the run",
                                   where.file == none ? "" : model_.files[where.file], where.line, limit->id,
                                   step, clock.time));
    }
    if (!(step > 0)) {
        throw RunError(fmt::format("the stable step is {} ({} {} of part {})", owner_.step, owner_.kind,
                                   owner_.element, owner_.part));
    }
    if (first_step_ == 0) first_step_ = step;
    if (step < control.smallest_step_factor * first_step_) {
        throw RunError(fmt::format("the step {:.4e} fell below DTMIN = {:g} of the first one, {:.4e}; it is "
                                   "limited by {} {} of part {}",
                                   step, control.smallest_step_factor, first_step_, owner_.kind,
                                   owner_.element, owner_.part));
    }
    clock.step = step;
}

} // namespace plash
