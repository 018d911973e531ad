#include "output/ascii_text.h"
#include "output/elout.h"
#include "output/recorders.h"
#include "tests/support/ascii_reader.h"
#include "tests/support/shared_files.h"
#include "tests/support/snapshot_fixture.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <limits>

namespace plash {

using testing::SnapshotFixture;
using testing::TemporaryFolder;
using testing::text_of;

namespace {

std::string scientific(double value, int width, int digits)
{
    std::string text;
    append_scientific(text, value, width, digits);
    return text;
}

/// Two nodes, one shell part and one solid part.
SnapshotFixture two_parts()
{
    SnapshotFixture fixture;
    Model& model = fixture.model;
    model.title = "a title";
    model.nodes.id = {11, 12};
    model.nodes.position = {{0, 0, 0}, {1, 0, 0}};
    Part shell_part, solid_part;
    shell_part.id = 5;
    shell_part.title = "sheet";
    shell_part.section = 0;
    solid_part.id = 123456;
    solid_part.title = "block";
    model.parts = {shell_part, solid_part};
    Record section;
    section.keyword = "SECTION_SHELL";
    section.fields = {{"ELFORM", 2, "", true, false, {}}, {"NIP", 3, "", true, false, {}}};
    model.sections = {section};
    model.shells.id = {71, 72};
    model.shells.part = {0, 0};
    model.shells.nodes = {{0, 1, 1, 1}, {0, 1, 1, 1}};
    model.solids.id = {91};
    model.solids.part = {1};
    model.solids.nodes = {{0, 1, 1, 1, 1, 1, 1, 1}};
    return fixture;
}

/// Writes one snapshot through the one recorder that the Model asks for, and returns the file.
std::string written(SnapshotFixture& fixture, const std::string& name)
{
    TemporaryFolder folder;
    fixture.model.controls.output.ascii[name].interval = 0.1;
    auto recorders = make_recorders(fixture.model, folder.path().string());
    EXPECT_EQ(recorders.size(), 2u); // the file, and its curves in history.h5
    recorders.at(0)->write(fixture.snapshot());
    return text_of(folder / name);
}

} // namespace

TEST(AsciiOutput, PrintsNumbersAsFortranDoes)
{
    EXPECT_EQ(scientific(-9.92778e-02, 14, 5), "  -9.92778E-02");
    EXPECT_EQ(scientific(0, 12, 5), " 0.00000E+00");
    EXPECT_EQ(scientific(1.5e-101, 12, 5), " 1.50000-101");
    EXPECT_EQ(scientific(-2.5e+120, 12, 5), "-2.50000+120");
    EXPECT_EQ(scientific(std::numeric_limits<double>::quiet_NaN(), 12, 5), "         NAN");
}

TEST(AsciiOutput, MakesOnlyTheFilesThatAreAskedForAndHaveSomethingToShow)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = two_parts();
    auto& requests = fixture.model.controls.output.ascii;
    EXPECT_TRUE(make_recorders(fixture.model, folder.path().string()).empty());
    requests["glstat"].interval = 0; // interval 0: not written
    requests["nodout"].interval = 1; // no history nodes
    EXPECT_TRUE(make_recorders(fixture.model, folder.path().string()).empty());
    requests["glstat"].interval = 1;
    fixture.model.controls.output.history_nodes = {1};
    EXPECT_EQ(make_recorders(fixture.model, folder.path().string()).size(), 3u); // and history.h5
    EXPECT_THROW(make_recorders(fixture.model, folder / "nowhere"), std::runtime_error);
}

