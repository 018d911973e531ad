#include "ale/hex/hex_fluid.h"
#include "ale/tracers.h"
#include "tests/support/ale_deck.h"
#include "tests/support/restarted_run.h"

#include <gtest/gtest.h>

#include <numbers>

namespace plash {

namespace {

using testing::EulerianRun;

/// A cube between -1 and 1 of n x n x n cells as part 10; with `bend` its nodes are moved so that faces are
/// no planes.
std::string cube(int n, double bend)
{
    std::string text = "*PART\nmesh\n10,10,1\n*SECTION_SOLID\n10,11\n*NODE\n", elements = "*ELEMENT_SOLID\n";
    const auto number = [&](int i, int j, int k) { return 1 + i + (n + 1) * (j + (n + 1) * k); };
    int element = 0;
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const double x = 2.0 * i / n - 1, y = 2.0 * j / n - 1, z = 2.0 * k / n - 1;
                text += fmt::format("{},{:.17g},{:.17g},{:.17g}\n", number(i, j, k),
                                    x + bend * std::sin(3 * y + 1) * std::cos(2 * z),
                                    y + bend * std::sin(3 * z + 2) * std::cos(2 * x),
                                    z + bend * std::sin(3 * x + 3) * std::cos(2 * y));
                if (i == n || j == n || k == n) continue;
                elements += fmt::format("{},10,{},{},{},{},{},{},{},{}\n", ++element, number(i, j, k),
                                        number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k),
                                        number(i, j, k + 1), number(i + 1, j, k + 1),
                                        number(i + 1, j + 1, k + 1), number(i, j + 1, k + 1));
            }
    return text + elements;
}

/// Curves 101 to 109 for the rows of a velocity gradient, and the mesh that goes by them and by 110 to 112.
std::string by_gradient(const double (&gradient)[3][3], Vec3 flow)
{
    std::string text, cards;
    int curve = 100;
    const double offset[3] = {flow.x, flow.y, flow.z};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            const double value = column == 0 ? offset[row] : gradient[row][column - 1];
            text += fmt::format("*DEFINE_CURVE\n{}\n0,{}\n10,{}\n", ++curve, value, value);
            cards += fmt::format("{}{}", curve, curve == 108 || curve == 112 ? "\n" : ",");
        }
    return text + "*ALE_REFERENCE_SYSTEM_GROUP\n10,1,3,6\n\n*ALE_REFERENCE_SYSTEM_CURVE\n6\n" + cards;
}

Vec3 centre_of_mass(const Fluid& fluid, double& mass)
{
    Vec3 moment{};
    mass = 0;
    for (std::size_t number = 0; number < fluid.cell_count(); ++number) {
        const FluidCell cell = fluid.cell(number);
        Vec3 middle{};
        for (const Vec3& point : cell.points) middle += 0.125 * point;
        const double own = fluid.fields.groups[0].mass[cell.place];
        mass += own;
        moment += own * middle;
    }
    return (1 / mass) * moment;
}

} // namespace

// The geometric conservation law: a liquid that flows evenly everywhere does so to round-off, on a mesh that
// turns, is stretched, sheared and carried along at once, be its faces planes or not.
TEST(AleMovingMesh, UniformFlowStaysUniform)
{
    for (const double bend : {0.0, 0.05}) {
        const double gradient[3][3] = {{1.5, -6, 0.5}, {6, -1, 0.7}, {0.3, 1, 2}};
        EulerianRun run(
            cube(6, bend) + testing::liquid_and_void(1000, 100) +
            "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n5,0,1,3,-2,1\n-9,-9,-9,9,9,9\n" +
            by_gradient(gradient, {5, 1, -2}) +
            "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.15\n*CONTROL_TIMESTEP\n0,0.5\n*END\n");
        const auto& fluid = dynamic_cast<const HexFluid&>(run.term<EulerianFluid>().fluid());
        double before = 0, after = 0, worst = 0;
        for (std::size_t cell = 0; cell < fluid.cell_count(); ++cell) before += fluid.mesh.volume[cell];
        const double end = run.run().clock.time;
        for (std::size_t cell = 0; cell < fluid.cell_count(); ++cell) {
            after += fluid.mesh.volume[cell];
            worst = std::max(
                worst, std::abs(fluid.fields.groups[0].mass[cell] / fluid.mesh.volume[cell] / 1000 - 1));
        }
        EXPECT_LT(worst, 1e-11) << bend;
        for (std::size_t node = 0; node < fluid.node_count(); ++node) {
            EXPECT_NEAR(fluid.fields.velocity[0][node], 3, 1e-9);
            EXPECT_NEAR(fluid.fields.velocity[1][node], -2, 1e-9);
            EXPECT_NEAR(fluid.fields.velocity[2][node], 1, 1e-9);
        }
        // The mesh has become larger by exp(trace t), as well as steps of about 2e-3 tell.
        EXPECT_NEAR(after / before, std::exp(2.5 * end), 1e-4 * after / before) << bend;
    }
}

