#include "elements/shell_groups.h"
#include "elements/shell_laminate.h"
#include "solver/explicit_loop.h"
#include "tests/support/bare_state.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace plash {

namespace {

/// A clamped strip along x of plies with EA = 100, EB = 10 and no lateral contraction.
Model strip(std::vector<Layer> layers, double formulation)
{
    const double length = 40, width = 2;
    const int count = 20;
    Record material = make_record("MAT_ORTHOTROPIC_ELASTIC", {{"RO", 1e-5},
                                                              {"EA", 100},
                                                              {"EB", 10},
                                                              {"PRBA", 0},
                                                              {"GAB", 5},
                                                              {"GBC", 5},
                                                              {"GCA", 5},
                                                              {"AOPT", 2},
                                                              {"A1", 1}});
    Model model = shell_model(std::move(material), {{"ELFORM", formulation}, {"NIP", 2}, {"T1", 1}});
    model.parts[0].layers = std::move(layers);
    add_grid(model, count, 1, [&](int i, int j) { return Vec3{length * i / count, width * j, 0}; });
    hold(model, {0, count + 1}, 63);
    std::vector<Index> all(model.nodes.size());
    std::iota(all.begin(), all.end(), 0);
    hold(model, all, 2 + 8 + 32); // bending in one plane
    return model;
}

} // namespace

TEST(ShellLaminate, ACrossPlyStripBendsUnderAxialForce)
{
    // Classical lamination theory with one point a ply: N = A e + B k, 0 = B e + D k.
    const std::vector<Layer> layers{{0, 0.3, 0}, {0, 0.2, 0}, {0, 0.25, 90}, {0, 0.25, 90}};
    double a = 0, b = 0, d = 0, z = -0.5;
    for (const Layer& layer : layers) {
        const double modulus = layer.angle == 0 ? 100 : 10, middle = z + 0.5 * layer.thickness;
        a += modulus * layer.thickness;
        b += modulus * layer.thickness * middle;
        d += modulus * layer.thickness * middle * middle;
        z += layer.thickness;
    }
    // So small that the turning of the strip shortens it by 4e-4 of the strain.
    const double force = 1e-5, width = 2, length = 40;
    const double strain = force / width / (a - b * b / d), curvature = -b / d * strain;
    for (double formulation : {2, 16}) {
        Model model = strip(layers, formulation);
        model.nodal_loads.push_back({{20, 41}, {1, 0, 0}, false, none, force / 2, {}});
        // The first mode's period of a strip with the bending stiffness D - B^2 / A.
        const double period =
            2 * std::numbers::pi * length * length / 3.516 * std::sqrt(1e-5 / (d - b * b / a));
        model.controls.time.end_time = 4 * period;
        Scene scene = make_scene(model);
        scene.terms.push_back(std::make_unique<MassDamping>(4 * std::numbers::pi / period));
        Recorders recorders;
        const Outcome outcome = run(scene, recorders);
        ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        const Vec3 tip = scene.state.position[20] - model.nodes.position[20];
        EXPECT_NEAR(tip.x, strain * length, 2e-3 * strain * length) << formulation;
        // w'' = -k_y in the shell's sign: the top fibre is longer for positive curvature, so the strip bends
        // down.
        EXPECT_NEAR(std::abs(tip.z), std::abs(curvature) * length * length / 2,
                    5e-3 * std::abs(curvature) * length * length / 2)
            << formulation;
    }
}

TEST(ShellLaminate, OwnPliesOfElementsCountBeforeThoseOfThePart)
{
    Model model = strip({{0, 1, 0}}, 2);
    // The second half of the elements has two plies of its own.
    model.shells.layers.resize(20);
    for (int i = 10; i < 20; ++i) model.shells.layers[i] = {{0, 0.5, 90}, {0, 1.0, 0}};
    Scene scene = make_scene(model);
    ElementResults results;
    results.shell_thickness.resize(20);
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    EXPECT_DOUBLE_EQ(results.shell_thickness[3], 1);
    EXPECT_DOUBLE_EQ(results.shell_thickness[13], 1.5);
    const double mass = std::accumulate(scene.state.mass.begin(), scene.state.mass.end(), 0.0);
    EXPECT_NEAR(mass, 1e-5 * (20 * 2 * 1 + 20 * 2 * 1.5), 1e-15);
}

