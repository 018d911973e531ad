#include "materials/fu_chang_foam.h"
#include "materials/low_density_foam.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

LowDensityFoam foam(std::vector<std::pair<const char*, double>> more = {})
{
    Model model;
    NamedCurve curve;
    curve.id = 1;
    curve.curve = {{0, 0.1, 0.6, 0.8}, {0, 0.02, 0.04, 0.2}};
    model.curves.push_back(curve);
    more.insert(more.end(), {{"RO", 1}, {"E", 0.5}, {"LCID", 1}, {"TC", 0.03}});
    return LowDensityFoam::from_record(make_record("MAT_LOW_DENSITY_FOAM", std::move(more)), model);
}

/// Nominal stress along the first axis of a bar of unit section at a stretch; sides have the stretch b.
double at(const LowDensityFoam& law, double stretch, double* history, double b = 1)
{
    SymmetricTensor<double> stress{};
    law.update(stress, law.stretches(Tensor3<double>{stretch, 0, 0, 0, b, 0, 0, 0, b}),
               SymmetricTensor<double>{}, HistoryView<double>{history}, 1.0);
    EXPECT_NEAR(stress.yy, b == 1 ? 0 : stress.yy, 1e-16);
    return stress.xx * b * b;
}

} // namespace

TEST(LowDensityFoam, PressedFollowsItsCurveAndPulledItsModulus)
{
    const LowDensityFoam law = foam();
    double history[LowDensityFoam::history_size] = {};
    EXPECT_NEAR(at(law, 0.95, history), -0.01, 1e-15);
    EXPECT_NEAR(at(law, 0.5, history), -0.036, 1e-15);
    EXPECT_NEAR(at(law, 0.1, history), -0.28, 1e-14);  // beyond the curve with its last slope
    EXPECT_NEAR(at(law, 0.5, history), -0.036, 1e-15); // HU = 1: back as it came
    EXPECT_NEAR(at(law, 1.02, history), 0.01, 1e-15);
    EXPECT_NEAR(at(law, 1.5, history), 0.03, 1e-15);
    EXPECT_NEAR(at(law, 1.02, history), 0.01, 1e-15);
}

TEST(LowDensityFoam, TearsWithFail)
{
    const LowDensityFoam law = foam({{"FAIL", 1}});
    double history[LowDensityFoam::history_size] = {};
    EXPECT_NEAR(at(law, 1.05, history), 0.025, 1e-15);
    EXPECT_NEAR(at(law, 1.07, history), 0, 1e-15);
    EXPECT_NEAR(at(law, 1.02, history), 0, 1e-15);
    EXPECT_NEAR(at(law, 0.95, history), -0.01, 1e-15);
}

TEST(LowDensityFoam, UnloadsWithHysteresis)
{
    const double hu = 0.2, shape = 3;
    const LowDensityFoam law = foam({{"HU", hu}, {"SHAPE", shape}});
    double history[LowDensityFoam::history_size] = {};
    EXPECT_NEAR(at(law, 0.5, history), -0.036, 1e-15);
    const double most = 0.5 * 0.1 * 0.02 + 0.4 * 0.5 * (0.02 + 0.036); // areas below the curve
    EXPECT_NEAR(law.energy(0.5), most, 1e-15);
    const double now = 0.001 + 0.1 * 0.5 * (0.02 + 0.024);
    const double left = 1 - (1 - hu) * (1 - std::pow(now / most, shape));
    EXPECT_NEAR(at(law, 0.8, history), -0.024 * left, 1e-13);
    EXPECT_NEAR(at(law, 0.4, history), -0.04, 1e-15); // loading again, beyond
}

/// Simple shear: nominal stress of each principal direction from its stretch alone.
TEST(LowDensityFoam, ShearedTakesEachPrincipalDirectionByItself)
{
    const LowDensityFoam law = foam();
    double history[LowDensityFoam::history_size] = {};
    SymmetricTensor<double> stress{};
    const double g = 0.05;
    law.update(stress, law.stretches(Tensor3<double>{1, g, 0, 0, 1, 0, 0, 0, 1}), SymmetricTensor<double>{},
               HistoryView<double>{history}, 1.0);
    // Stretches s and 1 / s with s - 1 / s = g; left principal axis at atan(s).
    const double s = 0.5 * (g + std::sqrt(g * g + 4)), angle = std::atan(s);
    const double pulled = 0.5 * (s - 1) * s, pressed = -0.2 * (1 - 1 / s) / s; // Cauchy: nominal x stretch
    const double axis = std::numbers::pi / 2 - angle;
    EXPECT_NEAR(stress.xy, (pulled - pressed) * std::sin(axis) * std::cos(axis), 1e-12);
    EXPECT_NEAR(stress.xx,
                pulled * std::cos(axis) * std::cos(axis) + pressed * std::sin(axis) * std::sin(axis), 1e-12);
}

