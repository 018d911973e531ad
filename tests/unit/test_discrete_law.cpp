#include "elements/discrete_law.h"
#include "tests/support/beam_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

/// Force after moving to `deflection` in equal steps over `duration`.
double moved(const DiscreteLaw& law, DiscreteLaw::State& state, double deflection, int steps = 10,
             double duration = 1)
{
    const double start = state.deflection, rate = (deflection - start) / duration;
    double force = 0;
    for (int i = 1; i <= steps; ++i) {
        force = law.advance(state, start + (deflection - start) * i / steps, rate, duration / steps);
    }
    return force;
}

DiscreteLaw discrete_law_of(const char* keyword, std::vector<std::pair<const char*, double>> fields,
                            const Model& model = {})
{
    return DiscreteLaw::from_record(make_record(keyword, std::move(fields)), model);
}

} // namespace

TEST(DiscreteLaw, ElastoplasticSpringsFollowTheirBilinearPath)
{
    const DiscreteLaw law = discrete_law_of("MAT_SPRING_ELASTOPLASTIC", {{"K", 10}, {"KT", 2}, {"FY", 5}});
    DiscreteLaw::State state;
    EXPECT_NEAR(moved(law, state, 0.4), 4, 1e-12);
    EXPECT_NEAR(moved(law, state, 1.5), 5 + 2 * 1.0, 1e-12);
    // Isotropic: elastic over twice the force reached, then the tangent again.
    EXPECT_NEAR(moved(law, state, 1.5 - 1.4), -7, 1e-12);
    EXPECT_NEAR(moved(law, state, 0.1 - 0.5), -7 - 2 * 0.5, 1e-12);
}

TEST(DiscreteLaw, MaxwellSpringsRelaxAsTheExponential)
{
    const DiscreteLaw law = discrete_law_of("MAT_SPRING_MAXWELL", {{"K0", 10}, {"KI", 3}, {"BETA", 2}});
    DiscreteLaw::State state;
    moved(law, state, 1, 1, 1e-9); // a jump: all of K0
    EXPECT_NEAR(state.force, 10, 1e-7);
    moved(law, state, 1, 7, 1.5);
    EXPECT_NEAR(state.force, 3 + 7 * std::exp(-2 * 1.5), 1e-7);
    // A constant rate from rest: KI x + (K0 - KI) v (1 - exp(-BETA t)) / BETA.
    DiscreteLaw::State ramp;
    moved(law, ramp, 4, 13, 2);
    EXPECT_NEAR(ramp.force, 3 * 4 + 7 * 2 * (1 - std::exp(-4)) / 2, 1e-12);
}

TEST(DiscreteLaw, CurvesMirrorAndInelasticSpringsUnloadAlongTheirStiffness)
{
    Model model;
    add_curve(model, {0, 1, 2}, {0, 4, 5});
    const DiscreteLaw nonlinear = discrete_law_of("MAT_SPRING_NONLINEAR_ELASTIC", {{"LCD", 1}}, model);
    DiscreteLaw::State state;
    EXPECT_NEAR(moved(nonlinear, state, 1.5), 4.5, 1e-12);
    EXPECT_NEAR(moved(nonlinear, state, -0.5), -2, 1e-12);
    const DiscreteLaw damper = discrete_law_of("MAT_DAMPER_NONLINEAR_VISCOUS", {{"LCDR", 1}}, model);
    DiscreteLaw::State still;
    EXPECT_NEAR(moved(damper, still, -2), -5, 1e-12);

    // Compression only (CTF = 1): the way is minus the deflection.
    const DiscreteLaw inelastic = discrete_law_of("MAT_SPRING_INELASTIC", {{"LCFD", 1}, {"KU", 20}}, model);
    DiscreteLaw::State crushed;
    EXPECT_NEAR(moved(inelastic, crushed, -1.5, 100), -4.5, 1e-12);
    EXPECT_NEAR(moved(inelastic, crushed, -1.4, 10), -2.5, 1e-12);
    EXPECT_NEAR(moved(inelastic, crushed, -1.0, 10), 0, 1e-12);
    EXPECT_NEAR(moved(inelastic, crushed, -1.1, 1), -2, 1e-12);
}

