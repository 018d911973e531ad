#include "core/energy_ledger.h"
#include "elements/shell_settings.h"
#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "tests/support/bare_state.h"
#include "tests/support/each_cycle.h"
#include "tests/support/history.h"
#include "tests/support/shell_model.h"
#include "tests/support/thick_block.h"

#include <gtest/gtest.h>

#include <numbers>

namespace plash {

namespace {

using testing::make_thick;
using testing::record_of;
using testing::SolidBlock;
using testing::thick_section;
using testing::ThickStep;

constexpr double thick_modulus = 1e6, thick_poisson = 0.25;

Record thick_elastic(double density = 1)
{
    return record_of("MAT_ELASTIC", 1, {{"RO", density}, {"E", thick_modulus}, {"PR", thick_poisson}});
}

/// The five-element patch of MacNeal & Harder (1985), Finite Elements in Analysis and Design 1, 3-20: 0.24 x
/// 0.12, E = 1e6, nu = 0.25; here with a thickness of 0.01 (0.001 for shells). Nodes 0-7 below, 8-15 above;
/// 4-7 and 12-15 are inside.
Model thick_patch(int formulation)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1}, thick_elastic());
    Model model = block.model;
    model.nodes = {};
    model.solids = {};
    for (double z : {-0.005, 0.005}) {
        for (const Vec3& place :
             {Vec3{0, 0, z}, Vec3{0.24, 0, z}, Vec3{0.24, 0.12, z}, Vec3{0, 0.12, z}, Vec3{0.04, 0.02, z},
              Vec3{0.18, 0.03, z}, Vec3{0.16, 0.08, z}, Vec3{0.08, 0.08, z}}) {
            model.nodes.id.push_back(static_cast<Id>(model.nodes.size()) + 1);
            model.nodes.position.push_back(place);
        }
    }
    for (const std::array<Index, 4>& n :
         {std::array<Index, 4>{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}) {
        model.solids.id.push_back(static_cast<Id>(model.solids.size()) + 1);
        model.solids.part.push_back(0);
        model.solids.nodes.push_back({n[0], n[1], n[2], n[3], n[0] + 8, n[1] + 8, n[2] + 8, n[3] + 8});
    }
    make_thick(model, thick_section(formulation, 3, true));
    return model;
}

bool has_solid_stress(int formulation)
{
    return formulation == 3 || formulation == 5 || formulation == 7;
}

double largest_inner_force(const ThickStep& step)
{
    double largest = 0;
    for (int node : {4, 5, 6, 7, 12, 13, 14, 15}) largest = std::max(largest, norm(step.state.force[node]));
    return largest;
}

} // namespace

class ThickShellPatch : public ::testing::TestWithParam<int> {};

TEST_P(ThickShellPatch, Membrane)
{
    // Exact: 1333.33 in both directions and 400 in shear (MacNeal & Harder). Solids thin by Poisson's ratio.
    const Model model = thick_patch(GetParam());
    const double thinning = has_solid_stress(GetParam()) ? -thick_poisson / (1 - thick_poisson) * 2e-3 : 0;
    const ThickStep step(model, 3, [&](const Vec3& x) {
        return Vec3{1e-3 * (x.x + x.y / 2), 1e-3 * (x.y + x.x / 2), thinning * x.z};
    });
    for (const auto& stress : step.results.thick_shell_stress) {
        EXPECT_NEAR(stress.xx, 4000.0 / 3, 1.5); // the step is finite: 1e-3
        EXPECT_NEAR(stress.yy, 4000.0 / 3, 1.5);
        EXPECT_NEAR(stress.xy, 400, 1.5);
        EXPECT_NEAR(stress.zz, 0, 1.5);
    }
    // Forces along the edges are 1333 x 0.1 x 0.01.
    EXPECT_LT(largest_inner_force(step), 1e-3 * 1.3);
}

