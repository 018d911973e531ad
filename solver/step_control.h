#pragma once

#include "core/term.h"
#include "model/model.h"

#include <memory>
#include <vector>

namespace plash {

/// Chooses the step from n to n+1 by the deck's rules (*CONTROL_TIMESTEP, *CONTROL_TERMINATION DTMIN).
///
/// The step falls at once with the smallest vote; it stays where it is while the vote is up to half a per
/// cent longer, and rises by a fiftieth of the way to that bound in a cycle when the vote is longer still. A
/// vote swings with the element that gives it, in a few cycles up and down; a step that swings along is in
/// time with this vibration and feeds or starves it, by the strain in every swing (central difference keeps
/// energy for a constant step alone). With the band, swings of elastic metals leave the step at their lower
/// end.
class StepControl {
public:
    explicit StepControl(const Model& model) : StepControl(model, model.controls.time.step_scale) {}
    /// With a factor on the votes of its own (TSSFDR of dynamic relaxation).
    StepControl(const Model& model, double scale) : model_(model), scale_(scale) {}

    /// Sets clock.step from the smallest vote of the terms, and keeps whose it was. RunError when the step
    /// collapses below DTMIN, or when nothing limits it and the deck names no step.
    void choose(Clock& clock, const std::vector<std::unique_ptr<Term>>& terms);

    const StepVote& owner() const { return owner_; }
    double first_step() const { return first_step_; }
    void serialise(Archive& archive) { archive(first_step_, stable_); }

private:
    const Model& model_;
    double scale_;
    StepVote owner_;
    double first_step_ = 0;
    double stable_ = 0; ///< what follows the votes [time]; 0: none yet
};

} // namespace plash
