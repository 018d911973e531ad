#include "core/run_error.h"
#include "parser/nodal_displacements.h"
#include "tests/support/deck_run.h"
#include "tests/support/each_cycle.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

/// *CONTROL_DYNAMIC_RELAXATION IDRFLG = 2: the run begins with the nodes where a file says.
namespace plash::prescribed_geometries {

namespace {

/// A unit cube of E = 2e11, PR = 0, 8000 a volume.
std::string cube(int flag)
{
    return "*KEYWORD\n*CONTROL_TERMINATION\n1,1\n*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n"
           "*MAT_ELASTIC\n1,8000,2e11,0.0\n*CONTROL_DYNAMIC_RELAXATION\n0,0,0,0,0,0,0," +
           std::to_string(flag) +
           "\n*NODE\n11,0,0,0\n12,1,0,0\n13,1,1,0\n14,0,1,0\n15,0,0,1\n16,1,0,1\n17,1,1,1\n18,0,1,1\n"
           "*ELEMENT_SOLID\n1,1,11,12,13,14,15,16,17,18\n*END\n";
}

std::string message_of(const std::string& file, int flag)
{
    testing::DeckRun run(cube(flag));
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "geometry.txt") << file;
    try {
        read_prescribed_geometry(file.empty() ? "" : folder / "geometry.txt", run.read->model);
    } catch (const RunError& error) {
        return error.what();
    }
    return "";
}

} // namespace

// Four nodes go out by e = 1e-3 along x. The stress is E ln(1 + e), up to e^3 / 12 / 100^2 of the midpoint
// rule; each corner of the face bears a quarter and has an eighth of the mass.
TEST(PrescribedGeometry, StretchedCubeHasItsStress)
{
    testing::DeckRun run(cube(2));
    const testing::TemporaryFolder folder;
    // Apart by blanks, by commas, in touching columns of 8 and 15, with rotations.
    std::ofstream(folder / "geometry.txt") << "$ node, displacements\n12 1e-3 0 0\n13,1e-3,0,0\n"
                                              "      16 1.00000000E-03 0.00000000E+00 0.00000000E+00\n"
                                              "      17  1.0000000E-03-0.00000000E+00-0.00000000E+00"
                                              "  0.0000000E+00  0.0000000E+00  0.0000000E+00\n";
    RunOptions options;
    options.geometry = read_prescribed_geometry(folder / "geometry.txt", run.read->model);
    ASSERT_EQ(options.geometry.size(), 4u);
    double force = 0, place = 0, others = 0;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        if (clock.cycle != 0) return;
        place = state.position[6].x;
        force = state.mass[6] * state.velocity[6].x / clock.velocity_step();
        others = std::max(std::abs(state.velocity[6].y), std::abs(state.velocity[6].z));
    }));
    run.outcome = plash::run(*run.scene, recorders, options);
    EXPECT_EQ(run.outcome.termination, Outcome::Termination::normal) << run.outcome.message;
    EXPECT_TRUE(run.outcome.relaxation.geometry);
    EXPECT_EQ(run.outcome.relaxation.cycles, 100);
    EXPECT_EQ(place, 1.001);
    const double expected = -2e11 * std::log(1.001) / 4;
    EXPECT_NEAR(force, expected, 1e-9 * std::abs(expected));
    EXPECT_LT(others, 1e-12);
}

// Let go, the cube swings near the limit of its step: the energy of central difference is a fifth of that of
// the springs there. What is lost would come from a step that changes as the cube shrinks.
TEST(PrescribedGeometry, AReleasedCubeKeepsItsEnergyNearTheLimitOfItsStep)
{
    std::string deck = cube(2);
    deck.replace(deck.find("1,1\n*PART"), 3, "2e-3,0");
    testing::DeckRun run(deck);
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "geometry.txt") << "12,1e-3,0,0\n13,1e-3,0,0\n16,1e-3,0,0\n17,1e-3,0,0\n";
    RunOptions options;
    options.geometry = read_prescribed_geometry(folder / "geometry.txt", run.read->model);
    Recorders recorders;
    run.outcome = plash::run(*run.scene, recorders, options);
    EXPECT_EQ(run.outcome.termination, Outcome::Termination::normal) << run.outcome.message;
    EXPECT_GT(run.outcome.clock.cycle, 10);
    EXPECT_LT(run.scene->ledger.balance_error(), 0.02);
}

