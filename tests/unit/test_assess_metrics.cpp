#include "assess/grid_convergence.h"
#include "assess/iso_18571.h"
#include "assess/metrics.h"
#include "assess/run_cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace plash {

namespace {

TimeCurve curve_of(const std::function<double(double)>& f, double from = 0, double to = 1,
                   std::size_t count = 1001)
{
    TimeCurve curve;
    for (std::size_t i = 0; i < count; ++i) {
        const double time = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
        curve.time.push_back(time);
        curve.value.push_back(f(time));
    }
    return curve;
}

} // namespace

TEST(TimeCurve, IsInterpolatedLinearlyAndKeepsItsEnds)
{
    const TimeCurve curve{{0, 1, 3}, {2, 4, 0}};
    EXPECT_DOUBLE_EQ(value_at(curve, -1), 2);
    EXPECT_DOUBLE_EQ(value_at(curve, 0.25), 2.5);
    EXPECT_DOUBLE_EQ(value_at(curve, 2), 2);
    EXPECT_DOUBLE_EQ(value_at(curve, 5), 0);
    EXPECT_DOUBLE_EQ(impulse(curve), 3 + 4);
    EXPECT_DOUBLE_EQ(peak(curve).time, 1);
}

TEST(CurveErrors, AFactorIsAllMagnitudeAndNoPhase)
{
    const TimeCurve reference = curve_of([](double t) { return std::sin(2 * std::numbers::pi * t) + 0.5; });
    const TimeCurve larger =
        curve_of([](double t) { return 1.2 * (std::sin(2 * std::numbers::pi * t) + 0.5); });
    const CurveErrors errors = curve_errors(reference, larger);
    EXPECT_NEAR(errors.sprague_geers.magnitude, 0.2, 1e-12);
    EXPECT_NEAR(errors.sprague_geers.phase, 0, 1e-7); // acos near 1 loses half of the digits
    EXPECT_NEAR(errors.peak, 0.2, 1e-12);
    EXPECT_NEAR(errors.impulse, 0.2, 1e-12);
    EXPECT_NEAR(errors.peak_time, 0, 1e-12);
}

TEST(CurveErrors, AShiftIsAllPhaseAndNoMagnitude)
{
    // Over whole periods the product of two sines shifted by phi is cos(phi) of their squares.
    const double phi = 0.3;
    const TimeCurve reference = curve_of([](double t) { return std::sin(4 * std::numbers::pi * t); });
    const TimeCurve late = curve_of([&](double t) { return std::sin(4 * std::numbers::pi * t - phi); });
    const CurveErrors errors = curve_errors(reference, late);
    EXPECT_NEAR(errors.sprague_geers.magnitude, 0, 1e-12);
    EXPECT_NEAR(errors.sprague_geers.phase, phi / std::numbers::pi, 1e-12);
    EXPECT_NEAR(errors.sprague_geers.comprehensive, phi / std::numbers::pi, 1e-12);
    EXPECT_NEAR(errors.rms, 2 * std::sin(phi / 2) * std::sqrt(0.5), 1e-3); // both end points counted whole
}

/// Curves that are zero throughout have neither magnitude nor phase to differ in.
TEST(CurveErrors, NothingBesideNothingIsNoError)
{
    TimeCurve zero;
    for (int i = 0; i <= 10; ++i) {
        zero.time.push_back(0.1 * i);
        zero.value.push_back(0);
    }
    const CurveErrors errors = curve_errors(zero, zero);
    EXPECT_EQ(errors.sprague_geers.magnitude, 0);
    EXPECT_EQ(errors.sprague_geers.phase, 0);
    EXPECT_EQ(errors.sprague_geers.comprehensive, 0);
}

TEST(IsoRating, EqualCurvesAreExcellent)
{
    const TimeCurve curve = curve_of([](double t) { return t * std::exp(-5 * t); });
    const IsoRating rating = iso_rating(curve, curve);
    EXPECT_DOUBLE_EQ(rating.overall, 1);
    EXPECT_STREQ(rating.grade(), "excellent");
}

TEST(IsoRating, AnOffsetCostsCorridorAndMagnitudeOnly)
{
    // |reference| is 1 at most, so an offset of 0.2 scores ((0.5 - 0.2) / 0.45)^2 everywhere.
    const TimeCurve reference = curve_of([](double t) { return std::cos(2 * std::numbers::pi * t); });
    const TimeCurve higher = curve_of([](double t) { return std::cos(2 * std::numbers::pi * t) + 0.2; });
    const IsoRating rating = iso_rating(reference, higher);
    EXPECT_NEAR(rating.corridor, 4.0 / 9, 1e-12);
    EXPECT_DOUBLE_EQ(rating.phase, 1);
    EXPECT_NEAR(rating.slope, 1, 1e-12);
    EXPECT_LT(rating.magnitude, 1);
    EXPECT_NEAR(rating.overall, 0.4 * rating.corridor + 0.2 * (2 + rating.magnitude), 1e-12);
}