/// Pressed on all sides, nominal stresses are those of each direction; a bound of the wave speed.
TEST(LowDensityFoam, PressedOnAllSides)
{
    const LowDensityFoam law = foam();
    double history[LowDensityFoam::history_size] = {};
    SymmetricTensor<double> stress{};
    law.update(stress, law.stretches(Tensor3<double>{0.8, 0, 0, 0, 0.8, 0, 0, 0, 0.8}),
               SymmetricTensor<double>{}, HistoryView<double>{history}, 1.0);
    EXPECT_NEAR(stress.xx, -0.024 / 0.64, 1e-15);
    EXPECT_NEAR(stress.xy, 0, 1e-15);
    const Tensor3<double> dense{0.3, 0, 0, 0, 1, 0, 0, 0, 1};
    EXPECT_NEAR(law.wave_modulus(law.stretches(dense)), 0.5 / 0.3,
                1e-13); // E of the other directions: below 0.8 x 0.09
}

namespace {

FuChangFoam rated(std::vector<std::pair<const char*, double>> more = {})
{
    Model model;
    const auto add = [&](Id id, Curve curve) {
        NamedCurve named;
        named.id = id;
        named.curve = std::move(curve);
        model.curves.push_back(named);
    };
    add(1, {{0, 0.1, 0.8}, {0, 0.02, 0.09}});
    add(2, {{0, 0.1, 0.8}, {0, 0.06, 0.27}}); // three times as much at the rate 100
    NamedTable table;
    table.id = 9;
    table.abscissa = {0, 100};
    table.curves = {0, 1};
    model.tables.push_back(table);
    more.insert(more.end(), {{"RO", 1}, {"E", 0.5}, {"TBID", 9}});
    return FuChangFoam::from_record(make_record("MAT_FU_CHANG_FOAM", std::move(more)), model);
}

/// Pressed along x at a constant nominal rate from a stretch on; nominal stress at the end.
double press(const FuChangFoam& law, double& stretch, double to, double rate, double* history)
{
    const int steps = 4000;
    const double start = stretch, time = std::abs(start - to) / rate;
    SymmetricTensor<double> stress{};
    for (int i = 1; i <= steps; ++i) {
        const double next = start + (to - start) * i / steps;
        const double strain = (next - stretch) / (0.5 * (next + stretch)); // of mid-step
        law.update(stress, law.stretches(Tensor3<double>{next, 0, 0, 0, 1, 0, 0, 0, 1}),
                   SymmetricTensor<double>{strain, 0, 0, 0, 0, 0}, HistoryView<double>{history},
                   time / steps);
        stretch = next;
    }
    return stress.xx;
}

} // namespace

/// Between the curves of its table, linear in the nominal rate; back along the curve of the lowest rate (HU =
/// 0). The mean rate lags by some eleven steps of 1e-4, in which the stretch of 0.6 changes by 0.2 %.
TEST(FuChangFoam, PressedFollowsTheCurveOfItsRate)
{
    for (const double flag : {0.0, 1.0, 2.0}) {
        const FuChangFoam law = rated({{"SFLAG", 1}, {"RFLAG", flag}});
        for (const auto& [rate, factor] : {std::pair{1e-6, 1.0}, {50.0, 2.0}, {100.0, 3.0}, {1000.0, 3.0}}) {
            double history[FuChangFoam::history_size] = {}, stretch = 1;
            const double slow = 0.02 + 0.3 * 0.1; // at 40 %
            EXPECT_NEAR(press(law, stretch, 0.6, rate, history), -factor * slow, 0.006 * slow) << rate;
            EXPECT_NEAR(press(law, stretch, 0.8, rate, history), -(0.02 + 0.1 * 0.1), 1e-9) << rate;
        }
    }
}

/// Rates of the logarithm (SFLAG = 0) are larger by 1 / stretch.
TEST(FuChangFoam, TakesTrueRatesWithSflagZero)
{
    const FuChangFoam law = rated();
    double history[FuChangFoam::history_size] = {}, stretch = 1;
    const double factor = 1 + 2 * (30 / 0.6) / 100;
    EXPECT_NEAR(press(law, stretch, 0.6, 30, history), -factor * 0.05, 0.006 * 0.05);
}

TEST(FuChangFoam, UnloadsByDamageWithHu)
{
    const FuChangFoam law = rated({{"HU", 0.3}, {"SHAPE", 2}});
    double history[FuChangFoam::history_size] = {}, stretch = 1;
    press(law, stretch, 0.6, 1e-6, history);
    const double most = 0.001 + 0.3 * 0.5 * (0.02 + 0.05), now = 0.001 + 0.1 * 0.5 * (0.02 + 0.03);
    const double left = 1 - 0.7 * (1 - std::pow(now / most, 2));
    EXPECT_NEAR(press(law, stretch, 0.8, 1e-6, history), -0.03 * left, 1e-9);
    EXPECT_THROW(rated({{"TFLAG", 1}}), DeckError);
    EXPECT_THROW(rated({{"HU", 2}}), DeckError);
}

} // namespace plash
