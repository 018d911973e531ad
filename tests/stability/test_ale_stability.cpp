#include "tests/support/ale_deck.h"
#include "tests/support/ale_samples.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

/// Violent things that happen to Eulerian water and its coupling: the run ends normally, its energy balances,
/// mass stays, and where the force is known it is met.
namespace plash {

namespace {

using testing::EulerianRun;

/// Part 20, a rigid shell of both sides' couplings with the mesh, driven along an axis with a given speed; it
/// neither turns nor moves along the other axes.
std::string driven_shell(int axis, double speed, const std::string& coupling, bool both_sides)
{
    std::string text =
        fmt::format("*PART\nstructure\n20,20,20\n*SECTION_SHELL\n20,2\n0.001,0.001,0.001,0.001\n"
                    "*MAT_RIGID\n20,7800,2e11,0.3\n1,{},7\n\n"
                    "*CONSTRAINED_LAGRANGE_IN_SOLID\n20,10,1,1,{}\n",
                    axis == 1   ? 5
                    : axis == 2 ? 6
                                : 4,
                    coupling);
    if (both_sides) { // NORM = 1 on the second card
        const auto line = coupling.find('\n');
        text += fmt::format("*CONSTRAINED_LAGRANGE_IN_SOLID\n20,10,1,1,{}\n0,0,0.1,0,0.3,1\n",
                            coupling.substr(0, line));
    }
    return text + fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n20,{},0,2\n*DEFINE_CURVE\n2\n0,{}\n10,{}\n",
                              axis, speed, speed);
}

} // namespace

/// The contact line of a wedge of 4 degrees runs along the surface with 0.37 of the speed of sound.
TEST(AleStability, WedgeOfFourDegrees)
{
    const Threads one(1);
    constexpr double density = 1000, sound = 60, speed = 1, cell = 0.02, end = 0.04;
    const double rise = std::tan(4 * std::numbers::pi / 180);
    int first = 100000;
    EulerianRun run(
        testing::structured_mesh({0, 0, -1}, {1.6, cell, 0.2}, {80, 1, 60}) +
        testing::liquid_and_void(density, sound) + testing::liquid_in_box({0, -1, -1}, {2, 1, 0}) +
        driven_shell(3, -speed, "2,4,1,1\n0,0,0.1,0,0.3,0,0,0.5", false) +
        testing::shell_patch(20, first, {0, 0, 0}, {0, cell, 0}, {1, 0, rise}, 1, 50) + testing::closed(end));
    const FluidCoupling& coupled = run.term<FluidCoupling>();
    double impulse = 0, largest = 0, hammer = density * sound * speed;
    run.run([&](const Clock& clock, const State&) {
        impulse += coupled.force().z * clock.step;
        largest = std::max(largest, coupled.force().z / cell);
    });
    // Wagner's impulse of half a wedge, pi / 4 rho c^2 V with the wetted half width c = pi / 2 V t / tan.
    const double wetted = 0.5 * std::numbers::pi * speed * end / rise;
    const double wagner = 0.25 * std::numbers::pi * density * wetted * wetted * speed * cell;
    EXPECT_NEAR(impulse / wagner, 1, 0.25);
    // Never more than twice the water hammer on all of it: the floor sends waves back.
    EXPECT_LT(largest, 2 * hammer * wetted);
    EXPECT_LT(run.scene().ledger.balance_error(), 0.01);
}

/// A plate without thickness cuts into the water edgewise: it is hardly felt and lets nothing through.
TEST(AleStability, SharpPlateEntersEdgewise)
{
    const Threads one(1);
    constexpr double cell = 0.02, speed = 20, end = 0.015;
    int first = 100000;
    EulerianRun run(testing::structured_mesh({0, 0, -0.4}, {0.8, cell, 0.4}, {40, 1, 40}) +
                    testing::liquid_and_void(1000, 200) + testing::liquid_in_box({0, -1, -1}, {2, 1, 0}) +
                    driven_shell(3, -speed, "2,4,1,1\n0,0,0.1,0,0.3", true) +
                    testing::shell_patch(20, first, {0.41, 0, 0.001}, {0, cell, 0}, {0, 0, 0.35}, 1, 18) +
                    testing::closed(end));
    std::vector<const FluidCoupling*> sides;
    for (const auto& term : run.scene().terms)
        if (const auto* coupling = dynamic_cast<const FluidCoupling*>(term.get())) sides.push_back(coupling);
    ASSERT_EQ(sides.size(), 2u);
    const BoxFluid& fluid = run.term<EulerianFluid>().box();
    const double before = fluid.total_mass(0);
    double drag = 0;
    run.run([&](const Clock& clock, const State&) {
        drag += (sides[0]->force().z + sides[1]->force().z) * clock.step / end;
    });
    // Against the stagnation pressure on a plate as wide as it is deep in the end.
    EXPECT_LT(std::abs(drag), 0.01 * 0.5 * 1000 * speed * speed * speed * end * cell);
    EXPECT_NEAR(fluid.total_mass(0), before, 1e-12 * before);
    EXPECT_LT(run.scene().ledger.balance_error(), 0.01);
}

