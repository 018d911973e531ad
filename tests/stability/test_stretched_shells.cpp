// Sheets that keep their thickness while they are drawn out (ISTUPD = 0).

#include "tests/support/deck_run.h"

#include <gtest/gtest.h>

namespace plash {

using testing::DeckRun;

namespace {

/// A sheet of 4 x 4 unit shells whose rim is drawn out to 2.2 times its size in both directions within a time
/// of 2, and held there; its inner nodes start with small velocities. Wave speed 10.
std::string drawn_sheet(const std::string& formulation, const std::string& more)
{
    constexpr int n = 4;
    std::string deck =
        "*KEYWORD\n*CONTROL_TERMINATION\n60,0\n*CONTROL_SHELL\n20,0,-1,0\n*PART\nsheet\n1,1,1\n"
        "*SECTION_SHELL\n1," +
        formulation +
        "\n0.1,0.1,0.1,0.1\n*MAT_ELASTIC\n1,1.0,100.0,0.0\n"
        "*DEFINE_CURVE\n1\n0,0\n2,1.2\n100,1.2\n*NODE\n";
    const auto id = [](int i, int j) { return 1 + i + (n + 1) * j; };
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) deck += fmt::format("{},{},{},0\n", id(i, j), i, j);
    deck += "*ELEMENT_SHELL\n";
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            deck += fmt::format("{},1,{},{},{},{}\n", 1 + i + n * j, id(i, j), id(i + 1, j), id(i + 1, j + 1),
                                id(i, j + 1));
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            if (i > 0 && i < n && j > 0 && j < n) {
                deck += fmt::format(
                    "*BOUNDARY_SPC_NODE\n{},0,0,0,1,1,1,1\n*INITIAL_VELOCITY_NODE\n{},{},{}\n", id(i, j),
                    id(i, j), 1e-3 * (i % 2 == 0 ? 1 : -1), 1e-3 * (j % 2 == 0 ? 1 : -1));
                continue;
            }
            deck += fmt::format("*BOUNDARY_PRESCRIBED_MOTION_NODE\n{0},1,2,1,{1}\n{0},2,2,1,{2}\n"
                                "*BOUNDARY_SPC_NODE\n{0},0,0,0,1,1,1,1\n",
                                id(i, j), i, j);
        }
    }
    return deck + more + "*END\n";
}

} // namespace

// The area is 4.84 times that of the start and the mass the same, so that waves cross an element as fast as
// before although its sides are longer: with the density of the start the step would be 2.2 times too long.
TEST(StretchedShells, VibrateAsBefore)
{
    const std::string damped = "*DAMPING_PART_STIFFNESS\n1,0.5\n";
    for (const auto& [formulation, more] : {std::pair<std::string, std::string>{"2", ""},
                                            {"10", ""},
                                            {"16", ""},
                                            {"5", ""},
                                            {"9", ""},
                                            {"2", damped},
                                            {"5", damped}}) {
        DeckRun run(drawn_sheet(formulation, more));
        ASSERT_TRUE(run.scene);
        double early = 0, late = 0;
        run.watch([&](const Clock& clock, const State& state) {
            double kinetic = 0;
            for (std::size_t node = 0; node < state.velocity.size(); ++node)
                kinetic += 0.5 * state.mass[node] * dot(state.velocity[node], state.velocity[node]);
            if (clock.time > 3 && clock.time < 10) early = std::max(early, kinetic);
            if (clock.time > 50) late = std::max(late, kinetic);
        });
        run.go();
        EXPECT_LT(late, 1.5 * early) << formulation << more;
        EXPECT_LT(run.scene->ledger.balance_error(), 0.01) << formulation << more;
    }
}

} // namespace plash
