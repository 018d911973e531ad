// Control volumes against answers that are known in closed form.

#include "conditions/airbags.h"
#include "core/run_error.h"
#include "tests/support/each_cycle.h"
#include "tests/support/point_masses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plash {

namespace {

using testing::add_constant;
using testing::point_masses;

/// Masses that do not ask for a step.
constexpr double heavy = 1e9;

/// A cube of side 2 h about the origin: eight masses and its six faces.
Model cube_of_masses(double h, double mass, double end_time, int cycles)
{
    Model model = point_masses(
        {{-h, -h, -h}, {h, -h, -h}, {h, h, -h}, {-h, h, -h}, {-h, -h, h}, {h, -h, h}, {h, h, h}, {-h, h, h}},
        mass, end_time, cycles);
    Airbag bag;
    bag.id = 1;
    bag.segments = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    model.airbags.push_back(bag);
    return model;
}

void hold_still(Model& model)
{
    FixedNodes fixed;
    for (std::size_t n = 0; n < model.nodes.size(); ++n) fixed.nodes.push_back(static_cast<Index>(n));
    fixed.freedoms = 7;
    model.fixed_nodes.push_back(fixed);
}

ElementResults::AirbagState bag_at_end(const Scene& scene)
{
    ElementResults results;
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    return results.airbags.at(0);
}

/// Times at which the first coordinate of node 6 passes its start on the way out.
class Crossings {
public:
    explicit Crossings(double level) : level_(level) {}
    void look(double time, double value)
    {
        if (last_ < level_ && value >= level_)
            times.push_back(time - (value - level_) / (value - last_) * (time - last_time_));
        last_ = value;
        last_time_ = time;
    }
    std::vector<double> times;

private:
    double level_, last_ = 1e300, last_time_ = 0;
};

/// Period of small breathing of a cube, and the balance error of the run.
std::pair<double, double> breathing(Model model, double h, double stretch)
{
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
        testing::set_velocity(model, static_cast<Index>(n), stretch * model.nodes.position[n]);
    Crossings crossings(h);
    const Scene scene =
        testing::run_to_end(model, std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
                                crossings.look(clock.time + clock.step, state.position[6].x);
                            }));
    if (crossings.times.size() < 3) return {0, 1};
    const double periods = static_cast<double>(crossings.times.size()) - 1;
    return {(crossings.times.back() - crossings.times.front()) / periods, scene.ledger.balance_error()};
}

VentedGas air()
{
    VentedGas gas;
    gas.heat_at_constant_volume = 717.5;
    gas.heat_at_constant_pressure = 1004.5;
    gas.ambient_pressure = 1e5;
    gas.density = 1.2;
    return gas;
}

} // namespace

// For x = (1 + e) x0 the change of volume is 3 e V, a corner bears a quarter of three faces, and
// m h e'' = -(stiffness of the content) 3 e h^2: omega^2 = 3 K h / m.
TEST(Airbags, GasBreathesAtItsFrequency)
{
    constexpr double h = 0.5, mass = 2, gamma = 1.4, pressure = 1e5;
    const double expected = 2 * std::numbers::pi / std::sqrt(3 * gamma * pressure * h / mass);
    Model model = cube_of_masses(h, mass, 10 * expected, 2000);
    AdiabaticGas gas;
    gas.ratio_of_specific_heats = gamma;
    gas.ambient_pressure = pressure;
    gas.density = 1.2;
    model.airbags[0].content = gas;
    const auto [period, error] = breathing(model, h, 0.01 / expected);
    // Second order in the amplitude, 1.6e-3, and in the step, 1e-5 of a squared frequency.
    EXPECT_NEAR(period, expected, 1e-4 * expected);
    EXPECT_LT(error, 1e-4);
}

TEST(Airbags, VentedGasThatIsShutIsAdiabatic)
{
    constexpr double h = 0.5, mass = 2;
    const double expected = 2 * std::numbers::pi / std::sqrt(3 * 1.4 * 1e5 * h / mass);
    Model model = cube_of_masses(h, mass, 10 * expected, 2000);
    model.airbags[0].content = air();
    const auto [period, error] = breathing(model, h, 0.01 / expected);
    EXPECT_NEAR(period, expected, 1e-4 * expected);
    EXPECT_LT(error, 1e-4);
}

TEST(Airbags, FluidBreathesAtItsFrequencyAndAsksForTheStep)
{
    constexpr double h = 0.05, mass = 0.125, bulk = 2e9;
    const double frequency = std::sqrt(3 * bulk * h / mass), expected = 2 * std::numbers::pi / frequency;
    Model model = cube_of_masses(h, mass, 10 * expected, 1); // steps as the airbag asks for
    model.controls.time.step_scale = 0.05;
    LinearFluid fluid;
    fluid.bulk_modulus = bulk;
    fluid.density = 1000;
    model.airbags[0].content = fluid;
    const auto [period, error] = breathing(model, h, 1e-6 * frequency);
    EXPECT_NEAR(period, expected, 1e-3 * expected);
    EXPECT_LT(error, 1e-3);

    Scene scene = make_scene(model);
    for (const auto& term : scene.terms) {
        term->add_forces(Clock{}, scene.state);
        if (term->name() == "airbags") {
            EXPECT_NEAR(term->stable_step().step, 2 / frequency, 1e-9 / frequency);
        }
    }
}

