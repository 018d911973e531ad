#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/support/deck_run.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <fstream>

namespace plash {

namespace {

/// A bar of ten unit bricks whose last is a tenth as long, or a strip of the same as shells; c = 1 for the
/// bricks.
std::string bar_deck(bool shells, double dt2ms, double dt2msf, double tslimt, bool plastic)
{
    std::string deck =
        fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n2.0\n*CONTROL_TIMESTEP\n0.0,0.9,0,{},{}\n{}\n"
                    "*PART\nbar\n1,1,1\n{}\n",
                    tslimt, dt2ms, dt2msf,
                    plastic ? "*MAT_PLASTIC_KINEMATIC\n1,1.0,1.0,0.0,1.0" : "*MAT_ELASTIC\n1,1.0,1.0,0.0");
    deck += shells ? "*SECTION_SHELL\n1,2,0.833,3\n0.1,0.1,0.1,0.1\n" : "*SECTION_SOLID\n1,1\n";
    std::string nodes = "*NODE\n", elements = shells ? "*ELEMENT_SHELL\n" : "*ELEMENT_SOLID\n";
    for (int i = 0; i <= 10; ++i) {
        const double x = i < 10 ? i : 9.1;
        for (int corner = 0; corner < 4; ++corner) {
            nodes += fmt::format("{},{},{},{}\n", 4 * i + corner + 1, x, corner == 1 || corner == 2 ? 1 : 0,
                                 corner >= 2 ? 1 : 0);
        }
        if (i == 10) break;
        const int a = 4 * i + 1, b = a + 4;
        elements += shells ? fmt::format("{},1,{},{},{},{}\n", i + 1, a, b, b + 1, a + 1)
                           : fmt::format("{},1,{},{},{},{},{},{},{},{}\n", i + 1, a, a + 1, a + 2, a + 3, b,
                                         b + 1, b + 2, b + 3);
    }
    return deck + nodes + elements + "*END\n";
}

struct Scaled {
    double first_step, added_mass_ratio;
};

Scaled run_bar(bool shells, double dt2ms, double dt2msf = 0, double tslimt = 0, bool plastic = false)
{
    const testing::TemporaryFolder folder;
    const std::string path = folder / "bar.k";
    std::ofstream(path) << bar_deck(shells, dt2ms, dt2msf, tslimt, plastic);
    const ReadResult read = read_model(path);
    EXPECT_TRUE(read.ok);
    Scene scene = make_scene(read.model);
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    return {outcome.first_step, scene.added_mass_ratio};
}

} // namespace

class MassScaling : public ::testing::TestWithParam<bool> {};

TEST_P(MassScaling, NegativeDt2msAddsMassOnlyWhereTheStepIsTooShort)
{
    const Scaled plain = run_bar(GetParam(), 0), scaled = run_bar(GetParam(), -0.2);
    EXPECT_EQ(plain.added_mass_ratio, 0);
    EXPECT_LT(plain.first_step, 0.15);
    // TSSFAC x |DT2MS|; the scaled element's step is reached to round-off.
    EXPECT_NEAR(scaled.first_step, 0.18, 1e-9);
    // The step of the short element rises with the square root of its mass, which is 0.1 of 9.1 in all.
    const double growth = 0.18 / plain.first_step;
    EXPECT_NEAR(scaled.added_mass_ratio, 0.1 / 9.1 * (growth * growth - 1), 1e-9);
}

TEST_P(MassScaling, AStepThatIsLongEnoughCostsNoMass)
{
    const Scaled plain = run_bar(GetParam(), 0), scaled = run_bar(GetParam(), -1e-3);
    EXPECT_EQ(scaled.added_mass_ratio, 0);
    EXPECT_EQ(scaled.first_step, plain.first_step);
}

/// DT2MSF counts from the smallest step of the start, before TSSFAC; up to 1 there is nothing to do.
TEST_P(MassScaling, Dt2msfCountsFromTheFirstStep)
{
    const Scaled plain = run_bar(GetParam(), 0), scaled = run_bar(GetParam(), 0, 2);
    EXPECT_NEAR(scaled.first_step, 2 * plain.first_step, 1e-9);
    EXPECT_NEAR(scaled.added_mass_ratio, 0.1 / 9.1 * 3, 1e-9);
    const Scaled less = run_bar(GetParam(), 0, 0.5);
    EXPECT_EQ(less.added_mass_ratio, 0);
    EXPECT_EQ(less.first_step, plain.first_step);
}

INSTANTIATE_TEST_SUITE_P(Elements, MassScaling, ::testing::Values(false, true),
                         [](const auto& info) { return info.param ? "Shells" : "Solids"; });

/// Shells of laws that yield soften until TSSFAC times their step is TSLIMT, by at most 5 % more; those of
/// others, and solids, do not.
TEST(SoftenedShells, TslimtHoldsTheStepWithoutMass)
{
    const Scaled plain = run_bar(true, 0, 0, 0, true), softened = run_bar(true, 0, 0, 0.15, true);
    EXPECT_LT(plain.first_step, 0.1);
    EXPECT_GE(softened.first_step, 0.15 * (1 - 1e-9));
    EXPECT_LE(softened.first_step, 0.15 / std::sqrt(0.95));
    EXPECT_EQ(softened.added_mass_ratio, 0);
    EXPECT_EQ(run_bar(true, 0, 0, 0.05, true).first_step, plain.first_step);
    EXPECT_EQ(run_bar(true, 0, 0, 0.15, false).first_step, run_bar(true, 0).first_step);
    EXPECT_EQ(run_bar(false, 0, 0, 0.15, true).first_step, run_bar(false, 0, 0, 0, true).first_step);
}

/// ERODE = 100: a truss that a heavy mass presses together goes when its step, which is its length, falls
/// below DTMIN; without ERODE the run ends there.
TEST(BeamErosion, BeamsGoWhenTheirStepFallsBelowDtmin)
{
    for (const int erode : {0, 100}) {
        const testing::DeckRun run = [&] {
            testing::DeckRun made(fmt::format(
                "*KEYWORD\n*CONTROL_TERMINATION\n2.0,0,0.6\n*CONTROL_TIMESTEP\n0.0,0.1,0,0.0,0.0,,{}\n"
                "*PART\ntruss\n1,1,1\n*SECTION_BEAM\n1,3\n1.0\n*MAT_ELASTIC\n1,1.0,1.0,0.0\n"
                "*NODE\n1,0,0,0\n2,1,0,0\n3,0,9,0\n4,1,9,0\n*ELEMENT_BEAM\n1,1,1,2\n2,1,3,4\n*ELEMENT_"
                "MASS\n1,2,10.0\n"
                "*SET_NODE_LIST\n1\n1\n*BOUNDARY_SPC_SET\n1,0,1,1,1\n"
                "*INITIAL_VELOCITY_NODE\n2,-0.5\n*END\n",
                erode));
            Recorders nothing;
            made.outcome = plash::run(*made.scene, nothing);
            return made;
        }();
        if (erode == 0) {
            EXPECT_EQ(run.outcome.termination, Outcome::Termination::error);
            EXPECT_NE(run.outcome.message.find("fell below DTMIN"), std::string::npos);
            continue;
        }
        EXPECT_EQ(run.outcome.termination, Outcome::Termination::normal) << run.outcome.message;
        ASSERT_EQ(run.scene->state.deleted_beams.size(), 2u);
        EXPECT_EQ(run.scene->state.deleted_beams[0], 1);
        EXPECT_LT(run.scene->state.position[1].x, 0.59); // it goes on
        EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
    }
}

} // namespace plash
