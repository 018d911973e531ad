#include "elements/selective_mass.h"
#include "tests/support/deck_run.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <omp.h>

namespace plash::testing {

namespace {

/// How the masses of a run are scaled.
enum class Scaling { none, ordinary, selective };

/// Head of a deck of bricks with E = 1, density 1 and no Poisson effect: one-point steps are sides. Without
/// bulk viscosity, with which steps vary.
std::string head(Scaling scaling, double step, double end, const std::string& more = "")
{
    std::string text =
        fmt::format("*CONTROL_TERMINATION\n{}\n*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,{}\n0.0,0,{}\n", end,
                    scaling == Scaling::none ? 0.0 : -step, scaling == Scaling::selective ? 1 : 0);
    return text +
           "*MAT_ELASTIC\n1,1.0,1.0,0.0\n*CONTROL_HOURGLASS\n6,0.1\n*CONTROL_BULK_VISCOSITY\n1e-20,1e-20\n" +
           more;
}

/// A cantilever of 16 x 2 x 2 bricks along x, its root held.
DeckRun cantilever(Scaling scaling, double step, double end, bool shells)
{
    DeckText deck;
    deck.text += head(scaling, step, end);
    std::string held = "*SET_NODE_LIST\n1\n";
    const int length = 16;
    if (shells) {
        deck.text += "*PART\nbeam\n1,1,1\n*SECTION_SHELL\n1,2,0.833,5\n0.8,0.8,0.8,0.8\n*NODE\n";
        std::string elements = "*ELEMENT_SHELL\n";
        for (int i = 0; i <= length; ++i) {
            for (int j = 0; j <= 2; ++j) {
                const int id = 3 * i + j + 1;
                deck.text += fmt::format("{},{},{},0\n", id, i, j);
                if (i == 0) held += fmt::format("{}\n", id);
                if (i < length && j < 2)
                    elements += fmt::format("{},1,{},{},{},{}\n", 2 * i + j + 1, id, id + 3, id + 4, id + 1);
            }
        }
        deck.text += elements;
    } else {
        deck.text += "*PART\nbeam\n1,1,1\n*SECTION_SOLID\n1,1\n";
        deck.block(1, {0, 0, 0}, {double(length), 2, 2}, length, 2, 2);
        for (int node = 1; node <= deck.nodes; ++node)
            if ((node - 1) % (length + 1) == 0) held += fmt::format("{}\n", node);
    }
    deck.text += held + "*BOUNDARY_SPC_SET\n1,0,1,1,1,1,1,1\n*END\n";
    DeckRun run(deck.text);
    State& state = run.scene->state; // near the first mode, so that little rings
    for (std::size_t node = 0; node < state.size(); ++node) {
        const double share = state.position[node].x / length;
        state.velocity[node] = {0, 0, 1e-4 * share * share};
    }
    return run;
}

struct Swing {
    double half_period = 0, first_step = 0, balance = 0, added = 0;
    long iterations = 0;
};

/// Time of the tip's first way back to where it started.
Swing swing(Scaling scaling, double step, bool shells)
{
    DeckRun run =
        cantilever(scaling, step, (shells ? 1300 : 600) * (scaling == Scaling::ordinary ? 4 : 1), shells);
    const Index tip = static_cast<Index>(run.scene->state.size()) - 1;
    Swing result;
    double before = 0, time_before = 0;
    const SelectiveMass* term = run.find<SelectiveMass>();
    run.watch([&](const Clock& clock, const State& state) {
        const double z = state.position[tip].z - run.scene->model.nodes.position[tip].z;
        if (result.half_period == 0 && before > 0 && z <= 0)
            result.half_period = time_before + (clock.time - time_before) * before / (before - z);
        before = z;
        time_before = clock.time;
        if (term) result.iterations = std::max(result.iterations, term->iterations());
    });
    run.go();
    result.first_step = run.outcome.first_step;
    result.balance = run.scene->ledger.balance_error();
    result.added = run.scene->added_mass_ratio;
    return result;
}

/// A block of flat bricks, 3 x 4 x 5 of them; their step is 0.2 by the thickness.
std::string block_deck(Scaling scaling, double end, const std::string& more)
{
    DeckText deck;
    deck.text += head(scaling, 0.8, end) + "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n";
    deck.block(1, {0, 0, 0}, {3, 2, 1}, 3, 4, 5);
    return deck.text + more + "*END\n";
}

struct Spin {
    double growth = 0, momentum_error = 0, angular_error = 0, first_step = 0;
};

/// The block turns freely about its shortest axis and flies; the largest growth of its diagonal.
Spin spin(Scaling scaling)
{
    DeckRun run(block_deck(scaling, 60, ""));
    State& state = run.scene->state;
    const Vec3 center{1.5, 1, 0.5}, turn{0, 0, 0.02}, flight{0.1, 0.2, 0.3};
    for (std::size_t node = 0; node < state.size(); ++node)
        state.velocity[node] = flight + cross(turn, state.position[node] - center);
    const Momenta before(state);
    const std::size_t last = state.size() - 1;
    const double diagonal = norm(state.position[last] - state.position[0]);
    Spin result;
    run.watch([&](const Clock&, const State& now) {
        result.growth = std::max(result.growth, norm(now.position[last] - now.position[0]) / diagonal - 1);
    });
    run.go();
    const Momenta after(state);
    result.momentum_error = norm(after.linear - before.linear) / norm(before.linear);
    // x(n) x v(n-1/2) = (x(n) - v(n-1/2) step / 2) x v(n-1/2), so it does not matter that they stand apart.
    result.angular_error = norm(after.angular - before.angular) / norm(before.angular);
    result.first_step = run.outcome.first_step;
    return result;
}

} // namespace

class SelectiveMassScaling : public ::testing::TestWithParam<bool> {};

/// All elements are of one size, so ordinary scaling makes everything sixteen times as heavy.
TEST_P(SelectiveMassScaling, FourTimesTheStepLeavesTheLowestFrequency)
{
    const bool shells = GetParam();
    const Swing plain = swing(Scaling::none, 0, shells);
    const double step = 4 * plain.first_step / 0.9;
    const Swing selective = swing(Scaling::selective, step, shells);
    const Swing ordinary = swing(Scaling::ordinary, step, shells);
    EXPECT_NEAR(selective.first_step, 4 * plain.first_step, 1e-9);
    EXPECT_EQ(selective.added, 0);
    EXPECT_NEAR(selective.half_period, plain.half_period, 1e-3 * plain.half_period);
    EXPECT_NEAR(ordinary.half_period, 4 * plain.half_period, 0.01 * plain.half_period);
    EXPECT_LT(selective.balance, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Elements, SelectiveMassScaling, ::testing::Values(false, true),
                         [](const auto& info) { return info.param ? "Shells" : "Solids"; });

/// Uniform gravity: every node falls by t^2 / 2 as if nothing were scaled.
TEST(SelectiveMasses, FreeFallIsExact)
{
    DeckRun run(
        block_deck(Scaling::selective, 40, "*LOAD_BODY_Z\n1,1.0\n*DEFINE_CURVE\n1\n0.0,1.0\n1000.0,1.0\n"));
    run.go();
    EXPECT_NEAR(run.outcome.first_step, 0.72, 1e-9); // 0.9 x 4 x 0.2
    const double way = 0.5 * run.outcome.clock.time * run.outcome.clock.time;
    const State& state = run.scene->state;
    for (std::size_t node = 0; node < state.size(); ++node) {
        const Vec3 moved = state.position[node] - run.scene->model.nodes.position[node];
        ASSERT_NEAR(norm(moved - Vec3{0, 0, -way}), 0, 1e-10 * way);
    }
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-10);
}

/// Momenta are those of the masses, and the centrifugal force is theirs too.
TEST(SelectiveMasses, ABlockThatTurnsGrowsAsWithoutScaling)
{
    const Spin plain = spin(Scaling::none), selective = spin(Scaling::selective);
    EXPECT_NEAR(selective.first_step, 4 * plain.first_step, 1e-9);
    EXPECT_LT(selective.momentum_error, 1e-12);
    EXPECT_LT(selective.angular_error, 1e-6);
    // Three elements along the block: its first vibration is not slow. C a in place of C (a - w x v) gives
    // several times as much.
    EXPECT_NEAR(selective.growth, plain.growth, 0.1 * plain.growth);
}

/// One end is held, the other pulled: what drives it has the force of the added mass as well, else work and
/// energy would not meet.
TEST(SelectiveMasses, DrivenNodesGetTheForceOfTheAddedMass)
{
    std::string held = "*SET_NODE_LIST\n1\n", driven = "*SET_NODE_LIST\n2\n";
    for (int node = 1; node <= 4 * 5 * 6; ++node) {
        if ((node - 1) % 4 == 0) held += fmt::format("{}\n", node);
        if ((node - 1) % 4 == 3) driven += fmt::format("{}\n", node);
    }
    DeckRun run(block_deck(Scaling::selective, 60,
                           held + driven +
                               "*BOUNDARY_SPC_SET\n1,0,1,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,2,1,1e-3\n"
                               "*DEFINE_CURVE\n1\n0.0,0.0\n20.0,1.0\n40.0,0.5\n60.0,1.0\n"));
    run.go();
    EXPECT_GT(run.scene->ledger.internal, 1e-8);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-5);
}

