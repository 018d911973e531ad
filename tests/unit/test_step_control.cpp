#include "solver/step_control.h"

#include "core/run_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plash {

namespace {

/// A term that votes for what the test says.
class Voter : public Term {
public:
    double step = 1;
    std::string_view name() const override { return "voter"; }
    StepVote stable_step() const override { return {step, "thing", 1, 1}; }
};

} // namespace

/// Down at once, up by a fiftieth of the way: a vote that swings every other cycle leaves the step at its
/// lower end, and one that rises for good is followed to half a per cent.
TEST(StepControl, FallsAtOnceAndRisesSlowly)
{
    Model model;
    model.controls.time.step_scale = 0.9;
    std::vector<std::unique_ptr<Term>> terms;
    terms.push_back(std::make_unique<Voter>());
    auto& voter = static_cast<Voter&>(*terms.front());
    StepControl control(model);
    Clock clock;
    const auto next = [&](double vote) {
        voter.step = vote;
        control.choose(clock, terms);
        ++clock.cycle;
        return clock.step;
    };
    EXPECT_DOUBLE_EQ(next(1.0), 0.9);
    EXPECT_DOUBLE_EQ(next(0.5), 0.45);
    EXPECT_DOUBLE_EQ(next(1.0), 0.9 * (0.5 + (0.995 - 0.5) / 50));
    for (int i = 0; i < 100; ++i) {
        next(0.5);
        EXPECT_LT(next(0.52), 0.9 * 0.5005);
    }
    for (int i = 0; i < 500; ++i) next(1.0);
    EXPECT_NEAR(clock.step, 0.9 * 0.995, 1e-4);
    EXPECT_EQ(control.first_step(), 0.9);
}

/// An element that swings by 0.4 %, as steel does at its yield stress, ten cycles up and down: after the
/// first swing the step is constant to the bit.
TEST(StepControl, StaysWhereItIsUnderElasticSwings)
{
    const Model model;
    std::vector<std::unique_ptr<Term>> terms;
    terms.push_back(std::make_unique<Voter>());
    auto& voter = static_cast<Voter&>(*terms.front());
    StepControl control(model);
    Clock clock;
    double lowest = 1;
    for (int i = 0; i < 1000; ++i) {
        voter.step = 1 - 0.002 * std::sin(0.2 * std::numbers::pi * i);
        lowest = std::min(lowest, voter.step);
        control.choose(clock, terms);
        ++clock.cycle;
        if (i > 20) {
            ASSERT_EQ(clock.step, model.controls.time.step_scale * lowest);
        }
    }
}

/// Nothing but rigid bodies: a thousandth of the run, or a word that names the way out.
TEST(StepControl, WithoutVotesTheEndTimeGivesTheStep)
{
    Model model;
    model.controls.time.step_scale = 0.9;
    model.controls.time.end_time = 2;
    const std::vector<std::unique_ptr<Term>> no_terms;
    Clock clock;
    StepControl(model).choose(clock, no_terms);
    EXPECT_DOUBLE_EQ(clock.step, 2e-3);
    model.controls.time.end_time = 0;
    try {
        StepControl(model).choose(clock, no_terms);
        FAIL() << "no error";
    } catch (const RunError& error) {
        EXPECT_NE(std::string(error.what()).find("ENDTIM of *CONTROL_TERMINATION"), std::string::npos);
    }
}

/// LCTM that comes to zero ends the run and is named with its curve, file and line.
TEST(StepControl, CurveOfLargestStepsAtZeroIsNamed)
{
    Model model;
    model.files = {"steps.k"};
    NamedCurve curve;
    curve.id = 7;
    curve.where = {0, 12};
    curve.curve = Curve{{0, 1}, {0.5, 0}};
    model.curves.push_back(curve);
    model.controls.time.largest_step_curve = 0;
    std::vector<std::unique_ptr<Term>> terms;
    terms.push_back(std::make_unique<Voter>());
    StepControl control(model);
    Clock clock;
    control.choose(clock, terms);
    EXPECT_EQ(clock.step, 0.5);
    clock.time = 1;
    try {
        control.choose(clock, terms);
        FAIL() << "a step of zero";
    } catch (const RunError& error) {
        EXPECT_NE(std::string(error.what()).find("steps.k:12: curve 7, LCTM of *CONTROL_TIMESTEP"),
                  std::string::npos)
            << error.what();
    }
}

} // namespace plash
