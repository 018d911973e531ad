#include "ale/hydrostatic.h"
#include "tests/support/ale_deck.h"
#include "tests/support/ale_samples.h"

#include <gtest/gtest.h>
#include <numbers>

#include <algorithm>
#include <numeric>
#include <random>

namespace plash {

namespace {

using testing::EulerianRun;

/// The same box of cells as nodes and elements in a shuffled order, some elements turned about.
std::string shuffled_mesh(std::array<double, 3> high, std::array<int, 3> cells)
{
    const auto number = [&](int i, int j, int k) {
        return 1 + i + (cells[0] + 1) * (j + (cells[1] + 1) * k);
    };
    std::vector<std::string> nodes, elements;
    for (int k = 0; k <= cells[2]; ++k)
        for (int j = 0; j <= cells[1]; ++j)
            for (int i = 0; i <= cells[0]; ++i) {
                nodes.push_back(fmt::format("{},{:.17g},{:.17g},{:.17g}\n", number(i, j, k),
                                            high[0] * i / cells[0], high[1] * j / cells[1],
                                            high[2] * k / cells[2]));
                if (i == cells[0] || j == cells[1] || k == cells[2]) continue;
                const int n[8] = {number(i, j, k),
                                  number(i + 1, j, k),
                                  number(i + 1, j + 1, k),
                                  number(i, j + 1, k),
                                  number(i, j, k + 1),
                                  number(i + 1, j, k + 1),
                                  number(i + 1, j + 1, k + 1),
                                  number(i, j + 1, k + 1)};
                std::string line = fmt::format("{},10", elements.size() + 1);
                const int turn = i % 4; // about the vertical axis
                for (int corner = 0; corner < 8; ++corner)
                    line += fmt::format(",{}", n[(corner % 4 + turn) % 4 + corner / 4 * 4]);
                elements.push_back(line + "\n");
            }
    std::mt19937 random(7);
    std::shuffle(nodes.begin(), nodes.end(), random);
    std::shuffle(elements.begin(), elements.end(), random);
    std::string text = "*PART\nmesh\n10,10,1\n*SECTION_SOLID\n10,11\n*NODE\n";
    for (const std::string& line : nodes) text += line;
    text += "*ELEMENT_SOLID\n";
    for (const std::string& line : elements) text += line;
    return text;
}

/// A column of water 0.16 x 0.04 x 0.24 in a tank 0.48 x 0.04 x 0.32.
std::string dam(const std::string& mesh, double end_time)
{
    return mesh + testing::liquid_and_void(1000, 60) + testing::liquid_in_box({0, 0, 0}, {0.16, 0.04, 0.24}) +
           testing::gravity(9.81) + testing::closed(end_time);
}

/// Largest acceleration at the start and largest speed in the end of a column of water 10 m deep on general
/// hexahedra: layers are level; columns lean by `shear` and bulge by `bulge` inside.
struct Unrest {
    double acceleration = 0, speed = 0;
};

Unrest unrest_of_hexahedra(double shear, double bulge, double level = 10.2)
{
    constexpr int across = 4, layers = 24;
    std::string nodes = fmt::format("*NODE\n90000,0,0,{}\n", level), solids = "*ELEMENT_SOLID\n";
    const auto node = [&](int i, int j, int k) { return 1 + i + (across + 1) * (j + (across + 1) * k); };
    for (int k = 0; k <= layers; ++k) {
        for (int j = 0; j <= across; ++j) {
            for (int i = 0; i <= across; ++i) {
                const double x = double(i) / across, y = double(j) / across;
                const double wave = std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * y) *
                                    std::sin(std::numbers::pi * k / layers);
                nodes += fmt::format("{},{:.17g},{:.17g},{:.17g}\n", node(i, j, k),
                                     x + shear * y + bulge * wave, y - bulge * wave, 0.5 * k);
                if (i == across || j == across || k == layers) continue;
                solids += fmt::format("{},10,{},{},{},{},{},{},{},{}\n", node(i, j, k), node(i, j, k),
                                      node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                                      node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                                      node(i, j + 1, k + 1));
            }
        }
    }
    testing::EulerianRun run(
        "*PART\nmesh\n10,1,1\n" + nodes + solids +
        "*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n*PART\nwater\n1,1,1,1\n*PART\nempty\n2,1,2\n"
        "*SECTION_SOLID\n1,11\n*MAT_NULL\n1,998,-1e5\n*EOS_GRUNEISEN\n1,1480,1.979,,,0.11,3,0\n1\n"
        "*MAT_VACUUM\n2,0\n" +
        testing::liquid_in_box({-1, -1, 0}, {2, 2, level}) +
        "*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n*INITIAL_HYDROSTATIC_ALE\n10,1,5,9.81\n90000,1\n" +
        testing::gravity(9.81) +
        "*CONTROL_ALE\n-1,1,2,-1\n,,,,,1\n*CONTROL_TERMINATION\n0.02\n*CONTROL_TIMESTEP\n0,0.67\n*END\n");
    const EulerianFluid& fluid = run.term<EulerianFluid>();
    EXPECT_FALSE(fluid.block().is_box());
    const auto fastest = [&] {
        double largest = 0;
        for (const auto& component : fluid.fluid().fields.velocity)
            for (double v : component) largest = std::max(largest, std::abs(v));
        return largest;
    };
    double acceleration = 0;
    run.run([&](const Clock& clock, const State&) {
        if (clock.cycle == 1) acceleration = fastest() / clock.last_step;
    });
    return {acceleration, fastest()};
}

} // namespace