/// *ELEMENT_SHELL_BETA and _MCID: an angle of the element goes before that of the material, a coordinate
/// system before AOPT.
TEST(ShellLaminate, AnglesAndSystemsOfElementsGoBeforeThoseOfTheMaterial)
{
    Model model = strip({{0, 0.5, 10}, {0, 0.5, 0}}, 2);
    model.materials[0].fields.push_back({"MANGLE", 30, "", true, false, {}});
    CoordinateSystem turned;
    turned.id = 1;
    turned.axes = {Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}};
    model.coordinate_systems.push_back(turned);
    model.shells.material_angle.resize(20);
    model.shells.material_angle[1] = 45;
    model.shells.material_system.assign(20, none);
    model.shells.material_system[2] = 0;
    const auto degrees = [&](Index element, int ply) {
        return plies_of(model, element)[ply].angle * 180 / std::numbers::pi;
    };
    EXPECT_NEAR(degrees(0, 0), 40, 1e-12);
    EXPECT_NEAR(degrees(0, 1), 30, 1e-12);
    EXPECT_NEAR(degrees(1, 0), 55, 1e-12);
    EXPECT_NEAR(degrees(2, 0), 90 + 30 + 10, 1e-12);
}

/// *ELEMENT_SHELL_OFFSET: half of the thickness along the normal is what NLOC = -1 of the section says, also
/// where elements of a part have offsets and thicknesses of their own.
TEST(ShellOffset, OfElementsIsThatOfTheSection)
{
    const auto tip = [](double nloc, bool own) {
        Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 1e-5}, {"E", 100}, {"PR", 0.3}}),
                                  {{"ELFORM", 2}, {"NIP", 3}, {"T1", 1}, {"NLOC", nloc}});
        add_grid(model, 8, 1, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
        hold(model, {0, 9}, 63);
        model.nodal_loads.push_back({{8, 17}, {1, 0, 0}, false, none, 1e-3, {}});
        model.controls.time.end_time = 0.2;
        if (own) {
            model.shells.offset.assign(8, 0.5);
            model.shells.thickness.assign(8, {});
            model.shells.thickness[3] = {2, 2, 2, 2};
            model.shells.offset[3] = 1;
        } else {
            model.shells.thickness.assign(8, {});
            model.shells.thickness[3] = {2, 2, 2, 2};
        }
        Scene scene = make_scene(model);
        Recorders recorders;
        const Outcome outcome = run(scene, recorders);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        return scene.state.position[8] - model.nodes.position[8];
    };
    const Vec3 section = tip(-1, false), element = tip(0, true), middle = tip(0, false);
    EXPECT_EQ(element.z, section.z);
    EXPECT_EQ(element.x, section.x);
    EXPECT_NEAR(middle.z, 0, 1e-15);
    EXPECT_GT(std::abs(element.z), 0.1 * element.x);
}

/// Plates with the nodes on a surface: stretching and bending are coupled, which with the rotary inertia of
/// area / 8 alone takes the frequency of thick ones beyond that of the step.
TEST(ShellOffset, OfThickPlatesIsStable)
{
    for (double formulation : {2, 16}) {
        for (double thickness : {0.3, 0.5, 1.0}) {
            Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 1e-5}, {"E", 100}, {"PR", 0.3}}),
                                      {{"ELFORM", formulation}, {"NIP", 3}, {"T1", thickness}, {"NLOC", 1}});
            add_grid(model, 2, 2, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
            for (Index node = 0; node < 9; ++node) {
                InitialVelocity start;
                start.nodes = {node};
                start.translation =
                    1e-4 * Vec3{std::sin(3.0 * node), std::sin(5.0 * node), std::sin(7.0 * node)};
                model.initial_velocities.push_back(start);
            }
            model.controls.time.end_time = 1;
            Scene scene = make_scene(model);
            Recorders recorders;
            const Outcome outcome = run(scene, recorders);
            EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
            EXPECT_LT(scene.ledger.balance_error(), 1e-4) << formulation << ' ' << thickness;
        }
    }
}

