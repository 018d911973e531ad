#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fstream>

namespace plash {

namespace {

/// A bar of ten unit bricks whose last is a tenth as long, or a strip of the same as shells; c = 1 for the
/// bricks.
std::string bar_deck(bool shells, double dt2ms)
{
    std::string deck =
        fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n2.0\n*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,{}\n"
                    "*PART\nbar\n1,1,1\n*MAT_ELASTIC\n1,1.0,1.0,0.0\n",
                    dt2ms);
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

Scaled run_bar(bool shells, double dt2ms)
{
    const testing::TemporaryFolder folder;
    const std::string path = folder / "bar.k";
    std::ofstream(path) << bar_deck(shells, dt2ms);
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

INSTANTIATE_TEST_SUITE_P(Elements, MassScaling, ::testing::Values(false, true),
                         [](const auto& info) { return info.param ? "Shells" : "Solids"; });

} // namespace plash