TEST(AleDeck, ShuffledHexahedraRunAsTheStructuredMeshThatTheyAre)
{
    EulerianRun structured(dam(testing::structured_mesh({0, 0, 0}, {0.48, 0.04, 0.32}, {24, 2, 16}), 0.02));
    EulerianRun shuffled(dam(shuffled_mesh({0.48, 0.04, 0.32}, {24, 2, 16}), 0.02));
    structured.run();
    shuffled.run();
    const BoxFluid &a = structured.term<EulerianFluid>().box(), &b = shuffled.term<EulerianFluid>().box();
    // The decks' coordinates agree to their printed digits only; a surface between cells carries that on.
    EXPECT_NEAR(a.energies().kinetic, b.energies().kinetic, 1e-6 * a.energies().kinetic);
    ASSERT_EQ(a.fields.groups[0].fraction.size(), b.fields.groups[0].fraction.size());
    for (std::size_t i = 0; i < a.fields.groups[0].fraction.size(); ++i)
        EXPECT_NEAR(a.fields.groups[0].fraction[i], b.fields.groups[0].fraction[i], 1e-6) << i;
}

// Mass stays to round-off, and the ledger closes: what the remap takes of the motion is booked. What the
// motion itself loses in 0.15 s of a dam break on a mesh of eight cells across the column stays below 1 % of
// the work of gravity (measured 0.3 %).
TEST(AleDeck, DamBreaksInBalance)
{
    EulerianRun dam_break(dam(testing::structured_mesh({0, 0, 0}, {0.48, 0.04, 0.32}, {24, 2, 16}), 0.15));
    const BoxFluid& fluid = dam_break.term<EulerianFluid>().box();
    const double mass = fluid.total_mass(0);
    EXPECT_NEAR(mass, 1000 * 0.16 * 0.04 * 0.24, 1e-12);
    dam_break.run();
    EXPECT_NEAR(fluid.total_mass(0), mass, 1e-12 * mass);
    const EnergyLedger& ledger = dam_break.scene().ledger;
    EXPECT_GT(ledger.external_work, 0.1);
    EXPECT_LT(ledger.balance_error(), 1e-6);
    EXPECT_LT(ledger.advection_loss, 0.01 * ledger.external_work);
    // Momentum along x is what the pressure on the left wall has given; the front moves at about 2 sqrt(g h).
    EXPECT_GT(fluid.momentum()[0], 0.5);
}

