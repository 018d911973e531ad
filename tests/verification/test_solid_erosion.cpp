#include "tests/support/adaptive_deck.h"
#include "tests/support/deck_run.h"
#include "tests/support/solid_block.h"

#include "elements/erosion.h"
#include "eos/tabulated.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

using testing::record_of;
using testing::SolidBlock;

namespace {

/// Cycles that a cube stretched along x at a constant rate lives under *MAT_ADD_EROSION; -1: to the end.
int cycles_until_lost(std::initializer_list<std::pair<const char*, double>> criteria, double rate,
                      double formulation = 1)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1}, record_of("MAT_ELASTIC", 5, {{"RO", 1}, {"E", 100}, {"PR", 0}}));
    block.model.sections[0] = record_of("SECTION_SOLID", 1, {{"ELFORM", formulation}});
    Record erosion = record_of("MAT_ADD_EROSION", 0, criteria);
    erosion.fields.push_back({"MID", 5, "", true, false, {}});
    block.model.others.push_back(erosion);
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    clock.last_step = 1;
    for (int cycle = 1; cycle <= 100; ++cycle) {
        clock.time = cycle;
        for (std::size_t n = 0; n < state.size(); ++n) {
            state.velocity[n] = {rate * block.model.nodes.position[n].x, 0, 0};
            state.position[n] += state.velocity[n];
        }
        state.clear_forces();
        for (auto& group : groups) group->add_forces(clock, state);
        if (!state.deleted_solids.empty()) return cycle;
    }
    return -1;
}

} // namespace

TEST(SolidErosion, CriteriaHoldAtTheirLimits)
{
    // Stretch 1 + 0.01 n; logarithmic strain ln(1 + 0.01 n), stress 100 times that (nu = 0; mid-step
    // strains).
    const auto strain_cycle = [](double strain) {
        return static_cast<int>(std::ceil((std::exp(strain) - 1) / 0.01));
    };
    for (double formulation : {1, 2, -1}) {
        EXPECT_EQ(cycles_until_lost({{"MXEPS", 0.205}}, 0.01, formulation), strain_cycle(0.205));
        EXPECT_EQ(cycles_until_lost({{"SIGP1", 20.5}}, 0.01, formulation), strain_cycle(0.205));
        EXPECT_EQ(cycles_until_lost({{"SIGVM", 20.5}}, 0.01, formulation), strain_cycle(0.205));
        EXPECT_EQ(cycles_until_lost({{"VOLEPS", 0.205}}, 0.01, formulation), strain_cycle(0.205));
        // Of a uniaxial strain e: effective 2/3 e, largest shear e / 2.
        EXPECT_EQ(cycles_until_lost({{"EFFEPS", 0.14}}, 0.01, formulation), strain_cycle(0.21));
        EXPECT_EQ(cycles_until_lost({{"EPSSH", 0.1025}}, 0.01, formulation), strain_cycle(0.205));
        EXPECT_EQ(cycles_until_lost({{"MNPRES", -6.9}}, 0.01, formulation), strain_cycle(0.207));
        EXPECT_EQ(cycles_until_lost({{"MXPRES", 1.0}}, 0.01, formulation), -1);
        EXPECT_EQ(cycles_until_lost({{"FAILTM", 7}}, 0.01, formulation), 7);
    }
    EXPECT_EQ(cycles_until_lost({{"MNEPS", -0.0305}}, -0.001), 31); // ln(1 - 0.03) = -0.0305 - 4e-5
}

/// TDEL of the material: a cube that is pressed flat goes when its thickness over the speed of waves falls
/// below it.
TEST(SolidErosion, ElementsBelowTheStepOfTheirMaterialGo)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1},
                     record_of("MAT_PIECEWISE_LINEAR_PLASTICITY", 1,
                               {{"RO", 1}, {"E", 100}, {"PR", 0}, {"SIGY", 1e6}, {"TDEL", 0.08}}));
    block.set_viscosity(1e-30, 1e-30);
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    clock.last_step = 1;
    // With PR = 0 the speed is sqrt(E V / RO0): the thickness 1 - x over 10 sqrt(1 - x) falls below 0.08 at
    // 0.36.
    double lost = 0;
    for (int cycle = 1; cycle <= 100 && lost == 0; ++cycle) {
        for (std::size_t n = 0; n < state.size(); ++n) {
            state.velocity[n] = {-0.01 * block.model.nodes.position[n].x, 0, 0};
            state.position[n] += state.velocity[n];
        }
        state.clear_forces();
        groups[0]->add_forces(clock, state);
        if (!state.deleted_solids.empty()) lost = 0.01 * cycle;
    }
    EXPECT_NEAR(lost, 0.37, 0.011);
}