// A node that the file leaves out stays where it is, whatever pulls at it; a body cannot be followed.
TEST(PrescribedGeometry, NodesThatAreNotInTheFileStay)
{
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "geometry.txt") << "12,1e-3,0,0\n13,1e-3,0,0\n16,1e-3,0,0\n17,1e-3,0,0\n";
    const auto outcome_of = [&](const std::string& deck, Vec3& left) {
        testing::DeckRun run(deck);
        RunOptions options;
        options.geometry = read_prescribed_geometry(folder / "geometry.txt", run.read->model);
        Recorders recorders;
        recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
            if (clock.cycle == 0) left = state.position[0];
        }));
        return plash::run(*run.scene, recorders, options);
    };
    Vec3 left{1, 1, 1};
    outcome_of(cube(2), left);
    EXPECT_EQ(norm(left), 0);
    std::string body = cube(2);
    body.insert(body.find("*END"), "*SET_NODE_LIST\n1\n12,13\n*CONSTRAINED_NODAL_RIGID_BODY\n7,0,1\n");
    const Outcome refused = outcome_of(body, left);
    EXPECT_EQ(refused.termination, Outcome::Termination::error);
    EXPECT_NE(refused.message.find("node 12 belongs to a rigid body"), std::string::npos) << refused.message;
}

// The rotations of the file bend a strip of shells to a curvature of 1e-3: moment E t^3 / 12 a width, energy
// E t^3 kappa^2 / 24 an area.
TEST(PrescribedGeometry, RotationsBendShells)
{
    testing::DeckRun run(
        "*KEYWORD\n*CONTROL_TERMINATION\n1,1\n*PART\nstrip\n1,1,1\n*SECTION_SHELL\n1,2,0.833,2\n"
        "0.1,0.1,0.1,0.1\n*MAT_ELASTIC\n1,8000,2e11,0.0\n"
        "*CONTROL_DYNAMIC_RELAXATION\n0,0,0,0,0,0,0,2\n"
        "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n*ELEMENT_SHELL\n1,1,1,2,3,4\n*END\n");
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "geometry.txt") << "1,0,0,0,0,5e-4,0\n4,0,0,0,0,5e-4,0\n"
                                              "2,0,0,0,0,-5e-4,0\n3,0,0,0,0,-5e-4,0\n";
    RunOptions options;
    options.geometry = read_prescribed_geometry(folder / "geometry.txt", run.read->model);
    double energy = 0;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State&) {
        if (clock.cycle == 0) energy = run.scene->ledger.internal;
    }));
    run.outcome = plash::run(*run.scene, recorders, options);
    const double expected = 2e11 * 1e-3 / 24 * 1e-6;
    EXPECT_NEAR(energy, expected, 1e-6 * expected);
}

TEST(PrescribedGeometry, WrongFilesSayWhere)
{
    EXPECT_NE(message_of("12,1,2\n", 2).find(":1: a node, three displacements"), std::string::npos);
    EXPECT_NE(message_of("$\n99,0,0,0\n", 2).find(":2: there is no node 99"), std::string::npos);
    EXPECT_NE(message_of("12,0,0,0\n12,0,0,0\n", 2).find(":2: node 12 stands here once more"),
              std::string::npos);
    EXPECT_NE(message_of("", 2).find("field IDRFLG: 2 needs the file"), std::string::npos);
    EXPECT_NE(message_of("12,0,0,0\n", 1).find("asks for no prescribed geometry"), std::string::npos);
}

} // namespace plash::prescribed_geometries