// Volumes of a sphere, a cone and a half space cut by cells of 1/20: pieces of 1/160 with planes in them err
// by (piece / radius)^2 of the volume or less; planes are exact.
TEST(AleDeck, ContainersFillTheirVolumes)
{
    const std::string mesh = testing::structured_mesh({0, 0, 0}, {1, 1, 1}, {20, 20, 20});
    const auto filled = [&](const std::string& containers) {
        EulerianRun run(mesh + testing::liquid_and_void(1000, 100) +
                        "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n" + containers + testing::closed(0));
        return testing::liquid_volume(run.term<EulerianFluid>().box());
    };
    const double ball = 4 * std::numbers::pi / 3 * 0.027;
    EXPECT_NEAR(filled("6,0,1\n0.51,0.47,0.49,0.3\n"), ball, 1e-3 * ball);
    EXPECT_NEAR(filled("6,1,1\n0.51,0.47,0.49,0.3\n"), 1 - ball, 1e-3 * ball);
    const double cone = std::numbers::pi / 3 * 0.6 * (0.04 + 0.02 + 0.01);
    EXPECT_NEAR(filled("4,0,1\n0.5,0.5,0.2,0.5,0.5,0.8,0.2,0.1\n"), cone, 1e-3 * cone);
    EXPECT_NEAR(filled("3,0,1\n0.5,0.5,0.43,0.3,0.2,-1\n"), 0.43, 1e-12);
    // A shell of liquid: the outer ball filled, the inner one emptied again.
    EXPECT_NEAR(filled("6,0,1\n0.5,0.5,0.5,0.4\n6,0,2\n0.5,0.5,0.5,0.2\n"),
                4 * std::numbers::pi / 3 * (0.064 - 0.008), 1e-3 * 4 * std::numbers::pi / 3 * 0.064);
    EXPECT_NEAR(filled("5,0,1\n0.11,0.22,0.33,0.77,0.83,0.94\n"), 0.66 * 0.61 * 0.61, 1e-12);
}

TEST(AleDeck, ControlPointsGradeTheMesh)
{
    std::string text = "*ALE_STRUCTURED_MESH\n1,10,100,500\n1,2,3\n"
                       "*ALE_STRUCTURED_MESH_CONTROL_POINTS\n1\n1,0,0.5\n5,1,-0.25\n9,2\n";
    for (int axis = 2; axis <= 3; ++axis)
        text += fmt::format("*ALE_STRUCTURED_MESH_CONTROL_POINTS\n{}\n1,0\n2,1\n", axis);
    EulerianRun run(text + testing::liquid_and_void(1000, 100) +
                    testing::liquid_in_box({0, 0, 0}, {1, 1, 1}) + testing::closed(0));
    const std::vector<double>& x = run.term<EulerianFluid>().box().grid.planes(0);
    ASSERT_EQ(x.size(), 9u);
    EXPECT_NEAR((x[2] - x[1]) / (x[1] - x[0]), 1.5, 1e-12);
    EXPECT_NEAR((x[3] - x[2]) / (x[2] - x[1]), 1.5, 1e-12);
    EXPECT_DOUBLE_EQ(x[4], 1);
    EXPECT_NEAR((x[6] - x[5]) / (x[5] - x[4]), 1 / 1.25, 1e-12);
    EXPECT_EQ(run.model().nodes.id.front(), 100);
    EXPECT_EQ(run.model().solids.id.front(), 500);
}

// *ALE_STRUCTURED_MESH_REFINE cuts every cell into 2 x 1 x 3 equal ones, graded cells too.
TEST(AleDeck, CellsOfAStructuredMeshAreCut)
{
    EulerianRun run("*ALE_STRUCTURED_MESH\n7,10,1,1\n1,2,3\n"
                    "*ALE_STRUCTURED_MESH_CONTROL_POINTS\n1\n1,0,1\n3,3\n"
                    "*ALE_STRUCTURED_MESH_CONTROL_POINTS\n2\n1,0\n2,1\n"
                    "*ALE_STRUCTURED_MESH_CONTROL_POINTS\n3\n1,0\n2,3\n"
                    "*ALE_STRUCTURED_MESH_REFINE\n7,2,1,3\n*ALE_STRUCTURED_MESH_REFINE\n8,5,5,5\n" +
                    testing::liquid_and_void(1000, 100) + testing::closed(0));
    const BoxGrid& grid = run.term<EulerianFluid>().box().grid;
    EXPECT_EQ(grid.planes(0), (std::vector<double>{0, 0.5, 1, 2, 3}));
    EXPECT_EQ(grid.planes(1), (std::vector<double>{0, 1}));
    EXPECT_EQ(grid.planes(2), (std::vector<double>{0, 1, 2, 3}));
}