// A drop at rest in a mesh that turns by one radian with a rigid plate (PRTYPE 5 with BCROT = 0): it stays
// where it is, and all of it is there.
TEST(AleMovingMesh, DropRestsInAMeshThatTurnsWithABody)
{
    int first = 100000;
    EulerianRun run(cube(16, 0) + testing::liquid_and_void(1000, 20) +
                    "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n6,0,1\n0.35,0.1,0,0.3\n"
                    "*PART\nplate\n20,20,20\n*SECTION_SHELL\n20,2\n0.01,0.01,0.01,0.01\n"
                    "*MAT_RIGID\n20,7800,2e11,0.3\n1,7,4\n\n" +
                    testing::shell_patch(20, first, {-1, -1, 3}, {2, 0, 0}, {0, 2, 0}, 1, 1) +
                    "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n20,7,0,2\n*DEFINE_CURVE\n2\n0,10\n1,10\n"
                    "*ALE_REFERENCE_SYSTEM_GROUP\n10,1,5,7\n\n*ALE_REFERENCE_SYSTEM_NODE\n7\n"
                    "100000,100001,100002\n\n"
                    "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.1\n*CONTROL_TIMESTEP\n0,0.5\n*END\n");
    const Fluid& fluid = run.term<EulerianFluid>().fluid();
    double mass = 0, mass_after = 0;
    const Vec3 before = centre_of_mass(fluid, mass);
    const double end = run.run().clock.time;
    const Vec3 after = centre_of_mass(fluid, mass_after);
    EXPECT_NEAR(mass_after, mass, 1e-12 * mass);
    EXPECT_LT(norm(after - before), 0.0125); // a tenth of a cell (found: 0.0057), on a way of 0.36
    for (const double component : fluid.momentum()) EXPECT_NEAR(component, 0, 1e-9 * mass);
    // A corner of the mesh has turned about the axis of the plate.
    const Vec3 corner = fluid.cell(0).points[0];
    EXPECT_NEAR(corner.x, -std::cos(10 * end) + std::sin(10 * end), 2e-3);
    EXPECT_NEAR(corner.y, -std::sin(10 * end) - std::cos(10 * end), 2e-3);
    EXPECT_LT(run.scene().ledger.balance_error(), 1e-9);
}

