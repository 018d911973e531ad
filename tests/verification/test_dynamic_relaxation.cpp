#include "output/recorders.h"
#include "tests/support/deck_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace plash {

using testing::DeckRun;

namespace {

/// A bar of 10 trusses along z, 100 long, area 1, E = 200, rho = 8e-6, hung up at its top end; gravity 0.01.
/// Its end hangs by rho g L^2 / (2 E), its own frequency is that of a rod fixed at one end.
std::string hanging_bar(const std::string& more, int gravity_curve, int relaxation_curve)
{
    std::ostringstream deck;
    deck << "*KEYWORD\n*NODE\n";
    for (int i = 0; i <= 10; ++i) deck << i + 1 << ",0,0," << -10 * i << "\n";
    deck << "*ELEMENT_BEAM\n";
    for (int i = 1; i <= 10; ++i) deck << i << ",1," << i << "," << i + 1 << "\n";
    deck << "*PART\nbar\n1,1,1\n*SECTION_BEAM\n1,3\n1.0\n*MAT_ELASTIC\n1,8e-6,200,0.3\n"
            "*BOUNDARY_SPC_NODE\n1,0,1,1,1\n"
            "*CONTROL_TERMINATION\n2\n*CONTROL_TIMESTEP\n0,0.8\n"
            "*LOAD_BODY_Z\n"
         << gravity_curve << ",1.0," << relaxation_curve << "\n"
         << "*DEFINE_CURVE\n10,0\n0,0.01\n100,0.01\n"
            "*DEFINE_CURVE\n11,1\n0,0\n0.2,0.01\n100,0.01\n"
            "*DEFINE_CURVE\n12,2\n0,0.01\n100,0.01\n"
         << more << "*END\n";
    return deck.str();
}

constexpr double hang = 8e-6 * 0.01 * 100 * 100 / (2 * 200); // 2e-6
const std::string explicit_relaxation = "*CONTROL_DYNAMIC_RELAXATION\n100,1e-7,0.97,0,0,0,0,1\n";

/// Place of the end of the bar over a run.
struct EndHistory {
    double first = 0, lowest = 1e9, highest = -1e9;
    bool started = false;

    void operator()(const Clock& clock, const State& state)
    {
        if (clock.relaxing) return;
        const double way = state.position[10].z + 100;
        if (!started) first = way;
        started = true;
        lowest = std::min(lowest, way);
        highest = std::max(highest, way);
    }
};

} // namespace

TEST(DynamicRelaxation, HangingBarStaysWhereItWasFound)
{
    // LCIDDR ramps the weight during relaxation; the transient phase has the full weight from its start.
    DeckRun run(hanging_bar(explicit_relaxation, 10, 11));
    EndHistory end;
    run.watch([&](const Clock& clock, const State& state) { end(clock, state); });
    run.go();
    const RelaxationOutcome& relaxation = run.outcome.relaxation;
    ASSERT_TRUE(relaxation.ran);
    EXPECT_TRUE(relaxation.converged);
    EXPECT_LT(relaxation.ratio, 1e-7);
    EXPECT_LT(relaxation.balance_error, 1e-3);
    // Lumped masses hang as the rod does at its nodes; what is left of the motion: sqrt(1e-7) of its peak.
    EXPECT_NEAR(-end.first, hang, 2e-3 * hang);
    EXPECT_LT(end.highest - end.lowest, 2e-3 * hang);
    EXPECT_EQ(run.scene->ledger.damping, 0); // the book of the run begins after relaxation
    EXPECT_NEAR(run.scene->ledger.internal, 1.0 / 3 * hang * 8e-6 * 100 * 0.01, 0.01 * hang * 8e-6);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
}

TEST(DynamicRelaxation, WithoutItTheBarFallsTwiceAsFar)
{
    DeckRun run(hanging_bar("*CONTROL_DYNAMIC_RELAXATION\n100,1e-7,0.97,0,0,0,0,-999\n", 10, 0));
    EndHistory end;
    run.watch([&](const Clock& clock, const State& state) { end(clock, state); });
    run.go();
    EXPECT_FALSE(run.outcome.relaxation.ran);
    EXPECT_NEAR(-end.lowest, 2 * hang, 0.05 * hang);
}