// A lid that drives a box of fluid: nodes of the mesh follow *BOUNDARY_PRESCRIBED_MOTION, the mesh stays.
TEST(AleDeck, DrivenNodesMoveTheFluidAndNotTheMesh)
{
    const std::string lid = "*DEFINE_CURVE\n2\n0,1\n1e9,1\n*DEFINE_BOX\n1,-1,2,-1,2,0.999,1.001\n"
                            "*SET_NODE_GENERAL\n1\nBOX,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,0,2\n";
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 0.1, 1}, {8, 1, 8}) +
                    "*ALE_MULTI-MATERIAL_GROUP\n1,1\n*PART\nliquid\n1,1,1,1\n*SECTION_SOLID\n1,11\n"
                    "*MAT_NULL\n1,1,-1e9,0.01\n*EOS_LINEAR_POLYNOMIAL\n1,0,100\n\n" +
                    lid + testing::closed(0.2));
    run.run();
    const BoxFluid& fluid = run.term<EulerianFluid>().box();
    EXPECT_DOUBLE_EQ(fluid.fields.velocity[0][fluid.grid.at(4, 0, 8)], 1);
    EXPECT_GT(fluid.fields.velocity[0][fluid.grid.at(4, 0, 7)], 0.05);
    EXPECT_LT(fluid.fields.velocity[0][fluid.grid.at(4, 0, 7)], 0.9);
    const std::size_t nodes = run.model().nodes.size();
    for (std::size_t node = 0; node < nodes; ++node)
        EXPECT_EQ(norm(run.scene().state.position[node] - run.model().nodes.position[node]), 0);
    EXPECT_LT(run.scene().ledger.balance_error(), 1e-6);
}

// A blob of liquid flies through empty space: seen from a mesh that flies along with it (PRTYPE 4) it stands
// still, so nothing is smeared and all its energy stays. Along z, where BCTRAN holds the mesh, it falls by
// 0.1 (two cells, so that sums over cell centres tell its middle) and stays clear of the open sides.
TEST(AleDeck, MeshFollowsTheMass)
{
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 1, 1}, {20, 20, 20}) +
                    testing::liquid_and_void(1000, 100) +
                    "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n6,0,1,50,20,-10\n0.5,0.5,0.6,0.25\n"
                    "*ALE_REFERENCE_SYSTEM_GROUP\n10,1,4,0,3,7\n"
                    "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.01\n*CONTROL_TIMESTEP\n0,0.2\n*END\n");
    const BoxFluid& fluid = run.term<EulerianFluid>().box();
    const double mass = fluid.total_mass(0);
    const double end = run.run().clock.time;
    EXPECT_NEAR(fluid.total_mass(0), mass, 1e-12 * mass);
    EXPECT_NEAR(run.scene().ledger.external_work, 0, 1e-9 * mass); // nothing works on it
    const double reached = fluid.grid.planes(0).front() / 50, other = fluid.grid.planes(1).front() / 20;
    EXPECT_NEAR(reached, end, 1e-4);
    EXPECT_NEAR(other, end, 1e-4);
    EXPECT_EQ(fluid.grid.planes(2).front(), 0); // BCTRAN holds z
    // Its middle in the mesh: still at 0.5 along x and y, fallen along z.
    Vec3 middle{};
    for (int k = 0; k < 20; ++k)
        for (int j = 0; j < 20; ++j)
            for (int i = 0; i < 20; ++i)
                middle += (fluid.fields.groups[0].mass[fluid.grid.at(i, j, k)] / mass) *
                          Vec3{(i + 0.5) / 20, (j + 0.5) / 20, (k + 0.5) / 20};
    EXPECT_NEAR(middle.x, 0.5, 1e-3);
    EXPECT_NEAR(middle.y, 0.5, 1e-3);
    EXPECT_NEAR(middle.z, 0.6 - 10 * end, 1e-3);
    EXPECT_LT(run.scene().ledger.balance_error(), 1e-9);
}

