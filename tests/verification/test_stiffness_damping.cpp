#include "tests/support/deck_run.h"
#include "tests/support/history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace plash {

using testing::DeckRun;

namespace {

constexpr int count = 10;

/// A bar of 10 unit cubes along x, or a strip of 10 unit shells 0.1 thick, with E = 100, nu = 0, rho = 1
/// (wave speed 10); the end at x = 0 is held. `velocity` of each node in the direction of its axis.
std::string bar(bool shells, const std::string& more, double end_time, double (*velocity)(double), char axis)
{
    std::ostringstream deck;
    deck << "*KEYWORD\n*NODE\n";
    const int row = shells ? 2 : 4;
    const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int i = 0; i <= count; ++i)
        for (int k = 0; k < row; ++k)
            deck << row * i + k + 1 << "," << i << "," << corner[k][0] << "," << (shells ? 0 : corner[k][1])
                 << "\n";
    deck << (shells ? "*ELEMENT_SHELL\n" : "*ELEMENT_SOLID\n");
    for (int i = 0; i < count; ++i) {
        const int a = row * i + 1, b = a + row;
        deck << i + 1 << ",1,";
        if (shells)
            deck << a << "," << b << "," << b + 1 << "," << a + 1 << "\n";
        else
            deck << a << "," << b << "," << b + 1 << "," << a + 1 << "," << a + 3 << "," << b + 3 << ","
                 << b + 2 << "," << a + 2 << "\n";
    }
    deck << "*PART\nbar\n1,1,1\n"
         << (shells ? "*SECTION_SHELL\n1,2\n0.1,0.1,0.1,0.1\n" : "*SECTION_SOLID\n1,1\n")
         << "*MAT_ELASTIC\n1,1,100,0\n*SET_NODE_LIST\n1\n1,2,3,4\n*SET_NODE_LIST\n2\n1,2\n*BOUNDARY_SPC_SET\n"
         << (shells ? 2 : 1) << ",0,1,1,1,1,1,1\n*INITIAL_VELOCITY_NODE\n";
    for (int i = 0; i <= count; ++i)
        for (int k = 0; k < row; ++k) {
            const double v = velocity(static_cast<double>(i) / count);
            deck << row * i + k + 1 << (axis == 'x' ? "," : axis == 'y' ? ",0," : ",0,0,") << v << "\n";
        }
    deck << "*CONTROL_TERMINATION\n"
         << end_time << "\n*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n"
         << more << "*END\n";
    return deck.str();
}

double quarter_sine(double x)
{
    return 0.01 * std::sin(0.5 * std::numbers::pi * x);
}

/// First bending mode of a cantilever, nearly: the deflection under an end load.
double bent(double x)
{
    return 0.01 * x * x * (3 - x) / 2;
}

/// Ratio of two extremes of a history that lie a period apart, from its second and fourth turning points.
double decay_in_a_period(const std::vector<double>& values)
{
    std::vector<double> extremes;
    for (std::size_t i = 1; i + 1 < values.size(); ++i) {
        const double before = values[i] - values[i - 1], after = values[i + 1] - values[i];
        if (before * after < 0) extremes.push_back(std::abs(values[i]));
    }
    return extremes.size() < 4 ? 0 : extremes[3] / extremes[1];
}

} // namespace

TEST(StiffnessDamping, RayleighsCoefficientGivesItsRatio)
{
    // First longitudinal mode: omega = pi c / (2 L) = pi / 2; beta = 0.1 gives xi = 0.0785.
    const double omega = 0.5 * std::numbers::pi, xi = 0.5 * 0.1 * omega;
    DeckRun run(bar(false, "*DAMPING_PART_STIFFNESS\n1,-0.1\n", 12, quarter_sine, 'x'));
    std::vector<double> end;
    run.watch([&](const Clock&, const State& state) { end.push_back(state.position[4 * count].x - count); });
    run.go();
    EXPECT_NEAR(decay_in_a_period(end), std::exp(-2 * std::numbers::pi * xi / std::sqrt(1 - xi * xi)), 0.005);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
    EXPECT_GT(run.scene->ledger.damping, 0.5 * run.scene->ledger.initial_total);
}

