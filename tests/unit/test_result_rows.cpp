#include "output/recorders.h"
#include "solver/explicit_loop.h"
#include "tests/support/ascii_reader.h"
#include "tests/support/shared_files.h"
#include "tests/support/shell_model.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// A sheet of 5 x 4 shells and a row of 20 hexahedra that fly apart, each corner with its own speed.
Model sheet_and_row()
{
    Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 1e4}, {"PR", 0.0}}),
                              {{"ELFORM", 2}, {"NIP", 3}, {"SHRF", 5.0 / 6}, {"T1", 0.1}});
    add_grid(model, 5, 4, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
    model.sections.push_back(make_record("SECTION_SOLID", {{"ELFORM", 1}}));
    model.sections.back().id = 2;
    Part row = model.parts[0];
    row.id = 2;
    row.section = 1;
    model.parts.push_back(row);
    const Index first = add_node(model, {10, 0, 0});
    add_node(model, {10, 1, 0});
    add_node(model, {10, 1, 1});
    add_node(model, {10, 0, 1});
    for (Index e = 0; e < 20; ++e) {
        for (int corner = 0; corner < 4; ++corner) {
            add_node(model, model.nodes.position[first + corner] + Vec3{1.0 + e, 0, 0});
        }
        const Index a = first + 4 * e, b = a + 4;
        model.solids.id.push_back(100 + e);
        model.solids.part.push_back(1);
        model.solids.nodes.push_back({a, b, b + 1, a + 1, a + 3, b + 3, b + 2, a + 2});
    }
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        InitialVelocity velocity;
        velocity.nodes = {static_cast<Index>(node)};
        velocity.translation = {0.01 * (node % 7), 0.02 * (node % 5), 0.03 * (node % 3)};
        model.initial_velocities.push_back(velocity);
    }
    model.controls.time.end_cycle = 10;
    model.controls.time.end_time = 1e9;
    return model;
}

ElementResults collected(const Scene& scene, std::vector<Index> shell_rows, std::vector<Index> solid_rows,
                         std::size_t shells, std::size_t solids)
{
    ElementResults r;
    r.shell_rows = std::move(shell_rows);
    r.solid_rows = std::move(solid_rows);
    r.shell_layers = 3;
    r.shell_stress.resize(3 * shells);
    r.shell_plastic_strain.resize(3 * shells);
    r.shell_resultants.resize(shells);
    r.shell_thickness.resize(shells);
    r.shell_internal_energy.resize(shells);
    r.shell_deleted.resize(shells);
    r.solid_stress.resize(solids);
    r.solid_plastic_strain.resize(solids);
    r.solid_deleted.resize(solids);
    for (const auto& term : scene.terms) term->collect(scene.state, r);
    return r;
}

} // namespace

TEST(ResultRows, OfChosenElementsAreThoseOfTheWholeMesh)
{
    const Model model = sheet_and_row();
    Scene scene = make_scene(model);
    Recorders none_at_all;
    ASSERT_EQ(run(scene, none_at_all).termination, Outcome::Termination::normal);
    const ElementResults all = collected(scene, {}, {}, 20, 20);
    std::vector<Index> shell_rows(20, none), solid_rows(20, none);
    shell_rows[17] = 0;
    shell_rows[4] = 1;
    solid_rows[11] = 0;
    const ElementResults chosen = collected(scene, shell_rows, solid_rows, 2, 1);

    ASSERT_NE(all.shell_stress[3 * 17 + 2].xx, 0);
    ASSERT_NE(all.solid_stress[11].xx, 0);
    for (int layer = 0; layer < 3; ++layer) {
        EXPECT_EQ(chosen.shell_stress[layer].xx, all.shell_stress[3 * 17 + layer].xx);
        EXPECT_EQ(chosen.shell_stress[3 + layer].xy, all.shell_stress[3 * 4 + layer].xy);
    }
    EXPECT_EQ(chosen.shell_resultants[0], all.shell_resultants[17]);
    EXPECT_EQ(chosen.shell_thickness[1], all.shell_thickness[4]);
    EXPECT_EQ(chosen.shell_internal_energy[1], all.shell_internal_energy[4]);
    EXPECT_EQ(chosen.solid_stress[0].xx, all.solid_stress[11].xx);
    EXPECT_EQ(chosen.solid_stress[0].zx, all.solid_stress[11].zx);
}

TEST(ResultRows, EveryFileOfARealRunIsWritten)
{
    Model model = sheet_and_row();
    OutputControls& output = model.controls.output;
    for (const std::string& name : ascii_file_names()) output.ascii[name].interval = 1e-9; // every cycle
    output.d3plot.interval = 1e-9;
    output.history_nodes = {3};
    output.history_shells = {17};
    output.history_solids = {11};
    testing::TemporaryFolder folder;
    Scene scene = make_scene(model);
    Recorders recorders = make_recorders(model, folder.path().string(), {.vtk = true});
    ASSERT_EQ(run(scene, recorders).termination, Outcome::Termination::normal);

    const testing::GlstatFile glstat = testing::read_glstat(testing::text_of(folder / "glstat"));
    ASSERT_EQ(glstat.states.size(), 11u);
    EXPECT_NEAR(glstat.states.back().energy_ratio, 1, 1e-3);
    const testing::MatsumFile matsum = testing::read_matsum(testing::text_of(folder / "matsum"));
    ASSERT_EQ(matsum.states.size(), 11u);
    EXPECT_GT(matsum.states.back()[1].kinetic, 0);
    const testing::NodoutFile nodout = testing::read_nodout(testing::text_of(folder / "nodout"));
    ASSERT_EQ(nodout.tables.size(), 22u);
    EXPECT_EQ(nodout.tables[0].motion[0].velocity.x, 0.03); // the initial velocity of the fourth node
    EXPECT_TRUE(std::filesystem::exists(folder / "vtk/result_0010.vtu"));
    const std::string elout = testing::text_of(folder / "elout");
    EXPECT_NE(elout.find("\n     111-      2\n"), std::string::npos);
    EXPECT_NE(elout.find("\n      18-      1\n"), std::string::npos);
}

} // namespace plash
