#include "materials/compression_tension.h"
#include "materials/damaged_plasticity.h"
#include "tests/support/law_driver.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace plash {

namespace {

// Units: mm, ms, kg, GPa.
constexpr double sheet_young = 200, sheet_poisson = 0.3, sheet_yield = 0.3, sheet_tangent = 2;
constexpr double sheet_shear = sheet_young / (2 * (1 + sheet_poisson)),
                 sheet_hardening = sheet_young * sheet_tangent / (sheet_young - sheet_tangent);

Model curves()
{
    Model model;
    const auto add = [&](Id id, Curve curve) {
        NamedCurve named;
        named.id = id;
        named.curve = std::move(curve);
        model.curves.push_back(named);
    };
    add(1, {{0, 0.1, 0.2}, {0, 0.4, 0.5}}); // damage over plastic strain - EPPF
    add(2, {{0, 1}, {0.5, 0.7}});           // flow stress in compression
    add(3, {{0, 1}, {0.2, 0.3}});           // and in tension
    return model;
}

DamagedPlasticity damaged(std::vector<std::pair<const char*, double>> more)
{
    more.insert(more.end(), {{"RO", 7.8e-6},
                             {"E", sheet_young},
                             {"PR", sheet_poisson},
                             {"SIGY", sheet_yield},
                             {"ETAN", sheet_tangent}});
    return DamagedPlasticity::from_record(make_record("MAT_PLASTICITY_WITH_DAMAGE", std::move(more)),
                                          curves());
}

CompressionTension concrete(std::vector<std::pair<const char*, double>> more)
{
    more.insert(more.end(),
                {{"RO", 7.8e-6}, {"E", sheet_young}, {"PR", sheet_poisson}, {"LCIDC", 2}, {"LCIDT", 3}});
    return CompressionTension::from_record(make_record("MAT_PLASTICITY_COMPRESSION_TENSION", std::move(more)),
                                           curves());
}

/// Stress and plastic strain after 200 steps, each with the side strain that leaves yy free of stress.
/// take  update of a stress and a history by a step with this side strain
std::pair<SymmetricTensor<double>, double>
walk_uniaxially(const std::function<void(SymmetricTensor<double>&, HistoryView<double>, double)>& take)
{
    std::array<double, CompressionTension::history_size + 1> history{};
    SymmetricTensor<double> stress{};
    for (int i = 0; i < 200; ++i) {
        double low = -1e-3, high = 1e-3;
        SymmetricTensor<double> end{};
        auto end_history = history;
        for (int k = 0; k < 60; ++k) {
            const double side = 0.5 * (low + high);
            end = stress;
            end_history = history;
            take(end, HistoryView<double>{end_history.data()}, side);
            (end.yy > 0 ? high : low) = side;
        }
        stress = end;
        history = end_history;
    }
    return {stress, history[0]};
}

/// Plastic strain and flow stress of a simple shear g: g / sqrt(3) = p + (first + slope p) / 3 G.
struct Sheared {
    double plastic, stress;
};
Sheared sheared(double g, double first, double slope)
{
    const double p = (g / std::sqrt(3.0) - first / (3 * sheet_shear)) / (1 + slope / (3 * sheet_shear));
    return {p, (first + slope * p) / std::sqrt(3.0)};
}

} // namespace

/// Shear up to and beyond EPPF, back elastically: stress and stiffness are those of the part 1 - w of the
/// section.
TEST(DamagedPlasticity, ShearedLosesStrengthAndStiffness)
{
    const double onset = 0.05, rupture = 0.25;
    const DamagedPlasticity law = damaged({{"EPPF", onset}, {"EPPFR", rupture}});
    EXPECT_TRUE(law.fractures());
    testing::DrivenPoint point(law);
    point.strain({0, 0, 0, 0.5 * 0.08, 0, 0}, 100);
    const Sheared whole = sheared(0.08, sheet_yield, sheet_hardening);
    EXPECT_LT(whole.plastic, onset);
    EXPECT_NEAR(point.stress.xy, whole.stress, 1e-12);
    point.strain({0, 0, 0, 0.5 * 0.12, 0, 0}, 100);
    const Sheared hurt = sheared(0.2, sheet_yield, sheet_hardening);
    const double w = (hurt.plastic - onset) / (rupture - onset);
    EXPECT_NEAR(point.history[DamagedPlasticity::plastic_strain], hurt.plastic, 1e-12);
    EXPECT_NEAR(point.stress.xy, (1 - w) * hurt.stress, 1e-12);
    point.strain({0, 0, 0, -0.5e-4, 0, 0});
    EXPECT_NEAR(point.stress.xy, (1 - w) * (hurt.stress - sheet_shear * 1e-4), 1e-12);
    point.strain({1e-5, 1e-5, 1e-5, 0, 0, 0}); // the bulk modulus too
    EXPECT_NEAR(point.stress.xx, (1 - w) * 3e-5 * sheet_young / (3 * (1 - 2 * sheet_poisson)), 1e-12);
    point.strain({0, 0, 0, 0.5, 0, 0}, 500);
    EXPECT_TRUE(law.failed(HistoryView<double>{point.history.data()}));
    EXPECT_EQ(point.stress.xy, 0);
}

TEST(DamagedPlasticity, FollowsTheCurveOfDamage)
{
    const DamagedPlasticity law = damaged({{"EPPF", 0.03}, {"LCDM", 1}});
    testing::DrivenPoint point(law);
    point.strain({0, 0, 0, 0.5 * 0.3, 0, 0}, 300);
    const Sheared hurt = sheared(0.3, sheet_yield, sheet_hardening);
    const double beyond = hurt.plastic - 0.03, w = 0.4 + (beyond - 0.1) * 1;
    EXPECT_GT(beyond, 0.1);
    EXPECT_NEAR(point.stress.xy, (1 - w) * hurt.stress, 1e-12);
}

