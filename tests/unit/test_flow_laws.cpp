#include "materials/crushable_foam.h"
#include "materials/flow_laws.h"
#include "tests/support/beam_model.h"
#include "tests/support/law_driver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace plash {

namespace {

/// Stress of a bar pulled to `strain` over `duration`.
double pulled(const PiecewiseLinearPlasticity& law, double strain, double duration = 1)
{
    constexpr int steps = 50;
    double stress[3] = {};
    std::array<double, PiecewiseLinearPlasticity::history_size> history = law.initial_history();
    for (int i = 0; i < steps; ++i) {
        law.update_beam(stress, strain / steps, 0.0, 0.0, HistoryView<double>{history.data()},
                        duration / steps);
    }
    return stress[0];
}

/// Root of strain = flow(p) / E + p by bisection: the stress that a formula means at a total strain.
double expected(double strain, double young_modulus, const std::function<double(double)>& flow)
{
    double low = 0, high = strain;
    for (int i = 0; i < 200; ++i) {
        const double p = 0.5 * (low + high);
        (flow(p) / young_modulus + p > strain ? high : low) = p;
    }
    return flow(low);
}

PiecewiseLinearPlasticity flow_law_of(const char* keyword, std::vector<std::pair<const char*, double>> fields)
{
    return PiecewiseLinearPlasticity::from_record(make_record(keyword, std::move(fields)), Model{});
}

} // namespace

TEST(FlowLaws, PowerLawStartsWhereItMeetsTheElasticLine)
{
    const double e = 200, k = 0.6, n = 0.2;
    const auto law =
        flow_law_of("MAT_POWER_LAW_PLASTICITY", {{"RO", 1}, {"E", e}, {"PR", 0.3}, {"K", k}, {"N", n}});
    const double start = std::pow(e / k, 1 / (n - 1));
    for (double strain : {0.003, 0.02, 0.3}) {
        const double stress = expected(strain, e, [&](double p) { return k * std::pow(start + p, n); });
        EXPECT_NEAR(pulled(law, strain), stress, 5e-4 * stress) << strain;
    }
}

TEST(FlowLaws, JohnsonCookHardensAndFollowsTheLogarithmOfTheRate)
{
    const double e = 200, a = 0.3, b = 0.5, n = 0.35, c = 0.02, reference = 1e-3;
    const auto law = flow_law_of(
        "MAT_SIMPLIFIED_JOHNSON_COOK",
        {{"RO", 1}, {"E", e}, {"PR", 0.3}, {"A", a}, {"B", b}, {"N", n}, {"C", c}, {"EPSO", reference}});
    for (double duration : {1e6, 1.0, 0.003}) {
        const double strain = 0.1, rate = strain / duration;
        const double factor = 1 + c * std::log(std::max(rate / reference, 1.0));
        const double stress =
            expected(strain, e, [&](double p) { return factor * (a + b * std::pow(p, n)); });
        EXPECT_NEAR(pulled(law, strain, duration), stress, 3e-4 * stress) << duration;
    }
}

TEST(FlowLaws, IsotropicLawHasTheModuliOfItsCard)
{
    const auto law = flow_law_of("MAT_ISOTROPIC_ELASTIC_PLASTIC",
                                 {{"RO", 1}, {"G", 80}, {"BULK", 160}, {"SIGY", 0.4}, {"ETAN", 2}});
    EXPECT_NEAR(law.shear_modulus(), 80, 1e-12);
    EXPECT_NEAR(law.bulk_modulus(), 160, 1e-12);
    const double e = law.young_modulus, strain = 0.05;
    EXPECT_NEAR(pulled(law, strain), (0.4 + 2 * strain) / (1 + 2 / e), 1e-12);
}

TEST(CrushableFoam, CrushesAlongItsCurveAndUnloadsElastically)
{
    Model model;
    add_curve(model, {0, 0.4, 0.8}, {0.5, 0.7, 5});
    const auto foam = CrushableFoam::from_record(
        make_record("MAT_CRUSHABLE_FOAM", {{"RO", 1}, {"E", 50}, {"PR", 0}, {"LCID", 1}, {"TSC", 0.1}}),
        model);
    testing::DrivenPoint point(foam);
    // Logarithmic strain of the compression to V = 0.7; the curve is over 1 - V.
    point.strain({std::log(0.7), 0, 0, 0, 0, 0}, 100);
    EXPECT_NEAR(point.stress.xx, -(0.5 + 0.2 * 0.3 / 0.4), 1e-12);
    EXPECT_NEAR(point.stress.yy, 0, 1e-12);
    // Unloading with E, then the tensile cut-off.
    point.strain({0.005, 0, 0, 0, 0, 0});
    EXPECT_NEAR(point.stress.xx, -0.65 + 0.25, 1e-12);
    point.strain({0.05, 0, 0, 0, 0, 0}, 10);
    EXPECT_NEAR(point.stress.xx, 0.1, 1e-12);
    // A turned direction gives the turned stress.
    testing::DrivenPoint skew(foam);
    const double half = 0.5 * std::log(0.7);
    skew.strain({half, half, 0, half, 0, 0}, 100); // uniaxial along (1, 1, 0)
    EXPECT_NEAR(skew.stress.xx, -0.325, 1e-12);
    EXPECT_NEAR(skew.stress.xy, -0.325, 1e-12);
}