// A structured mesh that follows one of two drops (FOLLOW_GC): that one stays in its midst though the other
// flies away, and its plane of symmetry (ISYM, along z) stays where it is.
TEST(AleDeck, StructuredMeshFollowsOneGroup)
{
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {2, 1, 1}, {40, 20, 20}) +
                    "*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n3,1\n*PART\ndrop\n1,1,1,1\n*PART\nempty\n2,1,2\n"
                    "*PART\nother\n3,1,1,1\n*SECTION_SOLID\n1,11\n*MAT_NULL\n1,1000,-1e4\n"
                    "*EOS_LINEAR_POLYNOMIAL\n1,0,1e7\n\n*MAT_VACUUM\n2,0\n"
                    "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n6,0,1,50,20,-5\n0.5,0.5,0.6,0.25\n"
                    "6,0,3,20,20,0\n1.5,0.5,0.5,0.25\n"
                    "*ALE_STRUCTURED_MESH_MOTION\n1,FOLLOW_GC,4,,,,,1\n*SET_MULTI-MATERIAL_GROUP_LIST\n4\n1\n"
                    "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.005\n*CONTROL_TIMESTEP\n0,0.2\n*END\n");
    const BoxFluid& fluid = run.term<EulerianFluid>().box();
    const double end = run.run().clock.time;
    EXPECT_NEAR(fluid.grid.planes(0).front(), 50 * end, 1e-3 * 50 * end);
    EXPECT_NEAR(fluid.grid.planes(1).front(), 20 * end, 1e-3 * 20 * end);
    EXPECT_EQ(fluid.grid.planes(2).front(), 0);
}

// A viscous fluid under its other name, and a mixture of gases: by mass (air of 0.8 nitrogen and 0.4 oxygen
// at 300) it starts with the sum of rho R T, 0.8 * 297 * 300 + 0.4 * 260 * 300; the same by mole.
TEST(AleDeck, MaterialsOfEulerianMeshesUnderTheirOtherNames)
{
    const auto speeds = [](const std::string& material) {
        EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 1, 1}, {8, 8, 8}) +
                        "*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n*PART\nliquid\n1,1,1,1\n*PART\nempty\n2,1,2\n"
                        "*SECTION_SOLID\n1,11\n" +
                        material + "*EOS_LINEAR_POLYNOMIAL\n1,0,1e7\n\n*MAT_VACUUM\n2,0\n" +
                        "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n5,0,1,3\n0,0,0,1,1,0.5\n" +
                        testing::closed(0.01));
        run.run();
        return run.term<EulerianFluid>().fluid().fields.velocity[0];
    };
    const auto null = speeds("*MAT_NULL\n1,1000,-1e4,50\n");
    EXPECT_EQ(null, speeds("*MAT_ALE_VISCOUS\n1,1000,-1e4,50\n"));
    EXPECT_NE(null, speeds("*MAT_ALE_VISCOUS\n1,1000,-1e4,0\n"));
    EXPECT_THROW(speeds("*MAT_ALE_VISCOUS\n1,1000,-1e4,50,60\n"), DeckError);

    for (const char* heat : {"1,0,0\n743,660\n1040,920\n", "1,0,8.316\n0.028,0.032\n29.12,29.44\n\n\n"}) {
        EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2}) +
                        "*ALE_MULTI-MATERIAL_GROUP\n1,1\n*PART\ngas\n1,1,1\n*SECTION_SOLID\n1,11\n"
                        "*MAT_ALE_GAS_MIXTURE\n" +
                        heat + "*INITIAL_GAS_MIXTURE\n10,1,1,300\n0.8,0.4\n" + testing::closed(1e-4));
        const BoxFluid& fluid = run.term<EulerianFluid>().box();
        run.run();
        const double expected =
            heat[4] == '0' ? 0.8 * 297 * 300 + 0.4 * 260 * 300 : (0.8 * 297 + 0.4 * 259.875) * 300;
        EXPECT_NEAR(fluid.fields.pressure[fluid.grid.at(0, 0, 0)], expected, 1e-9 * expected) << heat;
        EXPECT_NEAR(fluid.total_mass(0), 1.2, 1e-12);
    }
}