TEST(IsoRating, AShiftCostsItsShareOfAFifthOfTheSpan)
{
    const auto hump = [](double t) { return std::exp(-50 * (t - 0.5) * (t - 0.5)); };
    const TimeCurve reference = curve_of(hump);
    for (const double shift : {0.05, -0.05}) {
        const IsoRating rating = iso_rating(reference, curve_of([&](double t) { return hump(t - shift); }));
        EXPECT_NEAR(rating.phase, 1 - 50 / (0.2 * 1001), 1e-12) << shift;
        EXPECT_NEAR(rating.magnitude, 1, 1e-6) << shift; // nothing is left once shifted
        EXPECT_NEAR(rating.slope, 1, 1e-6) << shift;
    }
    const IsoRating late = iso_rating(reference, curve_of([&](double t) { return hump(t - 0.4); }));
    EXPECT_LT(late.phase, 0.01);
}

TEST(GridConvergence, GivesTheExamplesOfTheProcedure)
{
    // Celik et al. (2008), table 1: reattachment length on grids of 18,000, 8,000 and 4,500 cells; axial
    // velocity at two places on 18,000, 4,500 and 980 cells. Printed: order, extrapolated value, index of the
    // fine grid.
    struct Example {
        double size[3], value[3], order, extrapolated, index;
        bool oscillating;
    };
    const double coarsest = 2 * std::sqrt(4500.0 / 980);
    for (const Example& e :
         {Example{{1, 1.5, 2}, {6.063, 5.972, 5.863}, 1.53, 6.1685, 0.022, false},
          Example{{1, 2, coarsest}, {10.7880, 10.7250, 10.6050}, 0.75, 10.8801, 0.011, false},
          Example{{1, 2, coarsest}, {6.0042, 5.9624, 6.0909}, 1.51, 6.0269, 0.005, true}}) {
        const GridConvergence found = grid_convergence(e.size, e.value);
        EXPECT_NEAR(found.order, e.order, 0.006);
        EXPECT_NEAR(found.extrapolated, e.extrapolated, 6e-4);
        EXPECT_NEAR(found.index_fine, e.index, 5e-4);
        EXPECT_EQ(found.oscillating, e.oscillating);
    }
}

TEST(GridConvergence, FindsTheOrderThatValuesWereMadeWith)
{
    const auto value = [](double h) { return 3 - 0.2 * std::pow(h, 2.47); };
    const GridConvergence found = grid_convergence({1, 2, 4}, {value(1), value(2), value(4)});
    EXPECT_NEAR(found.order, 2.47, 1e-12);
    EXPECT_NEAR(found.extrapolated, 3, 1e-12);
    EXPECT_NEAR(found.index_fine, 1.25 * 0.2 / value(1), 1e-12);
    EXPECT_NEAR(found.index_coarse, 1.25 * 0.2 * std::pow(2, 2.47) / value(2), 1e-12);
}

TEST(GridConvergence, AveragesHistoriesThatConvergeWithOneOrder)
{
    // f(t, h) = t (3 - 0.2 h^2): relative to the largest fine value 2.8, the mean difference of h = 1 and 2
    // is 0.6 mean(t) / 2.8, and the factor 2^2 - 1 = 3.
    const auto curve = [](double h) { return curve_of([h](double t) { return t * (3 - 0.2 * h * h); }); };
    const TimeCurve fine = curve(1), medium = curve(2), coarse = curve(4);
    const AveragedConvergence found = averaged_convergence({1, 2, 4}, {&fine, &medium, &coarse});
    EXPECT_NEAR(found.order, 2, 1e-9);
    EXPECT_EQ(found.points, 1000u); // all but t = 0
    EXPECT_NEAR(found.index_fine, 1.25 * 0.6 * 0.5 / 2.8 / 3, 1e-12);
    EXPECT_NEAR(found.index_coarse, 1.25 * 2.4 * 0.5 / 2.8 / 3, 1e-12);
}

TEST(ParetoFront, HoldsTheRunsThatNobodyBeats)
{
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(pareto_front({4, 2, 3, 1, 1, none}, {1, 2, 3, 9, 8, 0}),
              (std::vector<bool>{true, true, false, false, true, false}));
    EXPECT_EQ(pareto_front({1, 1}, {1, 1}), (std::vector<bool>{true, true}));
}

} // namespace plash
