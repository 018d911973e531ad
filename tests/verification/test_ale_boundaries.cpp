#include "tests/support/ale_deck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

using testing::EulerianRun;

/// A tube 1 x 0.02 x 0.02 along x on 100 cells; the first three belong to part 1, the others to part 2. With
/// `twist` the tube's nodes are moved along x and no cell is a box.
std::string tube(double twist)
{
    std::string nodes = "*NODE\n", elements = "*ELEMENT_SOLID\n";
    const auto number = [](int i, int j, int k) { return 1 + j + 2 * k + 4 * i; };
    for (int i = 0; i <= 100; ++i)
        for (int k = 0; k < 2; ++k)
            for (int j = 0; j < 2; ++j) {
                const double moved = i == 0 || i == 100 ? 0 : twist * (j == k ? 1 : -1);
                nodes +=
                    fmt::format("{},{:.9g},{},{}\n", number(i, j, k), 0.01 * i + moved, 0.02 * j, 0.02 * k);
            }
    for (int i = 0; i < 100; ++i)
        elements += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", i + 1, i < 3 ? 1 : 2, number(i, 0, 0),
                                number(i + 1, 0, 0), number(i + 1, 1, 0), number(i, 1, 0), number(i, 0, 1),
                                number(i + 1, 0, 1), number(i + 1, 1, 1), number(i, 1, 1));
    return nodes + elements;
}

std::string gas(int part, int section, double density, double pressure)
{
    return fmt::format("*PART\ngas\n{0},{1},{0},{0}\n*MAT_NULL\n{0},{2},-1e30\n"
                       "*EOS_LINEAR_POLYNOMIAL\n{0},0,0,0,0,0.4,0.4\n{3},1\n",
                       part, section, density, pressure / 0.4);
}

} // namespace

// A reservoir (AET 4) that moves with the speed of the gas behind a shock of Mach 2 and has its state drives
// just this shock into gas at rest (Rankine & Hugoniot for a ratio of 1.4: pressure 4.5, density 8 / 3,
// velocity 1.25 c, shock speed 2 c), through boxes and general hexahedra alike.
TEST(AleBoundaries, AmbientCellsDriveAShock)
{
    const double sound = std::sqrt(1.4), density = 8.0 / 3, velocity = 1.25 * sound, end = 0.3;
    for (const double twist : {0.0, 0.001}) {
        std::string driven = "*SET_NODE_LIST\n1\n";
        for (int node = 1; node <= 16; ++node)
            driven += fmt::format("{}{}", node, node % 8 == 0 ? "\n" : ",");
        EulerianRun run(
            tube(twist) + gas(1, 1, density, 4.5) + gas(2, 2, 1, 1) +
            "*SECTION_SOLID\n1,11,4\n*SECTION_SOLID\n2,11\n*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n" + driven +
            fmt::format("*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,0,1,{}\n*DEFINE_CURVE\n1\n0,1\n1,1\n",
                        velocity) +
            "*BOUNDARY_SPC_SET\n2,0,0,1,1\n*SET_NODE_LIST_GENERATE\n2\n1,404\n"
            "*BOUNDARY_SPC_SET\n3,0,1\n*SET_NODE_LIST_GENERATE\n3\n401,404\n" +
            fmt::format("*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n{}\n"
                        "*CONTROL_TIMESTEP\n0,0.6\n*END\n",
                        end));
        const EulerianFluid& term = run.term<EulerianFluid>();
        EXPECT_EQ(term.block().is_box(), twist == 0);
        const Fluid& fluid = term.fluid();
        const double reached = run.run().clock.time, front = 0.03 + 2 * sound * reached;
        double crossing = 0, worst = 0;
        for (std::size_t number = 0; number < fluid.cell_count(); ++number) {
            const FluidCell cell = fluid.cell(number);
            const double own = fluid.fields.total_mass()[cell.place] / cell.volume;
            Vec3 centre{};
            for (const Vec3& point : cell.points) centre += 0.125 * point;
            if (own > 0.5 * (1 + density)) crossing = std::max(crossing, centre.x + 0.005);
            if (centre.x < 0.03) {
                EXPECT_NEAR(own, density, 1e-12) << centre.x;
            }
            // The plateau, away from the front and from the gas in which the shock had to form, which by now
            // is at 0.03 + velocity * reached and smeared over ten cells.
            if (centre.x > 0.13 + velocity * reached && centre.x < front - 0.08)
                worst = std::max(worst, std::abs(own / density - 1));
        }
        EXPECT_NEAR(crossing, front, 0.015) << twist;
        EXPECT_LT(worst, 0.01) << twist;
        EXPECT_LT(run.scene().ledger.balance_error(), 1e-6);
    }
}