// A mesh that stands, then moves by a curve, then goes with the first node of a rigid plate (PRTYPE 6 with 0,
// 3 and 5 one after the other); the liquid is seen to stand still in space. The plate's speed rises in the
// first third of 0.03 s from 0 to 4, the curve gives 2 in the second: the mesh goes 0.01 x 2 + 0.01 x 4.
TEST(AleDeck, MeshFollowsANodeWhenItsTimeHasCome)
{
    int first = 100000;
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 1, 1}, {16, 8, 8}) +
                    testing::liquid_and_void(1000, 20) +
                    "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n6,0,1\n0.5,0.5,0.5,0.3\n"
                    "*PART\nplate\n20,20,20\n*SECTION_SHELL\n20,2\n0.01,0.01,0.01,0.01\n"
                    "*MAT_RIGID\n20,7800,2e11,0.3\n1,5,7\n\n" +
                    testing::shell_patch(20, first, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}, 1, 1) +
                    "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n20,1,0,2\n*DEFINE_CURVE\n2\n0,0\n0.01,4\n1,4\n"
                    "*DEFINE_CURVE\n3\n0,2\n1,2\n"
                    "*ALE_REFERENCE_SYSTEM_GROUP\n10,1,6,4,0,0,7\n"
                    "*ALE_REFERENCE_SYSTEM_SWITCH\n4\n0.01,0.02\n0,3,5\n0,6,7\n"
                    "*ALE_REFERENCE_SYSTEM_CURVE\n6\n3\n\n*ALE_REFERENCE_SYSTEM_NODE\n7\n100000\n\n"
                    "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.03\n*CONTROL_TIMESTEP\n0,0.2\n*END\n");
    const BoxFluid& fluid = run.term<EulerianFluid>().box();
    double step = 0;
    run.run([&](const Clock& clock, const State&) {
        step = std::max(step, clock.step);
        if (clock.time < 0.01) {
            EXPECT_EQ(fluid.grid.planes(0).front(), 0);
        }
    });
    // Each change comes with the cycle that follows it.
    EXPECT_NEAR(fluid.grid.planes(0).front(), 0.06, 4 * step);
    EXPECT_EQ(fluid.grid.planes(1).front(), 0);
    Vec3 middle{};
    const double mass = fluid.total_mass(0);
    for (int k = 0; k < 8; ++k)
        for (int j = 0; j < 8; ++j)
            for (int i = 0; i < 16; ++i)
                middle += (fluid.fields.groups[0].mass[fluid.grid.at(i, j, k)] / mass) *
                          Vec3{fluid.grid.centre(0, i), fluid.grid.centre(1, j), fluid.grid.centre(2, k)};
    EXPECT_NEAR(middle.x, 0.5, 2e-3);
    EXPECT_NEAR(middle.y, 0.5, 1e-9);
}

// Meshes that turn with nodes do so about all axes or not at all; Lagrangian meshes and smoothed ones are not
// there.
TEST(AleDeck, MeshMotionsThatAreNotThereAreRefused)
{
    const auto deck = [](int held, int type) {
        return testing::structured_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2}) +
               testing::liquid_and_void(1000, 100) +
               fmt::format("*ALE_REFERENCE_SYSTEM_GROUP\n10,1,{},7,0,0,{}\n\n"
                           "*ALE_REFERENCE_SYSTEM_NODE\n7\n1,2,4\n\n",
                           type, held) +
               "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n1\n*END\n";
    };
    EXPECT_NO_THROW(EulerianRun(deck(7, 5)));
    EXPECT_NO_THROW(EulerianRun(deck(0, 5)));
    EXPECT_THROW(EulerianRun(deck(3, 5)), DeckError);
    EXPECT_NO_THROW(EulerianRun(deck(7, 1)));
    EXPECT_NO_THROW(EulerianRun(deck(7, 2)));
    EXPECT_THROW(EulerianRun(deck(7, 8)), DeckError); // EFAC = 0
    EXPECT_THROW(EulerianRun(deck(7, 9)), DeckError);
}

