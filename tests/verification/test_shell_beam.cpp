#include "elements/shell_groups.h"
#include "solver/explicit_loop.h"
#include "tests/paths.h"
#include "tests/support/history.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <numbers>
#include <numeric>

namespace plash {

namespace {

constexpr FreedomMask clamped = 63;

/// A strip along x, clamped at x = 0: `count` elements of its length by one of its width.
Model strip(double length, double width, double thickness, int count, double density, double young_modulus,
            double poisson_ratio)
{
    Model model = shell_model(
        make_record("MAT_ELASTIC", {{"RO", density}, {"E", young_modulus}, {"PR", poisson_ratio}}),
        {{"ELFORM", 2}, {"NIP", 2}, {"SHRF", 5.0 / 6}, {"T1", thickness}});
    add_grid(model, count, 1, [&](int i, int j) { return Vec3{length * i / count, width * j, 0}; });
    hold(model, {0, static_cast<Index>(count + 1)}, clamped);
    return model;
}

} // namespace

TEST(ShellCantilever, FirstFrequencyIsThatOfTheBeam)
{
    const double length = 100, width = 5, thickness = 2, density = 7.8e-6, young_modulus = 210;
    Model model = strip(length, width, thickness, 20, density, young_modulus, 0);
    // First mode of Euler & Bernoulli: cos(b) cosh(b) = -1, b = 1.8751; omega = b^2 sqrt(E I / (rho A L^4)).
    const double b = 1.87510406871196;
    const double omega =
        b * b * std::sqrt(young_modulus * thickness * thickness / (12 * density)) / (length * length);
    model.controls.time.end_time = 2.2 * 2 * std::numbers::pi / omega;
    Scene scene = make_scene(model);
    // Starts with velocities in the shape of the mode, so that other modes stay small.
    const double sigma = (std::sinh(b) - std::sin(b)) / (std::cosh(b) + std::cos(b));
    for (std::size_t node = 0; node < scene.state.size(); ++node) {
        const double s = b * model.nodes.position[node].x / length;
        const double shape = std::cosh(s) - std::cos(s) - sigma * (std::sinh(s) - std::sin(s));
        const double slope = (std::sinh(s) + std::sin(s) - sigma * (std::cosh(s) - std::cos(s))) * b / length;
        scene.state.velocity[node].z = -1e-3 * shape;
        scene.state.angular_velocity[node].y = 1e-3 * slope;
    }
    std::vector<double> time, tip;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        time.push_back(clock.time);
        tip.push_back(state.position[20].z);
    }));
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    // Rotary inertia (A / 8 at the nodes) and shear lower it by 0.2 %, the mesh raises it by less than 0.1 %.
    EXPECT_NEAR(period_of(time, tip), 2 * std::numbers::pi / omega, 0.005 * 2 * std::numbers::pi / omega);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

namespace {

/// Static tip displacement over the length of a clamped strip of `count` elements under a tip force of
/// alpha E I / L^2, reached with damping.
Vec3 elastica_tip(double alpha, int count)
{
    const double length = 10, width = 0.5, thickness = 0.1, young_modulus = 1.2e6, density = 1;
    const double stiffness = young_modulus * width * std::pow(thickness, 3) / 12;
    Model model = strip(length, width, thickness, count, density, young_modulus, 0);
    // Bending in one plane: one element across resists bending sideways by hourglass control alone.
    std::vector<Index> nodes(model.nodes.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    hold(model, nodes, 2 + 8 + 32);
    const double load = alpha * stiffness / (length * length);
    model.nodal_loads.push_back({{count, 2 * count + 1}, {0, 0, 1}, false, none, load / 2, {}});
    const double first_period = 2 * std::numbers::pi * length * length / 3.516 /
                                std::sqrt(young_modulus * thickness * thickness / (12 * density));
    model.controls.time.end_time = 4 * first_period;
    Scene scene = make_scene(model);
    // Close to critical for the first mode: 2 omega.
    scene.terms.push_back(std::make_unique<MassDamping>(2 * 2 * std::numbers::pi / first_period));
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    return (1 / length) * (scene.state.position[count] - model.nodes.position[count]);
}

} // namespace

TEST(ShellCantilever, ConvergesToTheElastica)
{
    std::ifstream file(std::string(PLASH_SOURCE_DIR) + "/tests/support/elastica.json");
    ASSERT_TRUE(file);
    const nlohmann::json table = nlohmann::json::parse(file);
    for (const char* alpha : {"1", "5"}) {
        const double deflection = table.at(alpha).at("w_L"), shortening = table.at(alpha).at("u_L");
        const Vec3 coarse = elastica_tip(std::stod(alpha), 10), fine = elastica_tip(std::stod(alpha), 20);
        // Error of second order in the element length: 1.4e-4 measured at 20 elements.
        EXPECT_NEAR(fine.z, deflection, 2e-4) << alpha;
        EXPECT_NEAR(-fine.x, shortening, 3e-4) << alpha;
        EXPECT_GT(std::abs(-coarse.x - shortening), 3.5 * std::abs(-fine.x - shortening)) << alpha;
    }
}

TEST(ShellCantilever, BendsInItsPlaneWithOneFullyIntegratedElementAcross)
{
    // MacNeal & Harder (1985), straight cantilever: 6 x 0.2 x 0.1, E = 1e7, nu = 0.3, six elements, unit
    // force in the plane at the tip: 0.1081. Plane elements without modes of bending reach a tenth of it.
    Model model = strip(6, 0.2, 0.1, 6, 1e-3, 1e7, 0.3);
    model.sections[0] = make_record("SECTION_SHELL", {{"ELFORM", 16}, {"NIP", 2}, {"T1", 0.1}});
    std::vector<Index> nodes(model.nodes.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    hold(model, nodes, 4 + 8 + 16 + 32);
    model.nodal_loads.push_back({{6, 13}, {0, 1, 0}, false, none, 0.5, {}});
    const double period = 2 * std::numbers::pi / 3.516 * 36 * std::sqrt(12 * 1e-3 / (1e7 * 0.04));
    model.controls.time.end_time = 4 * period;
    Scene scene = make_scene(model);
    scene.terms.push_back(std::make_unique<MassDamping>(2 * 2 * std::numbers::pi / period));
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    const double tip = scene.state.position[6].y - model.nodes.position[6].y;
    // Pian & Sumihara's element gives 0.993 of it on this mesh.
    EXPECT_NEAR(tip / 0.1081, 0.993, 0.005);
}

} // namespace plash
