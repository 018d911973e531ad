#include "output/recorders.h"
#include "output/vtk_series.h"
#include "tests/readers/small_model.h"
#include "tests/readers/vtk_grid.h"
#include "tests/support/shared_files.h"
#include "tests/support/temporary_folder.h"

#include <cmath>
#include <gtest/gtest.h>

namespace plash {

using testing::read_vtu;
using testing::small_model;
using testing::SnapshotFixture;
using testing::TemporaryFolder;
using testing::text_of;
using testing::VtkGrid;

namespace {

constexpr double single_precision = 1e-6; // single precision

void add_simple_results(SnapshotFixture& fixture)
{
    fixture.add_results().fill = [](const State&, ElementResults& r) {
        if (r.solid_stress.empty()) return;
        for (Index e = 0; e < 3; ++e) {
            r.solid_stress[e] = {10.0 + e, 0, 0, 0, 0, 0};
            r.solid_plastic_strain[e] = 0.25 * e;
            for (int layer = 0; layer < 3; ++layer) {
                r.shell_stress[3 * e + layer] = {1, 2, 3, 0, 0, 4.0 + layer};
                r.shell_plastic_strain[3 * e + layer] = layer == 1 ? 0.5 : 0.125;
            }
            r.shell_thickness[e] = 2;
        }
        r.shell_deleted[2] = 1;
    };
}

} // namespace

TEST(VtkSeries, HoldsTheModelAsVtkWantsIt)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    add_simple_results(fixture);
    VtkSeries series(fixture.model, Schedule(0.1), folder.path().string());
    fixture.state.position[1] = {1, 0.5, 0};
    fixture.state.velocity[1] = {0, 3, 0};
    fixture.clock = {0.125, 0.1, 0.1, 7};
    series.write(fixture.snapshot());

    const VtkGrid grid = read_vtu(folder / "vtk/result_0000.vtu");
    EXPECT_EQ(grid.time, 0.125);
    EXPECT_EQ(grid.cell_types, (std::vector<int>{9, 9, 5, 12, 12, 10}));
    EXPECT_EQ(grid.corners[0], (std::vector<int>{0, 1, 5, 4}));
    EXPECT_EQ(grid.corners[5], (std::vector<int>{0, 1, 2, 4}));
    EXPECT_EQ(grid.points[1], (std::vector<double>{1, 0.5, 0}));
    EXPECT_EQ(grid.point_values.at("node_id")[1][0], 993);
    EXPECT_EQ(grid.point_values.at("displacement")[1], (std::vector<double>{0, 0.5, 0}));
    EXPECT_EQ(grid.point_values.at("velocity")[1], (std::vector<double>{0, 3, 0}));
    const auto& cells = grid.cell_values;
    EXPECT_EQ(cells.at("element_id")[1][0], 8);
    EXPECT_EQ(cells.at("element_id")[3][0], 502);
    EXPECT_EQ(cells.at("part_id")[0][0], 20);
    EXPECT_EQ(cells.at("part_id")[5][0], 10);
    EXPECT_EQ(cells.at("eroded")[2][0], 1);
    EXPECT_EQ(cells.at("eroded")[3][0], 0);
    EXPECT_EQ(cells.at("vtkGhostType")[2][0], 32);
    EXPECT_EQ(cells.at("stress")[0], (std::vector<double>{1, 2, 3, 0, 0, 4}));
    EXPECT_EQ(cells.at("stress_outer")[0], (std::vector<double>{1, 2, 3, 0, 0, 6}));
    EXPECT_EQ(cells.at("stress_outer")[4], (std::vector<double>{11, 0, 0, 0, 0, 0}));
    EXPECT_NEAR(cells.at("von_mises")[0][0], std::sqrt(3 + 3 * 36),
                11 * single_precision); // s = (-1, 0, 1), shear 6
    EXPECT_NEAR(cells.at("von_mises")[4][0], 11, 11 * single_precision);
    EXPECT_EQ(cells.at("plastic_strain")[0][0], 0.5);
    EXPECT_EQ(cells.at("plastic_strain")[5][0], 0.5);
    EXPECT_EQ(cells.at("thickness")[0][0], 2);
}