TEST_P(ThickShellPatch, BendingAndTwist)
{
    // w = 1e-3 (x^2 + x y + y^2) / 2: stresses at the faces are E / (1 - nu^2) z (1 + nu) 1e-3 and shear E /
    // (1
    // + nu) z 0.5e-3; 0.667 and 0.2 at z = 0.0005 as printed for the thin patch.
    const Model model = thick_patch(GetParam());
    const double scale = 1e-3; // small: linear
    const ThickStep step(model, 3, [&](const Vec3& x) {
        const double slope_x = 1e-3 * (x.x + x.y / 2), slope_y = 1e-3 * (x.y + x.x / 2);
        const double w = 0.5e-3 * (x.x * x.x + x.x * x.y + x.y * x.y);
        return Vec3{-scale * x.z * slope_x, -scale * x.z * slope_y, scale * w};
    });
    for (std::size_t i = 0; i < step.results.thick_shell_stress.size(); ++i) {
        const double z = std::array{0.0, -0.005, 0.005}[i % 3] * scale; // middle, below, above
        const auto& stress = step.results.thick_shell_stress[i];
        EXPECT_NEAR(stress.xx, -0.667 * z / 0.0005, 0.667 * 0.01 * 1e-3) << i;
        EXPECT_NEAR(stress.yy, -0.667 * z / 0.0005, 0.667 * 0.01 * 1e-3) << i;
        EXPECT_NEAR(stress.xy, -0.2 * z / 0.0005, 0.2 * 0.01 * 1e-3) << i;
        for (double other : {stress.zz, stress.yz, stress.zx}) EXPECT_NEAR(other, 0, 1e-5) << i;
    }
    // A moment of 6.7e-3 x 0.01^2 / 6 an edge length of 0.1 over the thickness gives 1e-6 a node.
    EXPECT_LT(largest_inner_force(step), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Formulations, ThickShellPatch, ::testing::Values(1, 2, 3, 5));

namespace {

/// First frequency of a simply supported square plate of n x n thick shells, over that of Kirchhoff's plate,
/// f = pi / a^2 sqrt(D / (rho t)).
double relative_thick_frequency(int formulation, int points, int n, double thickness, double waviness = 0)
{
    const double side = 100, density = 1e-6;
    SolidBlock block({n, n, 1}, {side, side, thickness}, thick_elastic(density));
    Model& model = block.model;
    if (waviness > 0) {
        for (Vec3& x : model.nodes.position) { // a plane distortion that leaves the edges
            const double bump = waviness * std::sin(2 * std::numbers::pi * x.x / side) *
                                std::sin(2 * std::numbers::pi * x.y / side);
            x.x += bump;
            x.y -= bump;
        }
    }
    std::vector<Index> edges, along_y, along_x;
    for (Index node = 0; node < static_cast<Index>(model.nodes.size()); ++node) {
        const Vec3& x = model.nodes.position[node];
        const bool on_x = x.x == 0 || x.x == side, on_y = x.y == 0 || x.y == side;
        if (on_x || on_y) edges.push_back(node);
        if (on_x) along_y.push_back(node);
        if (on_y) along_x.push_back(node);
    }
    hold(model, edges, 4);
    hold(model, along_y, 2);
    hold(model, along_x, 1);
    make_thick(model, thick_section(formulation, points));
    const double bending =
        thick_modulus * thickness * thickness * thickness / (12 * (1 - thick_poisson * thick_poisson));
    const double frequency = std::numbers::pi / (side * side) * std::sqrt(bending / (density * thickness));
    model.controls.time.end_time = 2.3 / frequency;
    model.controls.elements.linear_viscosity = 1e-10;
    model.controls.elements.quadratic_viscosity = 1e-10;
    Scene scene = make_scene(model);
    const double k = std::numbers::pi / side, size = 1;
    for (std::size_t node = 0; node < scene.state.size(); ++node) {
        const Vec3& x = model.nodes.position[node];
        const double z = x.z - 0.5 * thickness;
        scene.state.velocity[node] = {size * z * k * std::cos(k * x.x) * std::sin(k * x.y),
                                      size * z * k * std::sin(k * x.x) * std::cos(k * x.y),
                                      -size * std::sin(k * x.x) * std::sin(k * x.y)};
    }
    std::vector<double> time, middle;
    const Index centre = block.node(n / 2, n / 2, 0);
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        time.push_back(clock.time);
        middle.push_back(state.position[centre].z);
    }));
    const Outcome outcome = run(scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_LT(scene.ledger.balance_error(), 1e-4);
    return 1 / (period_of(time, middle) * frequency);
}

} // namespace

class ThickShellPlate : public ::testing::TestWithParam<int> {};