// A container fills the cells that its surface cuts with fluid of its own velocity; the empty rest of them
// has none and slows nothing.
TEST(AleDeck, ContainersMoveAllThatTheyFill)
{
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 1, 1}, {7, 7, 7}) +
                    testing::liquid_and_void(1000, 100) +
                    "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n6,0,1,50,20,-10\n0.5,0.5,0.5,0.3\n" +
                    testing::closed(0));
    const Fluid& fluid = run.term<EulerianFluid>().fluid();
    run.run();
    const double mass = fluid.total_mass(0);
    const double velocity[3] = {50, 20, -10};
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(fluid.momentum()[axis], mass * velocity[axis], 1e-12 * mass * 50);
    EXPECT_NEAR(fluid.energies().kinetic, 0.5 * mass * 3000, 1e-12 * mass * 3000);
}

// Gruneisen water 10 m deep with its surface anywhere in a cell: nothing accelerates at the start (below 1e-4
// g), and nothing moves. The column's pressure solves dp/ds = rho(p) g, for pressure linear in density p = K
// (exp(rho0 g s / K)
// - 1).
TEST(AleDeck, HydrostaticStartIsAtRest)
{
    FluidGroup water = linear_liquid(1000, 1000);
    const auto density = [&](double pressure, double) { return density_at_pressure(water, pressure, 0); };
    const double stiffness = 1e9, weight = 1000 * 9.81;
    const std::vector<double> column = pressures_below(0, density, 9.81, {1, 10, 1000});
    for (const auto& [depth, at] : {std::pair(1.0, 0), std::pair(10.0, 1), std::pair(1000.0, 2)})
        EXPECT_NEAR(column[at], stiffness * std::expm1(weight * depth / stiffness), 1e-8 * weight * depth);

    for (const double level : {10.0, 10.3, 10.45}) {
        EulerianRun run(
            testing::structured_mesh({0, 0, 0}, {1, 1, 12}, {2, 2, 24}) +
            "*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n*PART\nwater\n1,1,1,1\n*PART\nempty\n2,1,2\n"
            "*SECTION_SOLID\n1,11\n*MAT_NULL\n1,998,-1e5\n*EOS_GRUNEISEN\n1,1480,1.979,,,0.11,3,0\n1\n"
            "*MAT_VACUUM\n2,0\n" +
            testing::liquid_in_box({0, 0, 0}, {1, 1, level}) +
            fmt::format("*NODE\n90000,0,0,{}\n*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n"
                        "*INITIAL_HYDROSTATIC_ALE\n10,1,5,9.81\n90000,1\n",
                        level) +
            testing::gravity(9.81) + testing::closed(0.05));
        BoxFluid& fluid = run.term<EulerianFluid>().box();
        const auto fastest = [&] {
            double largest = 0;
            for (const auto& component : fluid.fields.velocity)
                for (double v : component) largest = std::max(largest, std::abs(v));
            return largest;
        };
        double acceleration = 0;
        run.run([&](const Clock& clock, const State&) {
            if (clock.cycle == 1) acceleration = fastest() / clock.last_step;
        });
        EXPECT_LT(acceleration, 1e-4 * 9.81) << level;
        EXPECT_LT(fastest(), 1e-4) << level;
    }
}

// The same on general hexahedra whose walls stick. Cells are prisms over parallelograms.
TEST(AleDeck, HydrostaticStartOfGeneralHexahedraIsAtRest)
{
    const Unrest unrest = unrest_of_hexahedra(0.3, 0);
    EXPECT_LT(unrest.acceleration, 1e-4 * 9.81);
    EXPECT_LT(unrest.speed, 1e-4);
}

// Columns that bulge, up to a surface between two layers. With eighths of the cells' weights on their nodes
// 0.0084 g.
TEST(AleDeck, HydrostaticStartOfDistortedHexahedraIsAtRest)
{
    const Unrest unrest = unrest_of_hexahedra(0, 0.05, 10);
    EXPECT_LT(unrest.acceleration, 1e-4 * 9.81);
    EXPECT_LT(unrest.speed, 1e-4);
}

// The surface passes cells that bulge, which are filled by the share of their height that is wet. With the
// volume below the surface 0.0025 g.
TEST(AleDeck, HydrostaticStartInDistortedHexahedraIsAtRest)
{
    for (const double level : {10.05, 10.2, 10.45}) {
        const Unrest unrest = unrest_of_hexahedra(0, 0.05, level);
        EXPECT_LT(unrest.acceleration, 1e-4 * 9.81) << level;
        EXPECT_LT(unrest.speed, 1e-4) << level;
    }
}

} // namespace plash