TEST(VtkSeries, HoldsThickShellsAndTenNodeTetrahedra)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    Model& model = fixture.model;
    const std::size_t before = model.shells.size() + model.solids.size();
    model.thick_shells.id = {77};
    model.thick_shells.part = {model.solids.part[0]};
    model.thick_shells.nodes = {model.solids.nodes[0]};
    // The last solid, a tetrahedron, gets mid-side nodes (any will do here).
    const auto& corner = model.solids.nodes.back();
    model.solids.ten_nodes = {none, none, 0};
    model.tetrahedra.id = {model.solids.id.back()};
    model.tetrahedra.part = {model.solids.part.back()};
    model.tetrahedra.nodes = {{corner[0], corner[1], corner[2], corner[4], 0, 1, 2, 3, 4, 5}};
    fixture.add_results().fill = [](const State&, ElementResults& r) {
        if (r.thick_shell_stress.empty()) return;
        for (int layer = 0; layer < 3; ++layer) {
            r.thick_shell_stress[layer] = {1.0 + layer, 0, 0, 0, 0, 0};
            r.thick_shell_plastic_strain[layer] = 0.125 * layer;
        }
        r.thick_shell_deleted[0] = 1;
    };
    VtkSeries series(model, Schedule(0.1), folder.path().string());
    series.write(fixture.snapshot());

    const VtkGrid grid = read_vtu(folder / "vtk/result_0000.vtu");
    ASSERT_EQ(grid.cell_types.size(), before + 1);
    EXPECT_EQ(grid.cell_types[before - 1], 24);
    EXPECT_EQ(grid.corners[before - 1].size(), 10u);
    EXPECT_EQ(grid.cell_types[before], 12);
    const auto& cells = grid.cell_values;
    EXPECT_EQ(cells.at("element_id")[before][0], 77);
    EXPECT_EQ(cells.at("eroded")[before][0], 1);
    EXPECT_EQ(cells.at("stress")[before][0], 1);
    EXPECT_EQ(cells.at("stress_inner")[before][0], 2);
    EXPECT_EQ(cells.at("stress_outer")[before][0], 3);
    EXPECT_EQ(cells.at("von_mises")[before][0], 3);
    EXPECT_EQ(cells.at("plastic_strain")[before][0], 0.25);
}

TEST(VtkSeries, NamesItsStatesAfterEachOne)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    add_simple_results(fixture);
    std::filesystem::create_directory(folder / "vtk");
    std::ofstream(folder / "vtk/result_0009.vtu") << "of an earlier run";
    std::ofstream(folder / "vtk/notes.txt") << "of somebody";
    fixture.model.controls.output.d3plot.interval = 0.1;
    fixture.model.rigid_walls.resize(1);
    fixture.model.rigid_walls[0].id = 4;
    fixture.model.rigid_walls[0].tail = {0, 0, -1};
    fixture.model.rigid_walls[0].normal = {0, 0, 1};
    auto recorders = make_recorders(fixture.model, folder.path().string(), {.vtk = true});
    ASSERT_EQ(recorders.size(), 2u); // d3plot and the series
    EXPECT_FALSE(std::filesystem::exists(folder / "vtk/result_0009.vtu"));
    EXPECT_TRUE(std::filesystem::exists(folder / "vtk/notes.txt"));

    for (int n = 0; n < 2; ++n) {
        fixture.clock = {0.1 * n, 0.1, 0.1, n};
        for (auto& recorder : recorders) recorder->write(fixture.snapshot());
        const std::string index = text_of(folder / "result.pvd");
        EXPECT_NE(index.find("file=\"vtk/result_0000.vtu\""), std::string::npos);
        EXPECT_EQ(index.find("file=\"vtk/result_0001.vtu\"") != std::string::npos, n == 1);
    }
    fixture.clock = {0.15, 0.1, 0.1, 2};
    for (auto& recorder : recorders) recorder->finish(fixture.snapshot());
    EXPECT_NE(text_of(folder / "result.pvd").find("timestep=\"0.15"), std::string::npos);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
        EXPECT_FALSE(entry.path().string().ends_with(".new")) << entry.path();
    }

    const VtkGrid walls = read_vtu(folder / "walls.vtu");
    ASSERT_EQ(walls.points.size(), 4u);
    for (const auto& point : walls.points) EXPECT_NEAR(point[2], -1, single_precision);
    EXPECT_EQ(walls.cell_values.at("wall_id")[0][0], 4);
}

} // namespace plash