/// S06 with two straight pieces for loading and one for unloading is the bilinear spring: S03 with isotropic
/// hardening (BETA = 1), whatever way it is taken.
TEST(DiscreteLaw, GeneralSpringsWithIsotropicHardeningAreTheBilinearOne)
{
    Model model;
    add_curve(model, {-100.5, -0.5, 0.5, 100.5}, {-205, -5, 5, 205});
    add_curve(model, {-50, 50}, {-500, 500});
    const DiscreteLaw general =
        discrete_law_of("MAT_SPRING_GENERAL_NONLINEAR",
                        {{"LCDL", 1}, {"LCDU", 2}, {"BETA", 1}, {"TYI", 5}, {"CYI", -5}}, model);
    const DiscreteLaw bilinear =
        discrete_law_of("MAT_SPRING_ELASTOPLASTIC", {{"K", 10}, {"KT", 2}, {"FY", 5}});
    DiscreteLaw::State a, b;
    for (const double way : {0.4, -0.3, 1.5, 1.2, 1.9, -0.5, -1.8, -1.1, -2.5, 3.0, 2.9, 3.1, -4.0}) {
        EXPECT_NEAR(moved(general, a, way, 50), moved(bilinear, b, way, 50), 1e-12) << way;
    }
}

/// With kinematic hardening (BETA neither 0 nor 1) the range of yield keeps its width and moves along: after
/// the tension of 7 the spring yields at -3 and goes on with the tangent.
TEST(DiscreteLaw, GeneralSpringsWithKinematicHardeningKeepTheirRange)
{
    Model model;
    add_curve(model, {-100.5, -0.5, 0.5, 100.5}, {-205, -5, 5, 205});
    add_curve(model, {-50, 50}, {-500, 500});
    const DiscreteLaw law =
        discrete_law_of("MAT_SPRING_GENERAL_NONLINEAR",
                        {{"LCDL", 1}, {"LCDU", 2}, {"BETA", 2}, {"TYI", 5}, {"CYI", -5}}, model);
    DiscreteLaw::State state;
    EXPECT_NEAR(moved(law, state, 1.5), 7, 1e-12);
    EXPECT_NEAR(moved(law, state, 0.5), -3, 1e-12);
    // The shifted loading curve has -3 on its first piece, which it leaves at -5.
    EXPECT_NEAR(moved(law, state, 0.3), -5, 1e-12);
    EXPECT_NEAR(moved(law, state, -0.7), -7, 1e-12);
    EXPECT_NEAR(moved(law, state, 0.3), 3, 1e-12);
}

/// BETA = 0: a force that falls beyond its peak; below it the steep unloading curve, on which the spring
/// comes back to where it turned, and compression with the yield force of its own.
TEST(DiscreteLaw, GeneralSpringsMaySoften)
{
    Model model;
    add_curve(model, {-3, -1, 0, 1, 2, 3}, {-4, -2, 0, 4, 6, 1});
    add_curve(model, {-5, 5}, {-100, 100});
    const DiscreteLaw law = discrete_law_of("MAT_SPRING_GENERAL_NONLINEAR",
                                            {{"LCDL", 1}, {"LCDU", 2}, {"TYI", 4}, {"CYI", -2}}, model);
    DiscreteLaw::State state;
    EXPECT_NEAR(moved(law, state, 0.5), 2, 1e-12);
    EXPECT_NEAR(moved(law, state, -0.5), -1, 1e-12); // has not yielded yet
    EXPECT_NEAR(moved(law, state, 2.6), 3, 1e-12);
    EXPECT_NEAR(moved(law, state, 2.5), 1, 1e-12);
    EXPECT_NEAR(moved(law, state, 2.8), 2, 1e-12); // past the turning point along the loading curve
    EXPECT_NEAR(moved(law, state, 2.7), 0, 1e-12);
    EXPECT_NEAR(moved(law, state, 2.6), -2, 1e-12);
    EXPECT_NEAR(moved(law, state, 1.6), -3, 1e-12); // compression from (-1, -2) on
}

} // namespace plash