TEST_P(ThickShellPlate, VibratesAsMindlinsPlate)
{
    // Mindlin's corrections at t / a = 0.05 are small: shear, and rotary inertia, which is t^2 / 4 for masses
    // that stand on the faces.
    const double t = 5, side = 100, nu = thick_poisson;
    const double k2 = 2 * std::pow(std::numbers::pi / side, 2);
    const double shear = 5.0 / 6 / (2 * (1 + nu)), d = 1 / (12 * (1 - nu * nu));
    const double mindlin = 1 / std::sqrt(1 + k2 * t * t * (d / shear + 1.0 / 4));
    const double coarse = relative_thick_frequency(GetParam(), 2, 8, t) / mindlin;
    const double fine = relative_thick_frequency(GetParam(), 2, 16, t) / mindlin;
    EXPECT_NEAR(coarse, 1, 0.015);
    EXPECT_NEAR(fine, 1, 0.004);
    EXPECT_NEAR((coarse - 1) / (fine - 1), 4, 0.5); // second order in the mesh
}

TEST_P(ThickShellPlate, LayersDoNotChangeElasticBending)
{
    const double two = relative_thick_frequency(GetParam(), 2, 8, 5);
    EXPECT_NEAR(relative_thick_frequency(GetParam(), 5, 8, 5), two, 1e-3 * two);
}

TEST_P(ThickShellPlate, BearsDistortedMeshes)
{
    const double regular = relative_thick_frequency(GetParam(), 2, 16, 5);
    EXPECT_NEAR(relative_thick_frequency(GetParam(), 2, 16, 5, 3), regular, 2e-3 * regular);
}

INSTANTIATE_TEST_SUITE_P(Formulations, ThickShellPlate, ::testing::Values(1, 2, 3, 5));

namespace {

/// Walks a mesh of thick shells through given motions, without inertia.
struct ThickWalk {
    const Model& model;
    State state;
    std::vector<std::unique_ptr<SolidGroup>> groups;
    Clock clock;

    explicit ThickWalk(const Model& its_model) : model(its_model)
    {
        state = bare_state(model);
        groups = make_thick_shell_groups(model, state);
        clock.last_step = 1;
    }
    void to(const std::function<Vec3(std::size_t)>& place)
    {
        for (std::size_t node = 0; node < state.size(); ++node) {
            state.velocity[node] = place(node) - state.position[node];
            state.position[node] = place(node);
        }
        state.clear_forces();
        for (auto& group : groups) group->add_forces(clock, state);
        ++clock.cycle;
    }
    ElementResults results(int layers) const
    {
        ElementResults results;
        results.thick_shell_layers = layers;
        results.thick_shell_stress.resize(layers * model.thick_shells.size());
        results.thick_shell_plastic_strain.resize(layers * model.thick_shells.size());
        for (const auto& group : groups) group->collect(state, results);
        return results;
    }
    double internal_energy() const
    {
        EnergyLedger ledger;
        ledger.part_internal.resize(model.parts.size());
        ledger.part_hourglass.resize(model.parts.size());
        for (const auto& group : groups) group->report(ledger);
        return ledger.internal;
    }
};

} // namespace

class ThickShellElement : public ::testing::TestWithParam<int> {};

TEST_P(ThickShellElement, StressTurnsWithTheElementOnceAround)
{
    SolidBlock block({1, 1, 1}, {2, 1, 0.3}, thick_elastic());
    block.set_viscosity(1e-12, 1e-12);
    block.set_hourglass(4); // forces that stay
    make_thick(block.model, thick_section(GetParam(), 3));
    ThickWalk walk(block.model);
    // Stretched, bent and sheared first.
    const auto strained = [&](std::size_t node) {
        const Vec3& x = block.model.nodes.position[node];
        return x + 1e-4 * Vec3{x.x + 3 * x.x * (x.z - 0.15) + x.z, x.y * x.x, 2 * x.z - 1.5 * x.x * x.x};
    };
    walk.to(strained);
    const State before = walk.state;
    const double energy = walk.internal_energy();
    const auto first = walk.results(3).thick_shell_stress;
    constexpr int steps = 180; // of two degrees
    for (int step = 1; step <= steps; ++step) {
        const double angle = 2 * std::numbers::pi * step / steps;
        const Vec3 axis = (std::tan(angle / 4) / 3.0) * Vec3{1, 2, 2};
        const Tensor3<double> half = incremental_rotation(axis);
        walk.to([&](std::size_t node) { return half * (half * before.position[node]); });
    }
    const auto last = walk.results(3).thick_shell_stress;
    double scale = 0;
    for (const auto& s : first) scale = std::max(scale, von_mises_stress(s));
    for (std::size_t i = 0; i < first.size(); ++i) {
        const SymmetricTensor<double> d = last[i] - first[i];
        EXPECT_LT(std::sqrt(contract(d, d)), 1e-9 * scale);
    }
    for (std::size_t node = 0; node < walk.state.size(); ++node)
        EXPECT_LT(norm(walk.state.force[node] - before.force[node]), 1e-9 * norm(before.force[0]));
    EXPECT_NEAR(walk.internal_energy(), energy, 1e-9 * energy);
}