TEST(DynamicRelaxation, CurvesActInTheirPhases)
{
    // SIDR = 2 acts in both; a curve alone asks for the phase. SIDR = 1: the weight is gone afterwards, and
    // the bar swings about its old length. SIDR = 0 under IDRFLG = 1: nothing acts while relaxing.
    DeckRun both(hanging_bar("", 12, 0));
    EndHistory end;
    both.watch([&](const Clock& clock, const State& state) { end(clock, state); });
    both.go();
    EXPECT_TRUE(both.outcome.relaxation.converged);
    EXPECT_NEAR(-end.first, hang, 0.04 * hang); // DRTOL = 1e-3: sqrt(1e-3) of the peak's way
    EXPECT_LT(end.highest - end.lowest, 0.1 * hang);

    DeckRun only(hanging_bar("*CONTROL_DYNAMIC_RELAXATION\n100,1e-7,0.97\n", 11, 0));
    EndHistory released;
    only.watch([&](const Clock& clock, const State& state) { released(clock, state); });
    only.go();
    EXPECT_NEAR(-released.first, hang, 2e-3 * hang);
    EXPECT_NEAR(released.highest, hang, 0.05 * hang);

    DeckRun nothing(hanging_bar(explicit_relaxation, 10, 0));
    EndHistory unloaded;
    nothing.watch([&](const Clock& clock, const State& state) { unloaded(clock, state); });
    nothing.go();
    EXPECT_TRUE(nothing.outcome.relaxation.converged);
    EXPECT_EQ(unloaded.first, 0);

    DeckRun never(hanging_bar("*CONTROL_DYNAMIC_RELAXATION\n100,1e-7,0.97,0,0,0,0,-999\n", 12, 0));
    never.go();
    EXPECT_FALSE(never.outcome.relaxation.ran);
}

TEST(DynamicRelaxation, EndsAtItsTimeAndTellsWhatItThrowsAway)
{
    DeckRun run(hanging_bar("*CONTROL_DYNAMIC_RELAXATION\n100,1e-7,1.0,0.05,0,0,0,1\n", 12, 0));
    run.go();
    const RelaxationOutcome& relaxation = run.outcome.relaxation;
    EXPECT_FALSE(relaxation.converged);
    EXPECT_NEAR(relaxation.time, 0.05, 0.01);
    EXPECT_GT(relaxation.lost_kinetic, 0); // no damping: what the weight has put in is still motion
    EXPECT_LT(relaxation.balance_error, 1e-3);
}

TEST(DynamicRelaxation, InitialVelocitiesWaitForTheRun)
{
    // A mass in front of a spring that is stretched while relaxing; its velocity of 3 comes after.
    const std::string deck = "*KEYWORD\n*NODE\n1,0,0,0\n2,10,0,0\n"
                             "*ELEMENT_DISCRETE\n1,1,1,2\n*ELEMENT_MASS\n1,2,2.0\n2,1,2.0\n"
                             "*PART\nspring\n1,1,1\n*SECTION_DISCRETE\n1\n*MAT_SPRING_ELASTIC\n1,50\n"
                             "*BOUNDARY_SPC_NODE\n1,0,1,1,1\n*INITIAL_VELOCITY_NODE\n2,3\n"
                             "*LOAD_NODE_POINT\n2,1,5,1\n*DEFINE_CURVE\n5,2\n0,10\n100,10\n"
                             "*CONTROL_DYNAMIC_RELAXATION\n50,1e-9,0.9,0,0,0,0,1\n"
                             "*CONTROL_TIMESTEP\n0,0.1\n*CONTROL_TERMINATION\n0.05\n*END\n";
    DeckRun run(deck);
    double first_speed = 0, first_place = 0;
    bool started = false;
    run.watch([&](const Clock& clock, const State& state) {
        if (!clock.relaxing && !started) {
            first_speed = state.velocity[1].x;
            first_place = state.position[1].x;
        }
        started = started || !clock.relaxing;
    });
    run.go();
    EXPECT_NEAR(first_place, 10.2, 1e-4); // F / k
    EXPECT_NEAR(first_speed, 3, 1e-3);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
}