// PRTYPE 7: two bodies draw apart, and the mesh is stretched as the box around two of their nodes is, about
// its middle; along z, where BCEXP holds it, it is as long as before. The drop inside rests.
TEST(AleMovingMesh, MeshIsStretchedAsTheBoxAroundItsNodes)
{
    int first = 100000;
    const std::string one = testing::shell_patch(20, first, {-1.5, -1, -1}, {0, 2, 0}, {0, 0, 2}, 1, 1);
    const std::string two = testing::shell_patch(21, first, {1.5, -1, -1}, {0, 2, 0}, {0, 0, 2.5}, 1, 1);
    EulerianRun run(cube(10, 0) + testing::liquid_and_void(1000, 20) +
                    "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n6,0,1\n0.3,0.1,0,0.4\n"
                    "*PART\nplate\n20,20,20\n*PART\nplate\n21,20,20\n"
                    "*SECTION_SHELL\n20,2\n0.01,0.01,0.01,0.01\n*MAT_RIGID\n20,7800,2e11,0.3\n1,5,7\n\n" +
                    one + two +
                    "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n20,1,0,2,-1\n21,1,0,2\n"
                    "*DEFINE_CURVE\n2\n0,6\n1,6\n*ALE_REFERENCE_SYSTEM_GROUP\n10,1,7,7,0,3\n\n"
                    "*ALE_REFERENCE_SYSTEM_NODE\n7\n100000,100007\n\n"
                    "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.1\n*CONTROL_TIMESTEP\n0,0.5\n*END\n");
    const Fluid& fluid = run.term<EulerianFluid>().fluid();
    double mass = 0, mass_after = 0;
    const Vec3 before = centre_of_mass(fluid, mass);
    const double end = run.run().clock.time, stretch = (3 + 12 * end) / 3;
    const Vec3 after = centre_of_mass(fluid, mass_after);
    const FluidCell low = fluid.cell(0), high = fluid.cell(fluid.cell_count() - 1);
    double lowest = 0, highest = 0;
    for (const Vec3& point : low.points) lowest = std::min(lowest, point.x);
    for (const Vec3& point : high.points) highest = std::max(highest, point.x);
    EXPECT_NEAR(lowest, -stretch, 1e-3);
    EXPECT_NEAR(highest, stretch, 1e-3);
    EXPECT_NEAR(fluid.cell(0).points[0].z, -1, 1e-12);
    EXPECT_NEAR(mass_after, mass, 1e-12 * mass);
    EXPECT_LT(norm(after - before), 0.01);
    EXPECT_LT(run.scene().ledger.balance_error(), 1e-9);
}

namespace {

/// A drop at rest in a mesh around a rigid plate that turns with a speed of 10 and is the system of the mesh,
/// and two plates that are on both sides of its middle at first and draw apart along x.
std::string enclosing_deck(const std::string& group)
{
    int first = 100000;
    const std::string frame = testing::shell_patch(20, first, {-1, -1, 3}, {2, 0, 0}, {0, 2, 0}, 2, 2);
    const std::string one = testing::shell_patch(21, first, {-0.8, -0.5, -1}, {0, 1, 0}, {0, 0, 2}, 1, 1);
    const std::string two = testing::shell_patch(22, first, {0.8, -0.5, -1}, {0, 1, 0}, {0, 0, 2}, 1, 1);
    return cube(10, 0) + testing::liquid_and_void(1000, 20) +
           "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n6,0,1\n0.3,0.1,0,0.4\n"
           "*PART\nframe\n20,20,20\n*PART\none\n21,20,21\n*PART\ntwo\n22,20,21\n"
           "*SECTION_SHELL\n20,2\n0.01,0.01,0.01,0.01\n*MAT_RIGID\n20,7800,2e11,0.3\n1,7,4\n\n"
           "*MAT_RIGID\n21,7800,2e11,0.3\n1,5,7\n\n*SET_PART_LIST\n3\n21,22\n" +
           frame + one + two +
           "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n20,7,0,2\n21,1,0,2,-0.5\n22,1,0,2,0.5\n"
           "*DEFINE_CURVE\n2\n0,10\n1,10\n*ALE_REFERENCE_SYSTEM_GROUP\n" +
           group +
           "*ALE_REFERENCE_SYSTEM_NODE\n7\n100000,100001,100003\n\n"
           "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.05\n*CONTROL_TIMESTEP\n0,0.5\n*END\n";
}

} // namespace