TEST(Airbags, RelativeVolumeGivesThePressure)
{
    Model model = cube_of_masses(0.5, 1, 1e-3, 2);
    PressureOfVolume law;
    law.coefficient = 150;
    law.scale = 2;
    model.airbags[0].content = law;
    model.airbags[0].volume_scale = 3;
    Scene scene = make_scene(model);
    for (Vec3& x : scene.state.position) x *= 1.1;
    for (const auto& term : scene.terms) term->add_forces(Clock{}, scene.state);
    const double pressure = 2 * 150 / std::pow(1.1, 3);
    EXPECT_NEAR(bag_at_end(scene).pressure, pressure, 1e-12 * pressure);
    EXPECT_NEAR(bag_at_end(scene).volume, 3 * std::pow(1.1, 3), 1e-12);
    // A corner bears a quarter of three faces, outwards.
    EXPECT_NEAR(scene.state.force[6].x, pressure * 1.21 / 4, 1e-12 * pressure);
    EXPECT_NEAR(scene.state.force[0].z, -pressure * 1.21 / 4, 1e-12 * pressure);
}

// dE/dt = c_p T dm/dt in a rigid bag: pressure rises by (gamma - 1) c_p T m / V, linearly.
TEST(Airbags, InflowRaisesThePressureByItsEnthalpy)
{
    Model model = cube_of_masses(0.5, 1, 0.02, 50);
    VentedGas gas = air();
    gas.inflow_curve = add_constant(model, 3);
    gas.inflow_temperature = 800;
    model.airbags[0].content = gas;
    hold_still(model);
    const Scene scene = testing::run_to_end(model);
    const auto bag = bag_at_end(scene);
    const double mass = 3 * 0.02, heat = 1004.5 * 800 * mass;
    EXPECT_NEAR(bag.mass, 1.2 + mass, 1e-9);
    EXPECT_NEAR(bag.pressure, 0.4 * heat, 1e-6 * heat);
    EXPECT_NEAR(bag.temperature, (1e5 / 0.4 + heat) / (717.5 * (1.2 + mass)), 1e-3);
}

// A tank that empties through a choked nozzle (Shapiro 1953, ch. 4): with a0 the speed of sound at the start
// p / p0 = (1 + (gamma - 1) / 2 ((gamma + 1) / 2)^(-(gamma + 1) / (2 (gamma - 1))) C A a0 t / V)
//          ^(-2 gamma / (gamma - 1)).
TEST(Airbags, ChokedHolesEmptyATankAsKnown)
{
    constexpr double end = 0.3, start = 12e5, area = 0.01, coefficient = 0.7;
    double errors[2];
    for (const int cycles : {50, 100}) {
        Model model = cube_of_masses(0.5, heavy, end, cycles);
        VentedGas gas = air();
        gas.density = 12;
        gas.overpressure = start - 1e5;
        gas.orifices = {{coefficient, none, false, area, none}};
        model.airbags[0].content = gas;
        hold_still(model);
        const double sound = std::sqrt(1.4 * start / 12);
        const double rate = 0.2 * std::pow(1.2, -3.0) * coefficient * area * sound;
        const double expected = start * std::pow(1 + rate * end, -7.0);
        ASSERT_GT(expected, 1e5 / 0.528); // choked to the end
        errors[cycles / 100] = (bag_at_end(testing::run_to_end(model)).pressure + 1e5) / expected - 1;
    }
    EXPECT_LT(std::abs(errors[1]), 1e-4);
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.4); // second order
}

// Below the critical pressure ratio the flow is isentropic to the ambient pressure; with 1.1 of it the exit
// temperature is T / 1.1^(2/7) and the speed sqrt(2 c_p (T - T_exit)).
TEST(Airbags, SlowHolesFlowIsentropically)
{
    const VentedGas gas = air();
    const double temperature = 300, exit = temperature * std::pow(1.1, -2.0 / 7);
    const double speed = std::sqrt(2 * 1004.5 * (temperature - exit)), density = 1e5 / (287 * exit);
    EXPECT_NEAR(orifice_flow(gas, 1.1e5, temperature), density * speed, 1e-12 * density * speed);
    EXPECT_EQ(orifice_flow(gas, 1e5, temperature), 0);
}

TEST(Airbags, NothingLeavesBeforeTheOpeningPressure)
{
    for (const double opening : {0.9e5, 1.1e5}) {
        Model model = cube_of_masses(0.5, 1, 0.01, 20);
        VentedGas gas = air();
        gas.overpressure = 1e5;
        gas.opening_pressure = opening;
        gas.orifices = {{1, none, false, 0.01, none}};
        model.airbags[0].content = gas;
        hold_still(model);
        const auto bag = bag_at_end(testing::run_to_end(model));
        if (opening < 1e5)
            EXPECT_LT(bag.mass, 1.19);
        else
            EXPECT_EQ(bag.mass, 1.2);
    }
}

TEST(Airbags, PouredFluidGivesItsPressure)
{
    Model model = cube_of_masses(0.5, heavy, 0.02, 50);
    LinearFluid fluid;
    fluid.bulk_modulus = 2e9;
    fluid.density = 1000;
    fluid.inflow_curve = add_constant(model, 50);
    fluid.outflow_curve = add_constant(model, 20);
    fluid.largest_pressure = 1e6;
    model.airbags[0].content = fluid;
    hold_still(model);
    EXPECT_NEAR(bag_at_end(testing::run_to_end(model)).pressure, 1e6, 1e-6);
    std::get<LinearFluid>(model.airbags[0].content).largest_pressure = 1e9;
    const double expected = 2e9 * std::log(1 + 30 * 0.02 / 1000);
    EXPECT_NEAR(bag_at_end(testing::run_to_end(model)).pressure, expected, 1e-9 * expected);
}

TEST(Airbags, AFlatBagIsRefused)
{
    Model model = cube_of_masses(0.5, 1, 0.02, 50);
    for (Vec3& x : model.nodes.position) x.z = 0;
    model.airbags[0].content = air();
    EXPECT_THROW(make_scene(model), RunError);
}

} // namespace plash