TEST(AsciiOutput, GlstatShowsEveryEnergyOfTheLedger)
{
    SnapshotFixture fixture = two_parts();
    fixture.start();
    EnergyLedger& ledger = fixture.ledger;
    ledger.open_cycle(2);
    ledger.kinetic = 1;
    ledger.internal = 2;
    ledger.hourglass = 3;
    ledger.sliding = 4;
    ledger.rigid_wall = 5;
    ledger.damping = 6;
    ledger.eroded_kinetic = 10;
    ledger.eroded_internal = 20;
    ledger.eroded_hourglass = 30;
    ledger.external_work = 40;
    fixture.clock = {0.25, 0.01, 0.02, 17};
    fixture.owner = {0.02, "solid", 91, 123456};
    fixture.add_results().fill = [](const State&, ElementResults& results) {
        results.walls.push_back({1, 0, {}, 5});
    };
    fixture.state.velocity = {{1, 2, 3}, {3, 2, 1}};
    fixture.state.mass = {1, 3};

    const testing::GlstatFile file = testing::read_glstat(written(fixture, "glstat"));
    ASSERT_EQ(file.states.size(), 1u);
    const GlobalStatistics& state = file.states[0];
    EXPECT_EQ(state.cycle, 18); // LS-DYNA counts from 1
    EXPECT_EQ(state.owner.kind, "solid");
    EXPECT_EQ(state.owner.element, 91);
    EXPECT_EQ(state.owner.part, 123456);
    EXPECT_EQ(state.time, 0.25);
    EXPECT_EQ(state.step, 0.02);
    EXPECT_EQ(state.kinetic, 11);
    EXPECT_EQ(state.internal, 22);
    EXPECT_EQ(state.hourglass, 33);
    ASSERT_EQ(state.stonewall.size(), 1u);
    EXPECT_EQ(state.stonewall[0], 5);
    EXPECT_EQ(state.damping, 6);
    EXPECT_EQ(state.sliding, 4);
    EXPECT_EQ(state.external_work, 40);
    EXPECT_EQ(state.eroded_kinetic, 10);
    EXPECT_EQ(state.eroded_internal, 20);
    EXPECT_EQ(state.eroded_hourglass, 30);
    EXPECT_EQ(state.total, 81);
    EXPECT_NEAR(state.energy_ratio, 81.0 / 40, 1e-5); // six printed digits
    EXPECT_NEAR(state.energy_ratio_without_eroded, 21.0 / 40, 1e-5);
    EXPECT_EQ(state.velocity.x, 2.5);
    EXPECT_EQ(state.velocity.y, 2);
    EXPECT_EQ(state.velocity.z, 1.5);
}

TEST(AsciiOutput, GlstatHasAStonewallLineForEachWall)
{
    GlobalStatistics state;
    state.stonewall = {1, 2};
    const std::string text = format_glstat(state);
    EXPECT_NE(text.find("\n stonewall energy...............   1.00000E+00 wall# 1\n"
                        " stonewall energy...............   2.00000E+00 wall# 2\n"),
              std::string::npos);
}

TEST(AsciiOutput, RwforcShowsEveryWall)
{
    SnapshotFixture fixture = two_parts();
    fixture.start();
    fixture.model.rigid_walls.resize(1);
    fixture.model.rigid_walls[0].id = 3;
    fixture.clock.time = 0.5;
    fixture.add_results().fill = [](const State&, ElementResults& results) {
        results.walls.push_back({3, 7, {0, 0, -7}, 0});
    };
    const std::string text = written(fixture, "rwforc");
    EXPECT_NE(text.find("\n    time       wall#   normal-force    x-force        y-force        z-force\n"
                        " 5.00000E-01       3   7.000000E+00   0.000000E+00   0.000000E+00  -7.000000E+00\n"),
              std::string::npos);
}

TEST(AsciiOutput, MatsumShowsEveryPart)
{
    SnapshotFixture fixture = two_parts();
    fixture.start();
    fixture.ledger.add_part(1, 7, 0.5);
    fixture.add_results().fill = [](const State&, ElementResults& results) {
        if (results.part_motion.empty()) return;
        results.part_motion[1] = {2, 9, {4, 6, 8}, false, 0.25, 0.125};
    };
    const testing::MatsumFile file = testing::read_matsum(written(fixture, "matsum"));
    EXPECT_EQ(file.heading.substr(0, 8), " a title");
    EXPECT_EQ(file.legend, legend_entry(5, "sheet", 72) + legend_entry(123456, "block", 72));
    ASSERT_EQ(file.states.size(), 1u);
    ASSERT_EQ(file.states[0].size(), 2u);
    EXPECT_EQ(file.states[0][0].id, 5);
    const PartStatistics& block = file.states[0][1];
    EXPECT_EQ(block.id, 123456);
    EXPECT_EQ(block.internal, 7);
    EXPECT_EQ(block.hourglass, 0.5);
    EXPECT_EQ(block.kinetic, 9);
    EXPECT_EQ(block.eroded_internal, 0.25);
    EXPECT_EQ(block.eroded_kinetic, 0.125);
    EXPECT_EQ(block.momentum.y, 6);
    EXPECT_EQ(block.rigid_body_velocity.z, 4);
}

