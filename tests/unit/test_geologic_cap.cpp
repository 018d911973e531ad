#include "materials/geologic_cap.h"
#include "tests/support/law_driver.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

// GPa; after the sand of Sandler & Rubin (1979). The same numbers stand in tests/reference/geologic_cap.py.
constexpr double cap_bulk = 2.1, cap_shear = 1.7;

GeologicCap cap_model(std::vector<std::pair<const char*, double>> more = {})
{
    std::vector<std::pair<const char*, double>> fields{
        {"RO", 2e-6},      {"BULK", cap_bulk}, {"G", cap_shear},  {"ALPHA", 0.0642}, {"THETA", 0.11},
        {"GAMMA", 0.0576}, {"BETA", 5.4},      {"R", 4.2},        {"D", 6},          {"W", 0.066},
        {"X0", 0.19},      {"FTYPE", 1},       {"TOFF", -0.0055}, {"PLOT", 1}};
    fields.insert(fields.begin(), more.begin(), more.end()); // the first of a name counts
    return GeologicCap::from_record(make_record("MAT_GEOLOGIC_CAP_MODEL", std::move(fields)), Model{});
}

struct Invariants {
    double j1, r;
};
Invariants invariants(const SymmetricTensor<double>& stress)
{
    const auto s = deviator(stress);
    return {-trace(stress), std::sqrt(0.5 * contract(s, s))};
}

} // namespace

/// Compacted hydrostatically: plastic compaction W (1 - exp(-D (J1 - X0))) beside the elastic one, whatever
/// the number of steps; unloading is elastic.
TEST(GeologicCap, CompactsHydrostaticallyAlongItsHardening)
{
    const GeologicCap law = cap_model();
    EXPECT_NEAR(law.first_kappa, 0.0631718964, 1e-10); // of the script
    for (int steps : {1, 7, 100}) {
        testing::DrivenPoint point(law);
        point.strain({-0.05 / 3, -0.05 / 3, -0.05 / 3, 0, 0, 0}, steps);
        const double j1 = -trace(point.stress);
        EXPECT_NEAR(j1 / (3 * cap_bulk) + 0.066 * (1 - std::exp(-6 * (j1 - 0.19))), 0.05, 1e-13) << steps;
        EXPECT_NEAR(law.cap_end(point.history[GeologicCap::kappa]), j1, 1e-12);
        point.strain({0.01 / 3, 0.01 / 3, 0.01 / 3, 0, 0, 0}, 1);
        EXPECT_NEAR(-trace(point.stress), j1 - 3 * cap_bulk * 0.01, 1e-13);
    }
}

/// Against the rate equations integrated in small steps (tests/reference/geologic_cap.py, to 1e-7). The error
/// of the returns falls with the first power of the step: 2,000 steps are good for 2e-4 of the strength.
TEST(GeologicCap, FollowsItsRateEquationsInUniaxialStrain)
{
    const GeologicCap law = cap_model();
    testing::DrivenPoint point(law);
    point.strain({0, 0, -0.06, 0, 0, 0}, 2000);
    const auto [j1, r] = invariants(point.stress);
    EXPECT_NEAR(j1, 0.2152666, 2e-5);
    EXPECT_NEAR(r, 0.0307391, 1e-5);
    EXPECT_NEAR(point.history[GeologicCap::kappa], 0.0990550, 2e-5);
}

TEST(GeologicCap, FollowsItsRateEquationsInShearOnTheCap)
{
    const GeologicCap law = cap_model();
    testing::DrivenPoint point(law);
    point.strain({-0.05 / 3, -0.05 / 3, -0.05 / 3, 0, 0, 0}, 200);
    EXPECT_NEAR(-trace(point.stress), 0.2287474, 1e-7);
    point.strain({0, 0, 0, 0.1, 0, 0}, 4000); // g = 0.2
    const auto [j1, r] = invariants(point.stress);
    EXPECT_NEAR(j1, 0.1124169, 2e-5);
    EXPECT_NEAR(r, 0.0450680, 1e-5);
    EXPECT_NEAR(point.history[GeologicCap::kappa], 0.1120296, 2e-5);
}

/// At little pressure shear reaches the envelope: it dilates, and draws the cap back until they meet.
TEST(GeologicCap, DilatesOnItsEnvelopeAndDrawsTheCapBack)
{
    const GeologicCap soil = cap_model();
    testing::DrivenPoint point(soil);
    point.strain({-0.005 / 3, -0.005 / 3, -0.005 / 3, 0, 0, 0});
    point.strain({0, 0, 0, 0.025, 0, 0}, 2000);
    const auto [j1, r] = invariants(point.stress);
    EXPECT_NEAR(j1, 0.0587647, 1e-4); // the two meet there, and creep on along the envelope
    EXPECT_NEAR(r, soil.envelope(j1), 1e-12);
    EXPECT_NEAR(point.history[GeologicCap::kappa], j1, 1e-4);
    const GeologicCap rock = cap_model({{"FTYPE", 2}});
    testing::DrivenPoint other(rock);
    other.strain({-0.005 / 3, -0.005 / 3, -0.005 / 3, 0, 0, 0});
    other.strain({0, 0, 0, 0.025, 0, 0}, 2000);
    EXPECT_EQ(other.history[GeologicCap::kappa], rock.first_kappa);
}

/// Pulled apart: the tension cut-off holds J1, the corner the shear.
TEST(GeologicCap, TearsAtItsTensionCutOff)
{
    const GeologicCap law = cap_model();
    testing::DrivenPoint point(law);
    point.strain({0.01, 0.01, 0.01, 0, 0, 0}, 5);
    EXPECT_NEAR(-trace(point.stress), -0.0055, 1e-15);
    point.strain({0.01, 0, 0, 0.02, 0, 0}, 5);
    const auto [j1, r] = invariants(point.stress);
    EXPECT_NEAR(j1, -0.0055, 1e-15);
    EXPECT_NEAR(r, law.envelope(-0.0055), 1e-13);
}

TEST(GeologicCap, RefusesWhatItDoesNotHave)
{
    EXPECT_THROW(cap_model({{"C", 1}}), DeckError);
    EXPECT_THROW(cap_model({{"TOFF", 1}}), DeckError);
    EXPECT_THROW(cap_model({{"GAMMA", 1}}), DeckError);
    EXPECT_THROW(cap_model({{"PLOT", 8}}), DeckError);
}

TEST(GeologicCap, LanesEqualTheScalarReference)
{
    testing::expect_lanes_as_points(cap_model(), 3e-3, 1e-13);
}

} // namespace plash