TEST_P(ThickShellElement, CarriesThePlasticMomentOfItsLayers)
{
    // Bent along x and held along y, a perfectly plastic plate bears sigma_y 2 / sqrt 3 in every layer, and
    // the moment that the points see: sum of weight and place. With stresses of solids the normal stress has
    // to vanish although plastic flow is incompressible.
    constexpr double yield = 1000, thickness = 0.3, width = 1;
    SolidBlock block(
        {1, 1, 1}, {1, width, thickness},
        record_of("MAT_PLASTIC_KINEMATIC", 1,
                  {{"RO", 1}, {"E", thick_modulus}, {"PR", thick_poisson}, {"SIGY", yield}, {"BETA", 1}}));
    block.set_viscosity(1e-12, 1e-12);
    make_thick(block.model, thick_section(GetParam(), 5));
    ThickWalk walk(block.model);
    // Forty times the curvature at which the face yields, in steps of a hundredth of that.
    const double first_yield = yield / thick_modulus / (0.5 * thickness);
    for (int step = 1; step <= 4000; ++step) {
        const double curvature = 0.01 * step * first_yield;
        // Fibres turn and the mid-surface keeps its length; the thickness is kept along the normal.
        walk.to([&](std::size_t node) {
            const Vec3& x = block.model.nodes.position[node];
            const double z = x.z - 0.5 * thickness, angle = curvature * (x.x - 0.5);
            return Vec3{x.x - z * std::tan(angle), x.y, z};
        });
    }
    double moment = 0; // of the forces at x = 1 about their fibres' middle
    for (std::size_t node = 0; node < walk.state.size(); ++node) {
        if (block.model.nodes.position[node].x < 0.5) continue;
        const Vec3 &x = walk.state.position[node], &force = walk.state.force[node];
        moment += (x.x - 1) * force.z - x.z * force.x;
    }
    const ThicknessRule rule = gauss_rule(5);
    double lever = 0;
    for (int i = 0; i < rule.size(); ++i) lever += rule.weight[i] * std::abs(rule.place[i]);
    const double exact = 2 / std::sqrt(3.0) * yield * width * thickness * 0.5 * thickness * lever;
    EXPECT_NEAR(std::abs(moment), exact, 0.02 * exact);
    if (has_solid_stress(GetParam())) {
        for (const auto& s : walk.results(5).thick_shell_stress) EXPECT_NEAR(s.zz, 0, 0.02 * yield);
    }
}

INSTANTIATE_TEST_SUITE_P(Formulations, ThickShellElement, ::testing::Values(1, 2, 3, 5));

TEST(ThickShellLayers, ASoftLayerTakesTheStrainOfAStack)
{
    // Three plies in series, E = 1e6, 1e4 and 1e6 without lateral strain: pressed by a hundredth.
    SolidBlock block({1, 1, 1}, {1, 1, 0.3}, record_of("MAT_ELASTIC", 1, {{"RO", 1}, {"E", 1e6}, {"PR", 0}}));
    Model& model = block.model;
    model.materials.push_back(record_of("MAT_ELASTIC", 2, {{"RO", 1}, {"E", 1e4}, {"PR", 0}}));
    block.set_viscosity(1e-12, 1e-12);
    make_thick(model, thick_section(5, 2));
    model.parts[0].layers = {{0, 1, 0}, {1, 1, 0}, {0, 1, 0}};
    ThickWalk walk(model);
    for (int step = 1; step <= 20; ++step) {
        walk.to([&](std::size_t node) {
            Vec3 x = model.nodes.position[node];
            x.z *= 1 - 1e-5 * step;
            return x;
        });
    }
    const double series = 1 / (2.0 / 3 / 1e6 + 1.0 / 3 / 1e4);
    for (const auto& s : walk.results(3).thick_shell_stress)
        EXPECT_NEAR(s.zz, -series * 2e-4, 1e-3 * series * 2e-4);
}

} // namespace plash