/// Bodies move their nodes themselves: elements there are scaled the ordinary way, and the run says so.
TEST(SelectiveMasses, ElementsAtRigidBodiesGetMass)
{
    std::string body = "*SET_NODE_LIST\n1\n";
    for (int node = 1; node <= 4 * 5 * 6; ++node) {
        if ((node - 1) % 4 == 0) body += fmt::format("{}\n", node);
    }
    DeckRun run(block_deck(Scaling::selective, 20,
                           body + "*CONSTRAINED_NODAL_RIGID_BODY\n7,0,1\n*INITIAL_VELOCITY\n0\n0,0,1e-3\n"));
    const auto* term = run.find<SelectiveMass>();
    ASSERT_NE(term, nullptr);
    EXPECT_EQ(term->items(), 40u); // of 60; 20 touch the body
    // Half of each of these elements' nodes move: 20 x 0.1 x (16 - 1) / 2, of 6 in all.
    EXPECT_NEAR(term->ordinary_mass(), 15, 1e-9);
    EXPECT_NEAR(run.scene->added_mass_ratio, 15.0 / 6, 1e-9);
    EXPECT_EQ(term->notices(run.scene->state).size(), 2u);
    run.go();
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
}

/// The same bits with one thread and two, and after a restart.
TEST(SelectiveMasses, ThreadsAndRestartsLeaveTheSameBits)
{
    DeckText deck;
    deck.text += head(Scaling::selective, 2, 30, "*DATABASE_BINARY_D3DUMP\n5\n") +
                 "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n";
    deck.block(1, {0, 0, 0}, {16, 12, 12}, 16, 12, 12);
    const auto run_once = [&](int threads, const RunOptions& options) {
        const int before = omp_get_max_threads();
        omp_set_num_threads(threads);
        DeckRun run(deck.text + "*INITIAL_VELOCITY_NODE\n1,0.01,0.02,0.03\n*END\n");
        Recorders nothing;
        const Outcome outcome = plash::run(*run.scene, nothing, options);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        omp_set_num_threads(before);
        return std::move(run.scene->state.position);
    };
    const TemporaryFolder folder;
    RunOptions writing, going_on;
    writing.restart.directory = folder.path().string();
    going_on.restart_from = folder / "d3dump01";
    const auto one = run_once(1, {}), two = run_once(2, writing), rest = run_once(2, going_on);
    for (std::size_t node = 0; node < one.size(); ++node) {
        ASSERT_EQ(norm(one[node] - two[node]), 0);
        ASSERT_EQ(norm(one[node] - rest[node]), 0);
    }
}

} // namespace plash::testing