TEST(DynamicRelaxation, RigidBodiesRestAndThenMoveAsTheyStarted)
{
    // A rigid block on a spring under its weight, which turns once the run begins.
    const std::string deck =
        "*KEYWORD\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
        "9,0.5,0.5,5\n10,0.5,0.5,0.5\n"
        "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n"
        "*MAT_RIGID\n1,2.0,200,0.3\n*CONSTRAINED_EXTRA_NODES_NODE\n1,10\n"
        "*ELEMENT_DISCRETE\n1,2,10,9\n*PART\nspring\n2,2,2\n*SECTION_DISCRETE\n2\n*MAT_SPRING_ELASTIC\n2,40\n"
        "*BOUNDARY_SPC_NODE\n9,0,1,1,1\n*INITIAL_VELOCITY_GENERATION\n1,2,0.5,0,0,0\n0.5,0.5,0.5,0,0,1\n"
        "*LOAD_BODY_Z\n3\n*DEFINE_CURVE\n3,2\n0,10\n100,10\n"
        "*CONTROL_DYNAMIC_RELAXATION\n50,1e-9,0.95,0,0,0,0,1\n"
        "*CONTROL_TIMESTEP\n0,0.1,0,0,0,9\n*DEFINE_CURVE\n9\n0,0.01\n100,0.01\n*CONTROL_TERMINATION\n1.0\n*"
        "END\n";
    DeckRun run(deck);
    double first = 0, last = 0;
    Vec3 first_velocity{};
    bool started = false;
    run.watch([&](const Clock& clock, const State& state) {
        if (clock.relaxing) return;
        last = state.position[9].z;
        if (!started) {
            first = state.position[9].z;
            first_velocity = state.velocity[1];
        }
        started = true;
    });
    run.go();
    EXPECT_NEAR(first, 0.5 - 2.0 * 10 / 40, 1e-4); // m g / k
    EXPECT_NEAR(last, first, 1e-3);
    EXPECT_NEAR(norm(first_velocity), 0.5 * std::sqrt(0.5), 0.01); // spin 0.5 at the corner
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
}

TEST(DynamicRelaxation, WritesItsFiles)
{
    DeckRun run(
        hanging_bar(explicit_relaxation + "*DATABASE_BINARY_D3DRLF\n5\n*DATABASE_BINARY_D3PLOT\n1\n", 12, 0));
    const testing::TemporaryFolder folder;
    Recorders recorders = make_recorders(run.read->model, folder.path().string());
    const Outcome outcome = plash::run(*run.scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    std::ifstream file(folder / "relax");
    std::string line, last;
    int lines = 0;
    while (std::getline(file, line)) {
        last = line;
        ++lines;
    }
    EXPECT_EQ(lines, 5 + outcome.relaxation.cycles / 100);
    std::istringstream columns(last);
    long cycle = 0;
    double time = 0, energy = 0, peak = 0, ratio = 0;
    columns >> cycle >> time >> energy >> peak >> ratio;
    EXPECT_EQ(cycle, outcome.relaxation.cycles);
    EXPECT_NEAR(ratio, outcome.relaxation.ratio, 1e-5 * ratio);
    EXPECT_TRUE(std::filesystem::exists(folder / "d3drlf"));
}

TEST(DynamicRelaxation, WhatIsNotThereIsNamed)
{
    for (const char* card :
         {"100,1e-7,0.97,0,0,0,0,6", "100,1e-7,0.97,0,0,1,0,1", "100,1e-7,1.5,0,0,0,0,1"}) {
        const testing::TemporaryFolder folder;
        std::ofstream(folder / "deck.k")
            << hanging_bar(std::string("*CONTROL_DYNAMIC_RELAXATION\n") + card + "\n", 12, 0);
        EXPECT_FALSE(read_model(folder / "deck.k").ok) << card;
    }
}

} // namespace plash