TEST(SolidErosion, ExclusionNumberCountAndImpulse)
{
    // 99 excludes; two criteria are needed.
    EXPECT_EQ(cycles_until_lost({{"EXCL", 99}, {"MXEPS", 99}, {"SIGP1", 99}, {"NCS", 99}}, 0.01), -1);
    EXPECT_EQ(cycles_until_lost({{"NCS", 2}, {"MXEPS", 0.1}, {"SIGP1", 20.5}}, 0.01), 23);
    // Sum over cycles of (100 ln(1 + 0.01 n) - 10)^2 while positive reaches 100.
    double sum = 0;
    int cycle = 0;
    while (sum < 100) {
        ++cycle;
        const double above = std::max(0.0, 100 * std::log1p(0.01 * cycle) - 10);
        sum += above * above;
    }
    EXPECT_EQ(cycles_until_lost({{"IMPULSE", 100}, {"SIGTH", 10}}, 0.01), cycle);
}

TEST(SolidErosion, ElementsUnderLoadGoWithoutAGapInTheBook)
{
    // In the first cycle, when all energy is motion yet but for what the step before made: 1.9 % of all went
    // with half of the work of the lost forces.
    testing::DeckRun run(testing::pulled_bar("", 1e-9, 0.05));
    run.go();
    EXPECT_EQ(run.scene->state.deletions, 18);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
}

TEST(PrincipalValues, AreThoseOfATensorTurnedFromItsAxes)
{
    // Diagonal 3, -1, 0.5 turned by 30 degrees about z, then by 40 about x.
    const double a = std::acos(-1.0) / 6, b = std::acos(-1.0) * 2 / 9;
    const double c = std::cos(a), s = std::sin(a), d = std::cos(b), e = std::sin(b);
    const Tensor3<double> r{c, -s, 0, d * s, d * c, -e, e * s, e * c, d};
    const auto values = principal_values(rotated(SymmetricTensor<double>{3, -1, 0.5, 0, 0, 0}, r));
    EXPECT_NEAR(values[0], 3, 1e-14);
    EXPECT_NEAR(values[1], 0.5, 1e-14);
    EXPECT_NEAR(values[2], -1, 1e-14);
}

namespace {

/// Water of the Lagrangian bird deck (psi), 10 points of C over ln V, T = 0.
Record bird_water()
{
    const double ev[] = {0.1, 0, -0.0953, -0.1044, -0.1124, -0.1178, -0.1258, -0.131, -0.1484, -0.2327};
    const double c[] = {-5000, 0, 294, 1470, 2940, 4410, 5880, 7350, 14700, 73500};
    Record record = record_of("EOS_TABULATED", 1, {{"GAMA", 1}, {"V0", 1}});
    for (int i = 0; i < 10; ++i) {
        record.fields.push_back({"EV" + std::to_string(i + 1), ev[i], "", true, false, {}});
        record.fields.push_back({"C" + std::to_string(i + 1), c[i], "", true, false, {}});
        record.fields.push_back({"T" + std::to_string(i + 1), 0.5, "", true, false, {}});
    }
    return record;
}

} // namespace

TEST(EosTabulated, RunsThroughItsPointsWithItsSlopes)
{
    const Tabulated eos = Tabulated::from_record(bird_water(), 1.0);
    const auto at = [&](double strain) { return eos.evaluate(std::exp(-strain)); };
    EXPECT_NEAR(at(-0.1044).cold, 1470, 1e-9 * 1470);
    EXPECT_NEAR(at(-0.1484).cold, 14700, 1e-9 * 14700);
    EXPECT_NEAR(at(0.05).cold, -2500, 1e-9 * 2500);
    EXPECT_NEAR(at(-0.1).cold, 294 + (1470 - 294) * (0.1 - 0.0953) / (0.1044 - 0.0953), 1e-9 * 1470);
    // Beyond the last point with its slope; warm part GAMA T.
    EXPECT_NEAR(at(-0.3).cold, 73500 + (73500 - 14700) / (0.2327 - 0.1484) * (0.3 - 0.2327), 1e-9 * 1e5);
    EXPECT_NEAR(at(-0.1).warm, 0.5, 1e-15);
    EXPECT_NEAR(eos.bulk_modulus, 294 / 0.0953, 1e-9 * 3000);
    // Slope by the compression, against a difference.
    const double mu = 1.12, h = 1e-6;
    EXPECT_NEAR(eos.evaluate(mu).cold_slope,
                (eos.evaluate(mu + h).cold - eos.evaluate(mu - h).cold) / (2 * h),
                1e-3 * eos.evaluate(mu).cold_slope);
}

} // namespace plash