// PRTYPE 9: the mesh turns with its system of nodes and is stretched, about the node in the middle of the
// plate, along the axes of that system as the two plates reach from there: in the end by (|x| cos a + |y| sin
// a) / 0.8 along the first one and (|x| sin a + |y| cos a) / 0.5 along the second, x = 0.8 + 5 t, y = 0.5, a
// = 10 t. Along z BCEXP holds it. The drop rests.
TEST(AleMovingMesh, MeshEnclosesParts)
{
    EulerianRun run(enclosing_deck("10,1,9,3,7,3,0,100004\n\n"));
    const Fluid& fluid = run.term<EulerianFluid>().fluid();
    double mass = 0, mass_after = 0;
    const Vec3 before = centre_of_mass(fluid, mass);
    const double end = run.run().clock.time, angle = 10 * end, x = 0.8 + 5 * end, y = 0.5;
    const Vec3 after = centre_of_mass(fluid, mass_after);
    const double c = std::cos(angle), s = std::sin(angle), first = (x * c + y * s) / 0.8,
                 second = (x * s + y * c) / 0.5;
    const Vec3 corner = fluid.cell(0).points[0];
    EXPECT_NEAR(corner.x, -first * c + second * s, 2e-3);
    EXPECT_NEAR(corner.y, -first * s - second * c, 2e-3);
    EXPECT_NEAR(corner.z, -1, 1e-12);
    EXPECT_NEAR(mass_after, mass, 1e-12 * mass);
    EXPECT_LT(norm(after - before), 0.02); // a tenth of a cell of the start
    EXPECT_LT(run.scene().ledger.balance_error(), 1e-9);
}

// The manual's words on limits and padding leave open what they do.
TEST(AleMovingMesh, LimitsOfMeshesThatEncloseAreRefused)
{
    for (const std::string second : {"0,0,0,2", "0,0,0,0,0,0,0.1", "0,0,0,0,0,0,0,1"}) {
        const testing::TemporaryFolder folder;
        std::ofstream(folder / "deck.k") << "*KEYWORD\n"
                                         << enclosing_deck("10,1,9,3,7,3,0,100004\n" + second + "\n");
        const ReadResult read = read_model(folder / "deck.k");
        EXPECT_THROW(make_scene(read.model), DeckError) << second;
    }
}

// A run that goes on from a restart file has the bits of the whole run: places of the mesh and of tracers in
// it, what its faces swept last, and the fluid.
TEST(AleMovingMesh, RestartGoesOnWithTheSameBits)
{
    const double gradient[3][3] = {{1.5, -6, 0.5}, {6, -1, 0.7}, {0.3, 1, 2}};
    const std::string deck = cube(6, 0.05) + testing::liquid_and_void(1000, 30) +
                             "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n6,0,1,3,-2,1\n0,0,0,0.7\n" +
                             by_gradient(gradient, {5, 1, -2}) +
                             "*DATABASE_TRACER\n0,0,0.1,0.2,0.3\n*DATABASE_TRHIST\n0.01\n"
                             "*DATABASE_BINARY_D3DUMP\n3\n"
                             "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.05\n*END\n";
    testing::RestartedRun runs(deck);
    runs.expect_same_fluid();
    ElementResults states[2];
    for (int run = 0; run < 2; ++run) {
        states[run].tracers_wanted = true;
        EulerianRun& its = run == 0 ? runs.whole : runs.rest;
        its.term<Tracers>().collect(its.scene().state, states[run]);
    }
    EXPECT_EQ(norm(states[0].tracers[0].place - states[1].tracers[0].place), 0);
    EXPECT_TRUE(states[0].tracers[0].active);
}

// Walls that hold the fluid do not turn with a mesh, and the deck is told so.
TEST(AleMovingMesh, HeldSidesAreRefused)
{
    const double gradient[3][3] = {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "deck.k") << "*KEYWORD\n"
                                     << cube(2, 0) << testing::liquid_and_void(1000, 20)
                                     << by_gradient(gradient, {}) << testing::closed(0.1);
    const ReadResult read = read_model(folder / "deck.k");
    try {
        make_scene(read.model);
        ADD_FAILURE() << "no complaint";
    } catch (const DeckError& error) {
        EXPECT_NE(std::string(error.what()).find("has nodes that are held"), std::string::npos)
            << error.what();
    }
}

} // namespace plash