// A pressure load on the open end of a tube holds the gas inside at rest; without it the gas blows out.
TEST(AleBoundaries, LoadsOnSegmentsHoldTheGas)
{
    for (const bool loaded : {true, false}) {
        const std::string load = loaded ? "*LOAD_SEGMENT\n1,1,0,401,402,404,403\n" : "";
        EulerianRun run(
            tube(0) + gas(1, 1, 1, 2) + gas(2, 1, 1, 2) +
            "*SECTION_SOLID\n1,11\n*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n" + load +
            "*DEFINE_CURVE\n1\n0,2\n1,2\n"
            "*BOUNDARY_SPC_SET\n2,0,0,1,1\n*SET_NODE_LIST_GENERATE\n2\n1,404\n"
            "*BOUNDARY_SPC_SET\n3,0,1\n*SET_NODE_LIST_GENERATE\n3\n1,4\n"
            "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.1\n*CONTROL_TIMESTEP\n0,0.6\n*END\n");
        const Fluid& fluid = run.term<EulerianFluid>().fluid();
        run.run();
        double fastest = 0;
        for (double v : fluid.fields.velocity[0]) fastest = std::max(fastest, std::abs(v));
        if (loaded)
            EXPECT_LT(fastest, 1e-10);
        else
            EXPECT_GT(fastest, 0.5);
        EXPECT_LT(run.scene().ledger.balance_error(), 1e-6);
    }
}

// PREF of *CONTROL_ALE as a curve that rises from the pressure of the gas does to the open end of a tube what
// a load on its face by the same curve does; the load is taken at the beginning of a step and PREF in its
// middle. On boxes and on general hexahedra.
TEST(AleBoundaries, OutsidePressureFollowsItsCurve)
{
    for (const double twist : {0.0, 0.001}) {
        std::vector<double> velocity[2];
        double step = 0;
        for (const bool by_load : {true, false}) {
            EulerianRun run(tube(twist) + gas(1, 1, 1, 2) + gas(2, 1, 1, 2) +
                            "*SECTION_SOLID\n1,11\n*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n" +
                            (by_load ? "*LOAD_SEGMENT\n1,1,0,401,402,404,403\n" : "") +
                            "*DEFINE_CURVE\n1\n0,2\n0.1,2.2\n1,2.2\n"
                            "*BOUNDARY_SPC_SET\n2,0,0,1,1\n*SET_NODE_LIST_GENERATE\n2\n1,404\n"
                            "*BOUNDARY_SPC_SET\n3,0,1\n*SET_NODE_LIST_GENERATE\n3\n1,4\n" +
                            fmt::format("*CONTROL_ALE\n-1,1,2,-1\n,,,,,,{}\n*CONTROL_TERMINATION\n0.1\n"
                                        "*CONTROL_TIMESTEP\n0,0.6\n*END\n",
                                        by_load ? 0 : -1));
            const Fluid& fluid = run.term<EulerianFluid>().fluid();
            run.run([&](const Clock& clock, const State&) { step = std::max(step, clock.step); });
            for (std::size_t node = 0; node < fluid.node_count(); ++node)
                velocity[by_load].push_back(fluid.fields.velocity[0][fluid.node_place(node)]);
            EXPECT_LT(run.scene().ledger.balance_error(), 1e-6);
        }
        double fastest = 0, difference = 0;
        for (std::size_t node = 0; node < velocity[0].size(); ++node) {
            fastest = std::max(fastest, std::abs(velocity[1][node]));
            difference = std::max(difference, std::abs(velocity[1][node] - velocity[0][node]));
        }
        // Density times speed of sound, in the middle of the rise on the adiabat.
        const double impedance = std::sqrt(1.4 * 2.1 * std::pow(1.05, 1 / 1.4));
        EXPECT_NEAR(fastest, 0.2 / impedance, 0.02 * fastest);
        EXPECT_LT(difference, 0.55 * step * 2 / impedance) << twist; // half a step of the rise of 2 a time
    }
}