namespace {

/// Foam that crushes at a stress c, whatever its volume, with a Poisson's ratio.
CrushableFoam even_foam(const Model& model)
{
    return CrushableFoam::from_record(
        make_record("MAT_CRUSHABLE_FOAM", {{"RO", 1}, {"E", 50}, {"PR", 0.25}, {"LCID", 1}, {"TSC", 0.1}}),
        model);
}

} // namespace

/// Axes that do not turn: each principal stress follows Hooke's increments between -c and TSC by itself.
/// E = 50 and nu = 0.25 make lambda = G = 20.
TEST(CrushableFoam, UniaxialCycleWithLateralStress)
{
    Model model;
    add_curve(model, {0, 1}, {0.5, 0.5});
    const CrushableFoam foam = even_foam(model);
    testing::DrivenPoint point(foam);
    const auto strain = [&](double axial) { point.strain({axial, 0, 0, 0, 0, 0}, 10); };
    strain(-0.005); // elastic: (lambda + 2 G) e, lambda e
    EXPECT_NEAR(point.stress.xx, -60 * 0.005, 1e-12);
    EXPECT_NEAR(point.stress.yy, -20 * 0.005, 1e-12);
    strain(-0.01); // the axis crushes, the sides go on
    EXPECT_NEAR(point.stress.xx, -0.5, 1e-12);
    EXPECT_NEAR(point.stress.yy, -20 * 0.015, 1e-12);
    strain(-0.02); // all crush
    EXPECT_NEAR(point.stress.yy, -0.5, 1e-12);
    strain(0.006); // unloads with the slopes of loading
    EXPECT_NEAR(point.stress.xx, -0.5 + 60 * 0.006, 1e-12);
    EXPECT_NEAR(point.stress.yy, -0.5 + 20 * 0.006, 1e-12);
    strain(0.01); // the axis tears, the sides do not yet
    EXPECT_NEAR(point.stress.xx, 0.1, 1e-12);
    EXPECT_NEAR(point.stress.yy, -0.5 + 20 * 0.016, 1e-12);
    strain(-0.002);
    EXPECT_NEAR(point.stress.xx, 0.1 - 60 * 0.002, 1e-12);
}

/// Shear is tension and compression at 45 degrees: strains e and -e there, of 2 G = 40 each.
TEST(CrushableFoam, ShearCycle)
{
    Model model;
    add_curve(model, {0, 1}, {0.5, 0.5});
    const CrushableFoam foam = even_foam(model);
    testing::DrivenPoint point(foam);
    const auto expect = [&](double pulled, double pressed) {
        EXPECT_NEAR(point.stress.xy, 0.5 * (pulled - pressed), 1e-12);
        EXPECT_NEAR(point.stress.xx, 0.5 * (pulled + pressed), 1e-12);
        EXPECT_NEAR(point.stress.yy, 0.5 * (pulled + pressed), 1e-12);
        EXPECT_NEAR(point.stress.zz, 0, 1e-12);
    };
    point.strain({0, 0, 0, 0.002, 0, 0}, 10);
    expect(0.08, -0.08);
    point.strain({0, 0, 0, 0.008, 0, 0}, 10);
    expect(0.1, -0.4);
    point.strain({0, 0, 0, 0.01, 0, 0}, 10);
    expect(0.1, -0.5);
    point.strain({0, 0, 0, -0.009, 0, 0}, 10); // back: both axes by 0.36
    expect(0.1 - 0.36, -0.5 + 0.36);
    point.strain({0, 0, 0, -0.02, 0, 0}, 10); // and through: they have changed places
    expect(-0.5, 0.1);
}

/// 3 K = 100; the crushing stress grows with the volume strain 1 - V and stays where it was largest.
TEST(CrushableFoam, VolumetricCycle)
{
    Model model;
    add_curve(model, {0, 0.2}, {0.5, 1.5});
    const CrushableFoam foam = even_foam(model);
    testing::DrivenPoint point(foam);
    const auto strain = [&](double linear) { point.strain({linear, linear, linear, 0, 0, 0}, 20); };
    const auto crushing = [](double linear) { return 0.5 + 5 * (1 - std::exp(3 * linear)); };
    strain(-0.004);
    EXPECT_NEAR(point.stress.xx, -0.4, 1e-12);
    strain(-0.016);
    EXPECT_NEAR(point.stress.xx, -crushing(-0.02), 1e-12);
    strain(0.003);
    EXPECT_NEAR(point.stress.xx, -crushing(-0.02) + 0.3, 1e-12);
    strain(0.03);
    EXPECT_NEAR(point.stress.zz, 0.1, 1e-12);
    strain(-0.005); // from the cut-off, not yet to the largest crushing stress
    EXPECT_NEAR(point.stress.xx, 0.1 - 0.5, 1e-12);
    strain(-0.006);
    EXPECT_NEAR(point.stress.xx, -crushing(-0.02), 1e-12);
    strain(-0.022);
    EXPECT_NEAR(point.stress.yy, -crushing(-0.02), 1e-12); // back at the volume of before
    strain(-0.01);
    EXPECT_NEAR(point.stress.yy, -crushing(-0.03), 1e-12);
}

TEST(PrincipalAxesOfATensor, RebuildIt)
{
    const SymmetricTensor<double> t{3, -1, 0.5, 0.7, -0.2, 1.1};
    const SymmetricTensor<double> back = principal_axes(t).tensor();
    EXPECT_NEAR(back.xx, t.xx, 1e-14);
    EXPECT_NEAR(back.zx, t.zx, 1e-14);
    EXPECT_NEAR(back.yz, t.yz, 1e-14);
}

} // namespace plash