TEST(ShellMembrane, HasNoBendingStiffness)
{
    // ELFORM 5 and 9: an end moment meets no resistance; ELFORM 2 would bend to its static answer.
    for (double formulation : {5, 9}) {
        Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 1e-5}, {"E", 100}, {"PR", 0.3}}),
                                  {{"ELFORM", formulation}, {"NIP", 2}, {"T1", 1}});
        add_grid(model, 1, 1, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
        for (Index node : {0, 1, 2, 3}) hold(model, {node}, 7);
        model.controls.time.end_time = 1;
        Scene scene = make_scene(model);
        for (Index node : {0, 1, 2, 3}) scene.state.angular_velocity[node] = {0, node % 2 ? 0.1 : -0.1, 0};
        Recorders recorders;
        ASSERT_EQ(run(scene, recorders).termination, Outcome::Termination::normal);
        EXPECT_NEAR(scene.state.angular_velocity[1].y, 0.1, 1e-12) << formulation;
    }
}

TEST(ShellNull, OnlyAddsMass)
{
    Model model = shell_model(make_record("MAT_NULL", {{"RO", 3}}), {{"ELFORM", 2}, {"NIP", 2}, {"T1", 0.5}});
    add_grid(model, 1, 1, [](int i, int j) { return Vec3{2.0 * i, 1.0 * j, 0}; });
    Scene scene = make_scene(model);
    EXPECT_TRUE(scene.terms.empty());
    for (double mass : scene.state.mass) EXPECT_NEAR(mass, 3 * 2 * 0.5 / 4, 1e-15);
}

/// ISTUPD = 1 with orthotropic plies: the thickness follows PRCA sigma_a / EC.
TEST(ShellLaminate, PliesThinByTheirStress)
{
    for (const double formulation : {2, 16}) {
        Record material = make_record("MAT_ORTHOTROPIC_ELASTIC", {{"RO", 1},
                                                                  {"EA", 100},
                                                                  {"EB", 10},
                                                                  {"EC", 10},
                                                                  {"PRBA", 0},
                                                                  {"PRCA", 0.03},
                                                                  {"PRCB", 0.2},
                                                                  {"GAB", 5},
                                                                  {"GBC", 5},
                                                                  {"GCA", 5},
                                                                  {"AOPT", 2},
                                                                  {"A1", 1}});
        Model model = shell_model(std::move(material), {{"ELFORM", formulation}, {"NIP", 2}, {"T1", 1}});
        model.parts[0].layers = {{0, 0.5, 0}, {0, 0.5, 90}};
        model.controls.elements.thickness_change = 1;
        add_grid(model, 1, 1, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
        State state = bare_state(model);
        auto groups = make_shell_groups(model, state);
        Clock clock;
        clock.last_step = 1;
        for (int step = 0; step < 100; ++step) { // stretched along x by 1 %
            for (Index node : {1, 3}) {
                state.position[node].x += 1e-4;
                state.velocity[node].x = 1e-4;
            }
            groups[0]->add_forces(clock, state);
        }
        ElementResults results;
        results.shell_thickness.resize(1);
        results.shell_layers = 2;
        groups[0]->collect(state, results);
        // The ply along x has 100 e and thins by 0.003 times that, the one across 10 e and 0.02.
        const double strain = std::log(1.01), thinning = 0.5 * (0.003 * 100 + 0.02 * 10) * strain;
        EXPECT_NEAR(results.shell_thickness[0], std::exp(-thinning), 1e-7) << formulation;
    }
}

} // namespace plash