/// A jet of six cells against a rigid plate turns aside: its force is rho V^2 b. Half of it, by symmetry.
TEST(AleStability, ThinJetPushesThePlateByItsMomentum)
{
    const Threads one(1);
    // Between the water hammer of the start and the time when what has turned aside arrives at the wall.
    constexpr double cell = 0.01, speed = 30, half_width = 0.03, begin = 0.002, end = 0.006;
    int first = 100000;
    EulerianRun run(
        testing::structured_mesh({0, 0, 0}, {0.4, cell, 0.7}, {40, 1, 70}) +
        testing::liquid_and_void(1000, 200, -1) +
        fmt::format("*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n5,0,1,0,0,{}\n-1,-1,0.1,{},1,1\n", -speed,
                    half_width) +
        driven_shell(3, 0, "2,4,2,1\n0,0,1,0,0.3,0,0,0.5", false) +
        testing::shell_patch(20, first, {0, 0, 0.095}, {0.4, 0, 0}, {0, cell, 0}, 40, 1) +
        testing::closed(end));
    const FluidCoupling& coupled = run.term<FluidCoupling>();
    const double expected = 1000 * speed * speed * half_width * cell;
    double impulse = 0;
    run.run([&](const Clock& clock, const State&) {
        if (clock.time > begin) impulse -= coupled.force().z * clock.step;
    });
    EXPECT_NEAR(impulse / (end - begin) / expected, 1, 0.05); // measured 0.978
    EXPECT_LT(run.scene().ledger.balance_error(), 0.01);
}

/// A plate that falls flat on water at 100 m/s: the pressure behind a plane shock, rho Us V with Us (Us - V)
/// = c^2.
TEST(AleStability, CouplingAtHundredMetresASecond)
{
    const Threads one(1);
    constexpr double side = 0.02, speed = 100, sound = 1500, end = 2.5e-4;
    int first = 100000;
    EulerianRun run(testing::structured_mesh({0, 0, -0.5}, {side, side, 0.1}, {2, 2, 60}) +
                    testing::liquid_and_void(1000, sound) + testing::liquid_in_box({-1, -1, -1}, {1, 1, 0}) +
                    driven_shell(3, -speed, "2,4,2,1\n0,0,1,0,0.3,0,0,0.5", false) +
                    testing::shell_patch(20, first, {0, 0, 0.001}, {0, side, 0}, {side, 0, 0}, 1, 1) +
                    testing::closed(end));
    const FluidCoupling& coupled = run.term<FluidCoupling>();
    double impulse = 0;
    run.run([&](const Clock& clock, const State&) {
        if (clock.time > 0.5 * end) impulse += coupled.force().z * clock.step;
    });
    const double shock = 0.5 * speed + std::sqrt(0.25 * speed * speed + sound * sound);
    const double pressure = 1000 * shock * speed;
    EXPECT_NEAR(impulse / (0.5 * end) / (side * side), pressure, 0.05 * pressure);
    EXPECT_LT(run.scene().ledger.balance_error(), 0.01);
}

/// A plate that is dragged broadside through a tank leaves a cavity behind: the water tears at its tension
/// limit.
TEST(AleStability, CavityBehindAPlate)
{
    const Threads one(1);
    constexpr double cell = 0.02, speed = 20, width = 0.1, end = 0.012;
    int first = 100000;
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {0.8, cell, 0.6}, {40, 1, 30}) +
                    testing::liquid_and_void(1000, 200, -100) +
                    testing::liquid_in_box({-1, -1, -1}, {2, 1, 0.54}) +
                    driven_shell(1, speed, "2,4,2,1\n0,0,0.1,0,0.3,0,0,0.5", true) +
                    testing::shell_patch(20, first, {0.25, 0, 0.2}, {0, cell, 0}, {0, 0, width}, 1, 10) +
                    testing::closed(end));
    const BoxFluid& fluid = run.term<EulerianFluid>().box();
    const double before = fluid.total_mass(0), volume = testing::liquid_volume(fluid);
    std::vector<const FluidCoupling*> sides;
    for (const auto& term : run.scene().terms)
        if (const auto* coupling = dynamic_cast<const FluidCoupling*>(term.get())) sides.push_back(coupling);
    ASSERT_EQ(sides.size(), 2u);
    double drag = 0;
    run.run([&](const Clock& clock, const State&) {
        if (clock.time > 0.5 * end)
            drag -= (sides[0]->force().x + sides[1]->force().x) * clock.step / (0.5 * end);
    });
    const double stagnation = 0.5 * 1000 * speed * speed * width * cell;
    EXPECT_GT(drag, 0.5 * stagnation);
    EXPECT_LT(drag, 5 * stagnation);
    EXPECT_NEAR(fluid.total_mass(0), before, 1e-12 * before);
    EXPECT_NEAR(testing::liquid_volume(fluid), volume, 0.02 * volume);
    EXPECT_LT(run.scene().ledger.balance_error(), 0.01);
}

} // namespace plash
