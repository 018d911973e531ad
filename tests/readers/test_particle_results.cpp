#include "output/d3plot.h"
#include "output/recorders.h"
#include "output/vtk_series.h"
#include "tests/readers/small_model.h"
#include "tests/readers/vtk_d3plot.h"
#include "tests/readers/vtk_grid.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

/// Particles in the result files, read back with VTK's readers and word by word.
namespace plash {

using testing::small_model;
using testing::SnapshotFixture;
using testing::TemporaryFolder;
using testing::text_of;

namespace {

ElementResults::Particle made_up(Index particle)
{
    ElementResults::Particle p;
    p.smoothing = 1.5 + particle;
    p.pressure = 100 + particle;
    p.density = 10 + particle;
    p.mass = 0.25 + particle;
    p.internal_energy = 7 * particle;
    p.plastic_strain = 0.125 * particle;
    p.stress = {1.0 + particle, 2, 3, 4, 5, 6};
    p.neighbours = 20 + particle;
    p.active = particle != 1;
    return p;
}

/// The small model with two particles of a fourth part; the second one, at the node with the smaller number,
/// has left the run.
SnapshotFixture model_with_particles()
{
    SnapshotFixture fixture = small_model();
    Model& model = fixture.model;
    Part water;
    water.id = 40;
    water.title = "water";
    model.parts.push_back(water);
    for (int i = 0; i < 2; ++i) {
        model.nodes.id.push_back(2002 - i);
        model.nodes.position.push_back({5, 6, 7.0 + i});
        model.particles.node.push_back(12 + i);
        model.particles.part.push_back(3);
        model.particles.mass.push_back(1);
    }
    fixture.start();
    fixture.add_results().fill = [](const State&, ElementResults& r) {
        for (std::size_t i = 0; i < r.particles.size(); ++i) r.particles[i] = made_up(i);
    };
    fixture.clock = {0.125, 0.1, 0.1, 7};
    return fixture;
}

std::vector<float> words_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::vector<float> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), 4 * words.size());
    return words;
}

int whole(float word)
{
    int value;
    std::memcpy(&value, &word, sizeof value);
    return value;
}

} // namespace

TEST(ParticleResults, VtkReadsTheParticlesOfADatabase)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = model_with_particles();
    D3plotRecorder recorder(fixture.model, Schedule(0.1), folder / "d3plot");
    recorder.write(fixture.snapshot());
    const testing::VtkD3plot read = testing::read_with_vtk(folder / "d3plot", 0);
    const testing::VtkPart& water = read.part("water");
    ASSERT_EQ(water.corners.size(), 2u);
    const auto& cells = water.cell_values;
    EXPECT_FLOAT_EQ(cells.at("InfluenceRadius")[1][0], 1.5);
    EXPECT_FLOAT_EQ(cells.at("Pressure")[1][0], 100);
    EXPECT_FLOAT_EQ(cells.at("Density")[0][0], 11);
    EXPECT_FLOAT_EQ(cells.at("Stress")[0][0], 2);
    EXPECT_FLOAT_EQ(cells.at("Stress")[0][5], 6);
    EXPECT_EQ(water.position[water.corners[1][0]].z, 7);
}

/// The order of the words, as a database of LS-DYNA 2025 R2 has them (its own flags are 11 1 1 6 1 1 1 1 12 1
/// 3).
TEST(ParticleResults, TheWordsOfADatabaseAreThoseOfLsDyna)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = model_with_particles();
    D3plotRecorder recorder(fixture.model, Schedule(0.1), folder / "d3plot");
    recorder.write(fixture.snapshot());
    const std::vector<float> head = words_of(folder / "d3plot");
    EXPECT_EQ(whole(head[37]), 2);
    EXPECT_EQ(whole(head[38]), 1);
    const int flags[] = {11, 1, 1, 6, 1, 1, 1, 1, 0, 1, 0};
    for (int i = 0; i < 11; ++i) EXPECT_EQ(whole(head[64 + i]), flags[i]) << i;
    const int nodes = whole(head[16]), solids = whole(head[23]), shells = whole(head[31]);
    const int list = 75 + 3 * nodes + 9 * solids + 5 * shells + whole(head[39]);
    EXPECT_EQ(whole(head[list]), 13); // the node 2001 is the 13th by number
    EXPECT_EQ(whole(head[list + 1]), 4);
    EXPECT_EQ(whole(head[list + 2]), 14);

    const std::vector<float> state = words_of(folder / "d3plot01");
    const int particles =
        1 + whole(head[18]) + 9 * nodes + solids * (whole(head[27]) + 1) + shells * (whole(head[33]) + 1);
    const float expected[] = {-4, 2.5, 101, 2, 2, 3, 4, 5, 6, 0.125, 11, 7, 21, 1.25, 4, 1.5, 100};
    for (int i = 0; i < 17; ++i) EXPECT_FLOAT_EQ(state[particles + i], expected[i]) << i;
    EXPECT_FLOAT_EQ(state[particles + 28], -999999);
}

TEST(ParticleResults, AreVerticesInTheVtkSeries)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = model_with_particles();
    VtkSeries series(fixture.model, Schedule(0.1), folder.path().string());
    series.write(fixture.snapshot());
    const testing::VtkGrid grid = testing::read_vtu(folder / "vtk/result_0000.vtu");
    ASSERT_EQ(grid.cell_types.size(), 8u);
    EXPECT_EQ(grid.cell_types[6], 1);
    EXPECT_EQ(grid.corners[7], std::vector<int>{13});
    const auto& cells = grid.cell_values;
    EXPECT_EQ(cells.at("element_id")[6][0], 2002);
    EXPECT_EQ(cells.at("part_id")[7][0], 40);
    EXPECT_EQ(cells.at("pressure")[0][0], 0);
    EXPECT_EQ(cells.at("pressure")[7][0], 101);
    EXPECT_EQ(cells.at("density")[6][0], 10);
    EXPECT_EQ(cells.at("smoothing_length")[6][0], 1.5);
    EXPECT_EQ(cells.at("internal_energy")[7][0], 7);
    EXPECT_EQ(cells.at("neighbours")[7][0], 21);
    EXPECT_EQ(cells.at("eroded")[7][0], 1);
    EXPECT_EQ(cells.at("stress")[7], (std::vector<double>{2, 2, 3, 4, 5, 6}));
}

TEST(ParticleResults, SphoutShowsTheParticlesThatTheDeckNames)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = model_with_particles();
    fixture.model.controls.output.ascii["sphout"].interval = 0.1;
    auto none_named = make_recorders(fixture.model, folder.path().string());
    EXPECT_TRUE(none_named.empty());
    fixture.model.controls.output.history_particles = {13, 0}; // node 0 is no particle
    auto recorders = make_recorders(fixture.model, folder.path().string());
    ASSERT_EQ(recorders.size(), 1u);
    recorders[0]->write(fixture.snapshot());
    const std::string text = text_of(folder / "sphout");
    EXPECT_NE(text.find("t i m e   s t e p        8   ( at time 1.2500000E-01 )"), std::string::npos) << text;
    EXPECT_NE(text.find("     2001      40  2.0000E+00  2.0000E+00  3.0000E+00"), std::string::npos) << text;
    EXPECT_NE(text.find("  1.0100E+02  1.1000E+01  2.5000E+00  7.0000E+00          21           0\n"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("     2002      40"), std::string::npos);
}

} // namespace plash
