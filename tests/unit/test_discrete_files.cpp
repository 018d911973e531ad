#include "output/glstat.h"
#include "output/recorders.h"
#include "tests/support/deck_run.h"
#include "tests/support/lsda_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

namespace plash {

using testing::DeckRun;
using testing::TemporaryFolder;

namespace {

std::string text_in(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The number behind the last line that begins with a name.
double last_value(const std::string& text, const std::string& name)
{
    const auto place = text.rfind("\n " + name);
    EXPECT_NE(place, std::string::npos) << name;
    if (place == std::string::npos) return std::nan("");
    const std::string line = text.substr(place + 1, text.find('\n', place + 1) - place - 1);
    return std::stod(line.substr(30));
}

/// A spring (k = 50) and a discrete beam (k = 20 along x, zero length) pull a mass that a motion drives by
/// 0.2 in 1; a second spring is not to be shown.
std::string pulled_mass()
{
    return "*KEYWORD\n*TITLE\npulled\n*NODE\n1,0,0,0\n2,3,4,0\n3,3,4,0\n"
           "*ELEMENT_DISCRETE\n7,1,1,2\n8,1,1,2,0,1.0,1\n"
           "*ELEMENT_BEAM\n9,2,3,2\n*ELEMENT_MASS\n1,2,2.0\n2,1,2.0\n"
           "*PART\nspring\n1,1,1\n*PART\nbeam\n2,2,2\n"
           "*SECTION_DISCRETE\n1\n*SECTION_BEAM\n2,6\n1.0,0,0\n"
           "*MAT_SPRING_ELASTIC\n1,50\n*MAT_066\n2,1.0,20\n\n\n"
           "*BOUNDARY_SPC_NODE\n1,0,1,1,1\n3,0,1,1,1\n"
           "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,2,4,1.0\n2,2,2,5,1.0\n"
           "*DEFINE_CURVE\n4\n0,0\n2,0.24\n*DEFINE_CURVE\n5\n0,0\n2,0.32\n"
           "*SET_NODE_LIST\n6\n2,1\n*DATABASE_NODAL_FORCE_GROUP\n6\n"
           "*DATABASE_DEFORC\n0.5,3\n*DATABASE_DISBOUT\n0.5,3\n*DATABASE_NODFOR\n0.5,3\n"
           "*CONTROL_TIMESTEP\n0,0.05\n*CONTROL_TERMINATION\n1.0\n*END\n";
}

} // namespace

TEST(DiscreteFiles, ShowForcesWaysAndExternalForces)
{
    DeckRun deck(pulled_mass());
    const TemporaryFolder folder;
    Recorders recorders = make_recorders(deck.read->model, folder.path().string());
    Vec3 way{};
    double time = 0;
    deck.watch([&](const Clock& clock, const State& state) {
        if (clock.time > 1) return;
        way = state.position[1] - Vec3{3, 4, 0};
        time = clock.time;
    });
    ASSERT_EQ(run(*deck.scene, recorders).termination, Outcome::Termination::normal);
    const double stretch = norm(way); // along the spring, which points along (3, 4)
    ASSERT_GT(stretch, 0.19);

    const std::string deforc = text_in(folder / "deforc");
    EXPECT_EQ(deforc.find("number.........         8"), std::string::npos); // PF = 1
    EXPECT_NEAR(last_value(deforc, "time..."), time, 1e-5 * time);
    EXPECT_NEAR(last_value(deforc, "x-force"), 50 * stretch * 0.6, 1e-4);
    EXPECT_NEAR(last_value(deforc, "y-force"), 50 * stretch * 0.8, 1e-4);
    EXPECT_NEAR(last_value(deforc, "resultant force"), 50 * stretch, 1e-4);
    EXPECT_NEAR(last_value(deforc, "change in length"), stretch, 1e-6);

    const std::string disbout = text_in(folder / "disbout");
    EXPECT_NE(disbout.find(" beam/truss # =       9      part ID  =         2      material type=      66\n"),
              std::string::npos);

    // The drive holds two springs of 50 and the beam; the support of node 1 the two springs.
    const std::string nodfor = text_in(folder / "nodfor");
    EXPECT_NE(nodfor.find(" nodal group output number  1\n\n nd#       2  xforce="), std::string::npos);

    const auto arrays = testing::read_lsda(text_in(folder / "binout0000"));
    const auto last = [&](const std::string& file, const std::string& name) {
        const auto values = arrays.at("/" + file + "/d000003/" + name).reals();
        return values.at(0);
    };
    EXPECT_EQ(arrays.at("/deforc/metadata/ids").wholes(), std::vector<long>{7});
    EXPECT_NEAR(last("deforc", "resultant_force"), 50 * stretch, 1e-9);
    EXPECT_NEAR(last("deforc", "displacement"), stretch, 1e-12);
    EXPECT_NEAR(last("disbout", "r_dis_axial"), way.x, 1e-12);
    EXPECT_NEAR(last("disbout", "rslt_axial"), 20 * way.x, 1e-11);
    EXPECT_EQ(last("disbout", "axial_x"), 1);
    EXPECT_EQ(arrays.at("/nodfor/metadata/groups").wholes(), std::vector<long>{2});
    const auto forces = arrays.at("/nodfor/d000003/x_force").reals();
    ASSERT_EQ(forces.size(), 2u);
    EXPECT_NEAR(forces[0], 2 * 50 * stretch * 0.6 + 20 * way.x, 1e-6 * forces[0]); // no acceleration by now
    EXPECT_NEAR(forces[1], -2 * 50 * stretch * 0.6, 1e-9);
    // Work of the drive: what both springs and the beam hold, and m v^2 for the jump to 0.2 in the first step
    // (the book has -m v^2 / 2 of kinetic energy before it, + m v^2 / 2 behind).
    const double held = 0.5 * 100 * stretch * stretch + 0.5 * 20 * way.x * way.x + 2.5 * 0.04;
    EXPECT_NEAR(arrays.at("/nodfor/d000003/energy").reals()[0], held, 1e-3 * held);
    EXPECT_NEAR(last("nodfor", "etotal"), held, 1e-3 * held);
}

TEST(Binout, HoldsBeamsBodiesAndJoints)
{
    // A truss (E A / L = 5) is drawn out at a rate of 1; a rigid block turns on a joint with the ground
    // block.
    DeckRun deck(
        "*KEYWORD\n*NODE\n1,0,0,0\n2,10,0,0\n"
        "11,20,0,0\n12,21,0,0\n13,21,1,0\n14,20,1,0\n15,20,0,1\n16,21,0,1\n17,21,1,1\n18,20,1,1\n"
        "21,20,0,0\n22,19,0,0\n23,19,1,0\n24,20,1,0\n25,20,0,1\n26,19,0,1\n27,19,1,1\n28,20,1,1\n"
        "*ELEMENT_BEAM\n5,1,1,2\n*ELEMENT_SOLID\n1,2,11,12,13,14,15,16,17,18\n"
        "2,3,22,21,24,23,26,25,28,27\n"
        "*PART\ntruss\n1,1,1\n*PART\nblock\n2,2,2\n*PART\nground\n3,2,3\n"
        "*SECTION_BEAM\n1,3\n0.5\n*SECTION_SOLID\n2,1\n*MAT_ELASTIC\n1,1,100,0\n*MAT_RIGID\n2,1,100,0.3\n"
        "*MAT_RIGID\n3,1,100,0.3\n1,7,7\n,\n"
        "*CONSTRAINED_JOINT_REVOLUTE\n21,11,25,15\n"
        "*INITIAL_VELOCITY_GENERATION\n2,2,0.5,0,0,0\n20,0,0,0,0,1\n"
        "*BOUNDARY_SPC_NODE\n1,0,1,1,1\n*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,2,4\n*DEFINE_CURVE\n4\n0,0\n9,"
        "9\n"
        "*DATABASE_HISTORY_BEAM\n5\n*DATABASE_ELOUT\n0.5,2\n*DATABASE_RBDOUT\n0.5,2\n*DATABASE_JNTFORC\n0.5,"
        "2\n"
        "*CONTROL_TIMESTEP\n0,0.1\n*CONTROL_TERMINATION\n1.0\n*END\n");
    const TemporaryFolder folder;
    Recorders recorders = make_recorders(deck.read->model, folder.path().string());
    ASSERT_EQ(run(*deck.scene, recorders).termination, Outcome::Termination::normal);
    const auto arrays = testing::read_lsda(text_in(folder / "binout0000"));
    const auto reals = [&](const std::string& path) { return arrays.at(path).reals(); };
    const double time = reals("/elout/beam/d000003/time").at(0);
    ASSERT_GT(time, 0.5);
    EXPECT_EQ(arrays.at("/elout/beam/d000003/ids").wholes(), std::vector<long>{5});
    // Axial strain is the logarithm of the stretch, over the area as it was.
    const double force = 100 * 0.5 * std::log(1 + time / 10);
    EXPECT_NEAR(reals("/elout/beam/d000003/axial").at(0), force, 1e-3 * force);
    EXPECT_NEAR(reals("/elout/beam/d000003/sigma_11").at(0), 2 * force, 2e-3 * force);
    // The block's center turns at 0.5 about (20, 0): centripetal force m omega^2 r, with r to its center.
    EXPECT_NEAR(reals("/rbdout/d000003/global_rvz").at(0), 0.5, 1e-3);
    EXPECT_NEAR(reals("/rbdout/d000003/global_rdz").at(0), 0.5 * time, 0.02);
    EXPECT_NEAR(reals("/rbdout/d000003/dircos_33").at(0), 1, 1e-9);
    const double pull = 0.25 * std::sqrt(0.5);
    EXPECT_NEAR(reals("/jntforc/joints/d000003/resultant_force").at(0), pull, 0.02 * pull);
}

TEST(Glstat, ShowsTheLossOfAdvectionWhereThereIsOne)
{
    GlobalStatistics state;
    EXPECT_EQ(format_glstat(state).find("advection"), std::string::npos);
    state.advection_loss = 2.5;
    EXPECT_NE(format_glstat(state).find(" advection loss.................   2.50000E+00\n"),
              std::string::npos);
}

} // namespace plash