/// A bar in plane stress (uniaxial stress along x by a lateral strain found by secants).
TEST(DamagedPlasticity, PulledAsAShellPointLosesItsShare)
{
    const double onset = 0.02, rupture = 0.12;
    const DamagedPlasticity law = damaged({{"EPPF", onset}, {"EPPFR", rupture}});
    std::array<double, DamagedPlasticity::history_size> history = law.initial_history();
    SymmetricTensor<double> stress{};
    const int steps = 400;
    for (int i = 0; i < steps; ++i) {
        double low = -1e-3, high = 1e-3;
        SymmetricTensor<double> end{};
        auto end_history = history;
        for (int k = 0; k < 60; ++k) {
            const double yy = 0.5 * (low + high);
            end = stress;
            end_history = history;
            SymmetricTensor<double> increment{0.06 / steps, yy, 0, 0, 0, 0};
            law.update_plane_stress(end, increment, HistoryView<double>{end_history.data()}, 1.0);
            (end.yy > 0 ? high : low) = yy;
        }
        stress = end;
        history = end_history;
    }
    const double p = history[DamagedPlasticity::plastic_strain], w = (p - onset) / (rupture - onset);
    EXPECT_NEAR(p, 0.06 - (sheet_yield + sheet_hardening * p) / sheet_young, 1e-6);
    EXPECT_NEAR(stress.xx, (1 - w) * (sheet_yield + sheet_hardening * p), 1e-6);
}

TEST(DamagedPlasticity, WrongDamageIsRefused)
{
    EXPECT_THROW(damaged({{"EPPF", 0.3}, {"EPPFR", 0.2}}), DeckError);
    EXPECT_THROW(damaged({{"EPPF", 0.3}, {"LCDM", 2}, {"NUMINT", 2}}), DeckError);
    EXPECT_FALSE(damaged({}).fractures());
}

/// Uniaxial stress by lateral strains: pressed and pulled flow along their own curves; sheared without
/// pressure lies between them.
TEST(CompressionTension, HasOneCurveForEachSign)
{
    const CompressionTension law = concrete({});
    for (const double sign : {1.0, -1.0}) {
        const auto [stress, p] =
            walk_uniaxially([&](SymmetricTensor<double>& end, HistoryView<double> history, double side) {
                law.update(end, SymmetricTensor<double>{sign * 1e-4, side, side, 0, 0, 0}, history, 1.0);
            });
        const double flow = sign > 0 ? 0.2 + 0.1 * p : 0.5 + 0.2 * p;
        EXPECT_NEAR(stress.xx, sign * flow, 1e-9) << sign;
        EXPECT_NEAR(p, 0.02 - flow / sheet_young, 1e-6) << sign;
    }
    const CompressionTension blended = concrete({{"PC", 0.3}, {"PT", 0.1}});
    testing::DrivenPoint point(blended); // pressure 0: a quarter of the way from tension to compression
    point.strain({0, 0, 0, 0.5 * 0.1, 0, 0}, 10);
    const Sheared between = sheared(0.1, 0.2 + 0.25 * 0.3, 0.1 + 0.25 * 0.1);
    EXPECT_NEAR(point.stress.xy, between.stress, 1e-12);
    const double bulk = sheet_young / (3 * (1 - 2 * sheet_poisson)); // at a pressure of 0.2: three quarters
    point.strain({-0.2 / (3 * bulk), -0.2 / (3 * bulk), -0.2 / (3 * bulk), 0, 0, 0});
    EXPECT_NEAR(trace(point.stress) / 3, -0.2, 1e-12);
    point.strain({0, 0, 0, 0.5 * 0.1, 0, 0}, 10);
    const double p = point.history[0];
    EXPECT_NEAR(std::sqrt(3.0) * point.stress.xy, 0.2 + 0.75 * 0.3 + (0.1 + 0.75 * 0.1) * p, 1e-12);
}

TEST(CompressionTension, RateScalesTheFlowStress)
{
    const CompressionTension law = concrete({{"C", 40}, {"P", 5}});
    testing::DrivenPoint point(law);
    const double g = 0.1, duration = 1e-3, rate = g / duration / std::sqrt(3.0);
    point.strain({0, 0, 0, 0.5 * g, 0, 0}, 10, duration);
    const double factor = 1 + std::pow(rate / 40, 0.2);
    const Sheared fast = sheared(g, factor * 0.2, factor * 0.1);
    EXPECT_NEAR(point.stress.xy, fast.stress, 1e-12);
    EXPECT_NEAR(point.history[0], fast.plastic, 1e-12);
}

/// Plane stress: pressed along x in plane strain's place by the same secants.
TEST(CompressionTension, PressedAsAShellPointFollowsItsCurve)
{
    const CompressionTension law = concrete({});
    const auto [stress, p] =
        walk_uniaxially([&](SymmetricTensor<double>& end, HistoryView<double> history, double side) {
            SymmetricTensor<double> increment{-1e-4, side, 0, 0, 0, 0};
            law.update_plane_stress(end, increment, history, 1.0);
        });
    EXPECT_NEAR(stress.xx, -(0.5 + 0.2 * p), 1e-9);
    EXPECT_NEAR(p, 0.02 + stress.xx / sheet_young, 1e-6);
}

} // namespace plash