TEST(StiffnessDamping, ShellsInBending)
{
    // First bending mode: 3.516 / L^2 sqrt(E I / (rho A)) = 3.516 / 100 * 10 * 0.1 / sqrt(12) = 0.01015.
    const double omega = 3.516 / 100 * 10 * 0.1 / std::sqrt(12.0), beta = 0.04 / omega;
    std::ostringstream card;
    card << "*DAMPING_PART_STIFFNESS\n1," << -beta << "\n";
    // The step falls to about h^2 / (2 c^2 beta): a quarter of a period is enough.
    DeckRun undamped(bar(true, "", 0.27 * 2 * std::numbers::pi / omega, bent, 'z'));
    std::vector<double> free;
    undamped.watch([&](const Clock&, const State& state) { free.push_back(state.position[2 * count].z); });
    undamped.go();
    DeckRun run(bar(true, card.str(), 0.27 * 2 * std::numbers::pi / omega, bent, 'z'));
    std::vector<double> end;
    run.watch([&](const Clock&, const State& state) { end.push_back(state.position[2 * count].z); });
    run.go();
    // Largest deflections of the first swing: damped by exp(-xi / sqrt(1 - xi^2) acos(xi)) with xi = 0.02.
    const double xi = 0.02;
    const double first = *std::max_element(free.begin(), free.end());
    EXPECT_NEAR(*std::max_element(end.begin(), end.end()) / first,
                std::exp(-xi / std::sqrt(1 - xi * xi) * std::acos(xi)), 0.008);
    EXPECT_LT(run.scene->ledger.balance_error(), 2e-3);
}

TEST(StiffnessDamping, ShareOfCriticalDampingIsStableAndTakesTheFastestMotion)
{
    // A zigzag of the nodes is damped within a few steps, the slowest mode hardly at all.
    const auto zigzag = [](double x) { return std::lround(x * count) % 2 == 1 ? 0.01 : x > 0 ? -0.01 : 0.0; };
    DeckRun fast(bar(false, "*DAMPING_PART_STIFFNESS\n1,0.25\n", 2, zigzag, 'x'));
    fast.go();
    EXPECT_LT(fast.scene->ledger.kinetic + fast.scene->ledger.internal,
              0.02 * fast.scene->ledger.initial_total);
    EXPECT_LT(fast.scene->ledger.balance_error(), 0.02);
    DeckRun slow(bar(false, "*DAMPING_PART_STIFFNESS\n1,0.25\n", 4, quarter_sine, 'x'));
    slow.go();
    EXPECT_GT(slow.scene->ledger.kinetic + slow.scene->ledger.internal,
              0.8 * slow.scene->ledger.initial_total);
}

TEST(StiffnessDamping, RigidMotionIsNotDamped)
{
    std::string deck = bar(
        false, "*DAMPING_PART_STIFFNESS\n1,-0.1\n", 5, [](double) { return 0.0; }, 'x');
    const auto held = deck.find("*BOUNDARY_SPC_SET");
    deck.erase(held, deck.find("*INITIAL_VELOCITY_NODE") - held);
    deck.replace(deck.find("*INITIAL_VELOCITY_NODE"),
                 deck.find("*CONTROL_TERMINATION") - deck.find("*INITIAL_VELOCITY_NODE"),
                 "*INITIAL_VELOCITY_GENERATION\n1,2,0.2,3,0,0\n5,0.5,0.5,0,0,1\n");
    DeckRun run(deck);
    run.go();
    // Centrifugal stretch swings and is damped; what the spin itself holds stays: the book alone would not
    // tell.
    EXPECT_GT(run.scene->ledger.kinetic, 0.99 * run.scene->ledger.initial_total);
}

// DAMP of *MAT_FABRIC is the share of critical damping of the part that is made of it.
TEST(StiffnessDamping, FabricsDampAsTheirPartsDo)
{
    const auto end = [](const std::string& damp, const std::string& more) {
        std::string deck = bar(true, more, 5, quarter_sine, 'x');
        const std::string elastic = "*MAT_ELASTIC\n1,1,100,0\n", shells = "*SECTION_SHELL\n1,2\n";
        deck.replace(deck.find(elastic), elastic.size(), "*MAT_FABRIC\n1,1,100\n,,,,,,," + damp + "\n");
        deck.replace(deck.find(shells), shells.size(), "*SECTION_SHELL\n1,5\n");
        DeckRun run(deck);
        run.go();
        EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
        EXPECT_EQ(run.scene->ledger.damping > 0, damp != "0" || !more.empty());
        return run.scene->state.position.back().x;
    };
    const double of_part = end("0", "*DAMPING_PART_STIFFNESS\n1,0.2\n");
    EXPECT_EQ(end("0.2", ""), of_part);
    EXPECT_EQ(end("0.4", "*DAMPING_PART_STIFFNESS\n1,0.2\n"), of_part);
    EXPECT_NE(end("0", ""), of_part);
}

} // namespace plash