// *BOUNDARY_NON_REFLECTING at both ends of a tube: of a pulse that starts in its middle less than a hundredth
// of the energy is left when it has gone; without it all of it comes back from where nothing holds the gas
// (or the gas blows out). On boxes and on general hexahedra.
TEST(AleBoundaries, PulseLeavesThroughNonReflectingEnds)
{
    for (const double twist : {0.0, 0.001}) {
        EulerianRun run(
            tube(twist) + gas(1, 1, 1, 2) + gas(2, 1, 1, 2) +
            "*SECTION_SOLID\n1,11\n*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n"
            "*SET_SEGMENT\n1\n401,402,404,403\n1,2,4,3\n*BOUNDARY_NON_REFLECTING\n1\n"
            "*BOUNDARY_SPC_SET\n2,0,0,1,1\n*SET_NODE_LIST_GENERATE\n2\n1,404\n"
            "*INITIAL_VELOCITY\n3\n0.01\n*SET_NODE_LIST_GENERATE\n3\n161,244\n"
            "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.7\n*CONTROL_TIMESTEP\n0,0.6\n*END\n");
        const Fluid& fluid = run.term<EulerianFluid>().fluid();
        const auto energy = [&] {
            double sum = 0;
            for (std::size_t number = 0; number < fluid.cell_count(); ++number) {
                const FluidCell cell = fluid.cell(number);
                const double over = fluid.fields.pressure[cell.place] - 2;
                sum += over * over / (2 * 1.4 * 2) * cell.volume;
                for (const std::ptrdiff_t node : cell.corners)
                    sum += 0.0625 * fluid.fields.total_mass()[cell.place] * fluid.fields.velocity[0][node] *
                           fluid.fields.velocity[0][node];
            }
            return sum;
        };
        double before = 0;
        run.run([&](const Clock& clock, const State&) {
            if (clock.cycle == 0) before = energy();
        });
        EXPECT_NEAR(before, 0.5 * 1e-4 * 0.2 * 4e-4, 0.1 * before); // density, width and area of the pulse
        EXPECT_LT(energy(), 0.01 * before) << twist;
        EXPECT_LT(run.scene().ledger.balance_error(), 1e-6);
    }
}

// Water at rest 10 m deep stands behind such a side as behind a wall: outside is what was there at the start.
TEST(AleBoundaries, NonReflectingSideHoldsStillWater)
{
    std::string segments = "*SET_SEGMENT\n1\n";
    const auto number = [](int i, int j, int k) { return 1 + i + 3 * (j + 3 * k); };
    for (int k = 0; k < 24; ++k)
        for (int j = 0; j < 2; ++j)
            segments += fmt::format("{},{},{},{}\n", number(2, j, k), number(2, j + 1, k),
                                    number(2, j + 1, k + 1), number(2, j, k + 1));
    std::string wall = "*SET_NODE_LIST\n2\n", floor = "*SET_NODE_LIST\n3\n", all = "*SET_NODE_LIST\n4\n";
    for (int k = 0; k <= 24; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                const std::string line = fmt::format("{}\n", number(i, j, k));
                all += line;
                if (i == 0) wall += line;
                if (k == 0) floor += line;
            }
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 1, 12}, {2, 2, 24}) +
                    testing::liquid_and_void(1000, 1000) + testing::liquid_in_box({0, 0, 0}, {1, 1, 10}) +
                    "*NODE\n90000,0,0,10\n*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n"
                    "*INITIAL_HYDROSTATIC_ALE\n10,1,5,9.81\n90000,1\n" +
                    segments + "*BOUNDARY_NON_REFLECTING\n1\n" + wall + floor + all +
                    "*BOUNDARY_SPC_SET\n2,0,1\n3,0,0,0,1\n4,0,0,1\n" + testing::gravity(9.81) +
                    "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.05\n*CONTROL_TIMESTEP\n0,0.67\n*END\n");
    const Fluid& fluid = run.term<EulerianFluid>().fluid();
    run.run();
    double fastest = 0;
    for (const auto& component : fluid.fields.velocity)
        for (const double v : component) fastest = std::max(fastest, std::abs(v));
    EXPECT_LT(fastest, 1e-4);
}

} // namespace plash