TEST(AsciiOutput, NodoutShowsTheVelocityOfTheHalfStepBefore)
{
    SnapshotFixture fixture = two_parts();
    fixture.start();
    fixture.model.controls.output.history_nodes = {1};
    State& state = fixture.state;
    state.need_rotation();
    state.position[1] = {1.5, 0, 0};
    state.velocity[1] = {10, 0, 0}; // at n+1/2
    state.force[1] = {8, 0, 0};
    state.mass[1] = 2;
    state.angular_velocity[1] = {0, 0, 5};
    state.moment[1] = {0, 0, 6};
    state.inertia[1] = 3;
    fixture.clock = {1, 0.2, 0.4, 5}; // velocities span 0.3
    const testing::NodoutFile file = testing::read_nodout(written(fixture, "nodout"));
    EXPECT_EQ(file.legend, legend_entry(12, "", 80));
    ASSERT_EQ(file.tables.size(), 2u);
    ASSERT_EQ(file.tables[0].motion.size(), 1u);
    const NodeRow& row = file.tables[0].motion[0];
    EXPECT_EQ(row.id, 12);
    EXPECT_EQ(row.displacement.x, 0.5);
    EXPECT_EQ(row.position.x, 1.5);
    EXPECT_EQ(row.acceleration.x, 4);
    EXPECT_EQ(row.velocity.x, 10 - 4 * 0.3);
    ASSERT_EQ(file.tables[1].rotation.size(), 1u);
    EXPECT_EQ(file.tables[1].rotation[0].angular_acceleration.z, 2);
    EXPECT_EQ(file.tables[1].rotation[0].angular_velocity.z, 5 - 2 * 0.3);
}

TEST(AsciiOutput, NodoutSumsRotations)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = two_parts();
    fixture.start();
    fixture.model.controls.output.history_nodes = {0};
    fixture.model.controls.output.ascii["nodout"].interval = 1;
    fixture.state.need_rotation();
    auto recorders = make_recorders(fixture.model, folder.path().string());
    fixture.state.angular_velocity[0] = {0, 2, 0};
    fixture.clock = {0, 0, 0.25, 0};
    recorders[0]->follow(fixture.clock, fixture.state);
    recorders[0]->follow(fixture.clock, fixture.state);
    recorders[0]->write(fixture.snapshot());
    const testing::NodoutFile file = testing::read_nodout(text_of(folder / "nodout"));
    EXPECT_EQ(file.tables.at(1).rotation.at(0).rotation.y, 1);
}

// Layout of shells and solids as LSTC's program l2a (Livermore Software, 2002 and later) prints them from a
// binout; no file of LS-DYNA's own with shells is at hand.
TEST(AsciiOutput, EloutShowsShellsFromTheBottomAndSolids)
{
    SnapshotFixture fixture = two_parts();
    fixture.start();
    fixture.model.controls.output.history_shells = {1};
    fixture.model.controls.output.history_solids = {0};
    fixture.clock = {0.5, 0.1, 0.1, 4};
    fixture.add_results().fill = [](const State&, ElementResults& results) {
        if (results.shell_stress.empty()) return;
        ASSERT_EQ(results.shell_layers, 3);
        ASSERT_EQ(results.row_of_shell(0), none);
        const Index row = results.row_of_shell(1);
        for (int layer = 0; layer < 3; ++layer) { // middle, innermost, outermost
            results.shell_stress[row * 3 + layer] = {1.0 + layer, 0, 0, 0, 0, -0.5};
        }
        results.shell_plastic_strain[row * 3 + 2] = 0.125;
        results.solid_stress[results.row_of_solid(0)] = {3, 0, 0, 0, 0, 0};
    };
    const std::string text = written(fixture, "elout");
    const std::string expected = R"(


 e l e m e n t   s t r e s s   c a l c u l a t i o n s   f o r   t i m e  s t e p        5   ( at time  5.00000E-01 )

 element  materl
     ipt  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx                       yield
           state                                                                                  effsg      function
      91- 123456
       1 elastic   3.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00    3.0000E+00    0.0000E+00



 e l e m e n t   s t r e s s   c a l c u l a t i o n s   f o r   t i m e  s t e p        5   ( at time  5.00000E-01 )

 element  materl(global)
 ipt-shl  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx       plastic
           state                                                                                 strain 
      72-      5
   1-  2 elastic   2.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00 -5.0000E-01    0.0000E+00
   2-  2 elastic   1.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00 -5.0000E-01    0.0000E+00
   3-  2 plastic   3.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00 -5.0000E-01    1.2500E-01
)";
    const std::size_t tables = text.find("\n\n\n\n\n e l e m e n t");
    ASSERT_NE(tables, std::string::npos);
    EXPECT_EQ(text.substr(tables + 2), expected);
}

} // namespace plash
