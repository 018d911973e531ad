#include "output/recorders.h"
#include "picture/plots.h"
#include "picture/run_results.h"
#include "picture/strip.h"
#include "picture/virtual_display.h"
#include "tests/paths.h"
#include "tests/readers/png_colours.h"
#include "tests/readers/small_model.h"
#include "tests/support/shared_files.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>

namespace plash {

using testing::small_model;
using testing::SnapshotFixture;
using testing::TemporaryFolder;

namespace {

/// A run of three states with a wall, written as d3plot and for ParaView.
void write_run(const std::string& folder)
{
    SnapshotFixture fixture = small_model();
    fixture.model.controls.output.d3plot.interval = 0.1;
    fixture.model.rigid_walls.resize(1);
    fixture.model.rigid_walls[0].normal = {0, 0, 1};
    fixture.add_results().fill = [](const State&, ElementResults& r) {
        if (r.solid_stress.empty()) return;
        for (Index e = 0; e < 3; ++e) {
            r.solid_stress[e].xx = 100 * (e + 1);
            r.solid_plastic_strain[e] = 0.125 * (e + 1);
            r.shell_stress[3 * e + 2].xy = 10 * (e + 1); // outermost layer
        }
        r.shell_deleted[2] = 1;
    };
    auto recorders = make_recorders(fixture.model, folder, {.vtk = true});
    for (int n = 0; n < 3; ++n) {
        fixture.clock = {0.1 * n, n > 0 ? 0.1 : 0, 0.1, n};
        for (std::size_t i = 0; i < fixture.state.size(); ++i) {
            fixture.state.position[i] = fixture.model.nodes.position[i] + Vec3{0, 0, 0.5 * n};
            fixture.state.velocity[i] = {3, 4, 0};
        }
        for (auto& recorder : recorders) recorder->write(fixture.snapshot());
    }
}

float largest(const std::vector<float>& values)
{
    return *std::max_element(values.begin(), values.end());
}

} // namespace

TEST(Picture, ShowsTheSameFromD3plotAndFromTheParaviewSeries)
{
    TemporaryFolder folder, folder_without_d3plot;
    write_run(folder.path().string());
    write_run(folder_without_d3plot.path().string());
    std::filesystem::remove(folder_without_d3plot / "d3plot");
    RunResults from_d3plot(folder.path().string());
    RunResults from_series(folder_without_d3plot.path().string());
    EXPECT_EQ(from_d3plot.title(), "small model");

    for (RunResults* results : {&from_d3plot, &from_series}) {
        ASSERT_EQ(results->times().size(), 3u);
        EXPECT_NEAR(results->times()[2], 0.2, 1e-7);
        const Surface mises = results->surface(2, Quantity::von_mises);
        EXPECT_NEAR(mises.time, 0.2, 1e-7);
        // Each part is closed in itself: 10 faces of the blocks, 4 of the tetrahedron, 2 shells that are
        // left. The series is one grid, where the tetrahedron shares no face with a block either.
        EXPECT_EQ(mises.polygons.size(), 16u);
        EXPECT_EQ(mises.cell_values.size(), 16u);
        EXPECT_NEAR(largest(mises.cell_values), 300, 1e-4);
        const float shell = std::sqrt(3.0f) * 20;
        EXPECT_TRUE(std::any_of(mises.cell_values.begin(), mises.cell_values.end(),
                                [&](float value) { return std::abs(value - shell) < 1e-4; }));
        EXPECT_EQ(largest(results->surface(1, Quantity::plastic_strain).cell_values), 0.375f);
        EXPECT_NEAR(largest(results->surface(1, Quantity::velocity).point_values), 5, 1e-5);
        EXPECT_NEAR(largest(results->surface(2, Quantity::displacement).point_values), 1, 1e-6);
        ASSERT_EQ(results->walls().size(), 1u);
    }
}

TEST(Picture, DrawsAStripWithoutADisplay)
{
    TemporaryFolder folder;
    write_run(folder.path().string());
    unsetenv("DISPLAY");
    RunResults results(folder.path().string());
    std::vector<Surface> surfaces;
    for (std::size_t state : {0, 1, 2}) surfaces.push_back(results.surface(state, Quantity::von_mises));
    StripStyle style;
    style.title = "a strip";
    style.legend = "von Mises stress";
    style.width = 900;
    const VirtualDisplay display;
    draw_strip(surfaces, results.walls(), style, folder / "strip.png");

    const testing::PngFacts facts = testing::facts_of_png(folder / "strip.png");
    EXPECT_EQ(facts.width, 900);
    EXPECT_GT(facts.height, 200);
    EXPECT_GT(facts.colours, 200);         // colour bar and shading
    EXPECT_GT(facts.coloured_share, 0.05); // the model is in sight
    EXPECT_THROW(draw_strip(surfaces, {}, style, "/nowhere/strip.png"), std::runtime_error);
}

TEST(Picture, DrawsDiagrams)
{
    TemporaryFolder folder;
    Plot plot{"a title",
              "time",
              "force",
              {{"line", {0, 1, 2}, {0, 1, 0}}, {"points", {0, 2}, {0, 1}, {0.8, 0.3, 0.1}, true}}};
    const VirtualDisplay display;
    draw_plots({plot, plot, plot}, 2, 800, folder / "plots.png");
    const testing::PngFacts facts = testing::facts_of_png(folder / "plots.png");
    EXPECT_EQ(facts.width, 800);
    EXPECT_EQ(facts.height, 600); // two rows of 400 x 300
    EXPECT_GT(facts.coloured_share, 0.002);
}

TEST(Picture, SaysWhatIsMissing)
{
    TemporaryFolder folder;
    EXPECT_THROW(RunResults(folder.path().string()), std::runtime_error);
    EXPECT_THROW(quantity_named("stress"), std::runtime_error);
}

TEST(Picture, IsASubcommandOfPlash)
{
    TemporaryFolder folder;
    write_run(folder.path().string());
    const std::string command =
        std::string(PLASH_PROGRAM) + " picture " + folder.path().string() +
        " --field plastic_strain --times 0.1,0.2 --view -y --width 600 > /dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(testing::facts_of_png(folder / "picture.png").width, 600);
    const std::string wrong = std::string(PLASH_PROGRAM) + " picture " + folder.path().string() +
                              " --view sideways > /dev/null 2>&1";
    EXPECT_NE(std::system(wrong.c_str()), 0);
}

} // namespace plash
