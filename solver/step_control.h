#pragma once

#include "core/term.h"
#include "model/model.h"

#include <memory>
#include <vector>

namespace plash {

/// Chooses the step from n to n+1 by the deck's rules (*CONTROL_TIMESTEP, *CONTROL_TERMINATION DTMIN).
class StepControl {
public:
    explicit StepControl(const Model& model) : model_(model) {}

    /// Sets clock.step from the smallest vote of the terms, and keeps whose it was. RunError when the step
    /// collapses below DTMIN, or when nothing limits it and the deck names no step.
    void choose(Clock& clock, const std::vector<std::unique_ptr<Term>>& terms);

    const StepVote& owner() const { return owner_; }
    double first_step() const { return first_step_; }
    void serialise(Archive& archive) { archive(first_step_); }

private:
    const Model& model_;
    StepVote owner_;
    double first_step_ = 0;
};

} // namespace plash
