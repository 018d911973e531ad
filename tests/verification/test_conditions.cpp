#include "conditions/segment_forces.h"
#include "tests/support/point_masses.h"
#include "tests/support/shell_model.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <numbers>

namespace plash {

namespace {

using testing::add_constant;
using testing::point_masses;
using testing::run_to_end;
using testing::set_velocity;

Record elastic(double density, double young, double poisson)
{
    return testing::record_of("MAT_ELASTIC", 1, {{"RO", density}, {"E", young}, {"PR", poisson}});
}

} // namespace

TEST(SegmentForces, IntegrateAWarpedQuadrilateralExactly)
{
    const std::vector<Vec3> place = {{0, 0, 0}, {2, 0.1, 0.3}, {2.2, 1.5, -0.2}, {-0.1, 1.2, 0.5}};
    const auto force = unit_pressure_forces({0, 1, 2, 3}, place);
    // 3 x 3 Gauss points integrate the integrand, of second order in each coordinate, exactly.
    const double points[] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weights[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    const double xi[] = {-1, 1, 1, -1}, eta[] = {-1, -1, 1, 1};
    Vec3 expected[4]{};
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            Vec3 along_xi{}, along_eta{};
            for (int i = 0; i < 4; ++i) {
                along_xi += 0.25 * xi[i] * (1 + eta[i] * points[b]) * place[i];
                along_eta += 0.25 * eta[i] * (1 + xi[i] * points[a]) * place[i];
            }
            const Vec3 normal = cross(along_xi, along_eta);
            for (int i = 0; i < 4; ++i) {
                const double shape = 0.25 * (1 + xi[i] * points[a]) * (1 + eta[i] * points[b]);
                expected[i] += weights[a] * weights[b] * shape * normal;
            }
        }
    }
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(norm(force[i] - expected[i]), 0, 1e-14) << i;
}

TEST(PressureLoads, AClosedSurfaceIsInBalance)
{
    testing::SolidBlock block({2, 2, 2}, {1, 1.2, 0.9}, elastic(1, 1e3, 0.3));
    block.distort(0.1);
    Model& model = block.model;
    for (Vec3& x : model.nodes.position) x += 0.05 * Vec3{x.y * x.z, x.x * x.z, x.x * x.y}; // no flat faces
    PressureLoad load;
    load.curve = add_constant(model, 7);
    const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (const auto& nodes : model.solids.nodes) {
        for (const auto& face : faces) { // inner faces come twice, from both sides
            load.segments.push_back({nodes[face[0]], nodes[face[1]], nodes[face[2]], nodes[face[3]]});
        }
    }
    model.pressure_loads.push_back(load);
    Scene scene = make_scene(model);
    for (auto& term : scene.terms)
        term->add_forces(Clock{}, scene.state); // without strain the solids add nothing
    Vec3 sum{}, moment{};
    double size = 0;
    for (std::size_t n = 0; n < scene.state.size(); ++n) {
        sum += scene.state.force[n];
        moment += cross(scene.state.position[n], scene.state.force[n]);
        size += norm(scene.state.force[n]);
    }
    ASSERT_GT(size, 10);
    EXPECT_LT(norm(sum), 1e-12 * size);
    EXPECT_LT(norm(moment), 1e-12 * size);
}

TEST(PressureLoads, AFreePlateFollowsNewtonAndItsArrivalTime)
{
    Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 2}, {"E", 1e4}, {"PR", 0.3}}),
                              {{"ELFORM", 2}, {"NIP", 2}, {"T1", 0.1}});
    add_grid(model, 4, 4, [](int i, int j) { return Vec3{0.5 * i, 0.5 * j, 0}; });
    PressureLoad load;
    load.curve = add_constant(model, 0.3);
    load.arrival = 0.05;
    load.segments = model.shells.nodes;
    model.pressure_loads.push_back(load);
    model.controls.time.end_time = 0.25;
    model.curves.push_back({9, "step", {}, Curve{{0, 1e9}, {1e-3, 1e-3}}});
    model.controls.time.largest_step_curve = static_cast<Index>(model.curves.size()) - 1;
    const Scene scene = run_to_end(model);
    Vec3 momentum{};
    for (std::size_t n = 0; n < scene.state.size(); ++n)
        momentum += scene.state.mass[n] * scene.state.velocity[n];
    // Against the normal, area 4, from the arrival to the end, each within a step.
    EXPECT_NEAR(momentum.z, -0.3 * 4 * 0.2, 0.3 * 4 * 0.002);
    EXPECT_NEAR(momentum.x, 0, 1e-9);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

TEST(BodyLoads, ASpinningRingHasItsHoopStress)
{
    // A polygon of chords L under the loads m w^2 R of its nodes pulls with T = rho A w^2 R^2 exactly, so
    // that R grows by rho w^2 R^3 / E to first order; the growth of R itself adds twice that share of 5e-4.
    constexpr int count = 48;
    constexpr double radius = 10, density = 1, young = 2e5, spin = 1;
    Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", density}, {"E", young}, {"PR", 0.0}}),
                              {{"ELFORM", 2}, {"NIP", 2}, {"T1", 0.1}});
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * i / count;
            add_node(model, {radius * std::cos(angle), radius * std::sin(angle), 1.0 * j});
        }
    }
    for (int i = 0; i < count; ++i) {
        const int next = (i + 1) % count;
        add_shell(model, {i, next, next + count, i + count});
    }
    BodyLoad load;
    load.kind = BodyLoad::Kind::centrifugal;
    load.direction = {0, 0, 1};
    load.curve = add_constant(model, spin);
    model.body_loads.push_back(load);
    NodeDamping damping; // critical for the breathing of the ring, w = sqrt(E / rho) / R = 44.7
    damping.rate = 2 * 44.7;
    model.dampings.push_back(damping);
    model.controls.time.end_time = 0.4;
    const Scene scene = run_to_end(model);
    double grown = 0;
    for (int i = 0; i < count; ++i)
        grown += std::hypot(scene.state.position[i].x, scene.state.position[i].y) - radius;
    const double expected = density * spin * spin * radius * radius * radius / young;
    EXPECT_NEAR(grown / count, expected, 2e-3 * expected);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

TEST(BodyLoads, AFreeMassGoesStraightInARotatingFrame)
{
    const double spin = 0.5, end = 2;
    Model model = point_masses({{1, 0, 0}}, 3.0, end, 32768);
    BodyLoad load;
    load.direction = {0, 0, 1};
    load.curve = add_constant(model, spin);
    load.kind = BodyLoad::Kind::centrifugal;
    model.body_loads.push_back(load);
    load.kind = BodyLoad::Kind::coriolis;
    model.body_loads.push_back(load);
    set_velocity(model, 0, {0, -spin * 1.0, 0}); // at rest in the frame that stands
    const Scene scene = run_to_end(model);
    const Vec3& x = scene.state.position[0];
    // It stays at (1, 0) there, which the frame sees turn backwards. Coriolis takes the velocity half a step
    // late: 2 w h / 2 = 1e-4 of its force.
    EXPECT_NEAR(x.x, std::cos(spin * end), 2e-4);
    EXPECT_NEAR(x.y, -std::sin(spin * end), 2e-4);
}

TEST(Damping, AnOscillatorDecaysByItsDecrement)
{
    // One element without Poisson's ratio, held at one face: omega^2 = 2 E / (rho L^2), damped as exp(-D t /
    // 2).
    testing::SolidBlock block({1, 1, 1}, {1, 1, 1}, elastic(1, 50, 0));
    Model& model = block.model;
    block.set_viscosity(0, 1e-20); // zero would mean the default
    for (Index n : {0, 2, 4, 6}) {
        hold(model, {n}, 7);
        hold(model, {static_cast<Index>(n + 1)}, 6);
    }
    block.set_velocity([](const Vec3& x) { return Vec3{1e-5 * x.x, 0, 0}; });
    const double rate = 0.4;
    NodeDamping damping;
    damping.rate = rate;
    model.dampings.push_back(damping);
    model.controls.time.end_time = 6.5;
    model.curves.push_back({1, "step", {}, Curve{{0, 1e9}, {0.01, 0.01}}});
    model.controls.time.largest_step_curve = 0;
    std::vector<double> peaks, times;
    double last = 1;
    const auto scene =
        run_to_end(model, std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
                       const double v = state.velocity[1].x;
                       // Where the velocity changes its sign, from the parabola of the place.
                       if (last > 0 && v <= 0) {
                           const double x = state.position[1].x - 1;
                           peaks.push_back(x + 0.01 * (last + v) * (last + v) / (8 * (last - v)));
                           times.push_back(clock.time + 0.01 * (last / (last - v) - 0.5));
                       }
                       last = v;
                   }));
    ASSERT_GE(peaks.size(), 9u);
    const double decrement = std::log(peaks.front() / peaks.back());
    const double elapsed = times.back() - times.front();
    EXPECT_NEAR(decrement, 0.5 * rate * elapsed, 2e-3 * decrement);
    // Central difference: sin(w h / 2) = w_0 h / 2, less the share of the damping.
    const double undamped = 10.0, shift = std::asin(0.5 * undamped * 0.01) / (0.5 * 0.01);
    const double expected = std::sqrt(shift * shift - 0.25 * rate * rate);
    EXPECT_NEAR(2 * std::numbers::pi * (peaks.size() - 1) / elapsed, expected, 1e-3 * expected);
    EXPECT_NEAR(scene.ledger.damping, 0.5 * 0.5 * 1e-10 * (1 - std::exp(-rate * 6.5)), 0.02 * 0.25e-10);
    EXPECT_LT(scene.ledger.balance_error(), 1e-4);
}

TEST(Damping, RelativeDampingLeavesTheMotionOfTheRigidPartAlone)
{
    // Two masses: one moves with three nodes that fly and turn as a rigid part does, the other does not.
    Model model = point_masses({{1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, 1.0, 0.25, 256);
    const Vec3 flight{0, 0, 3};
    for (Index node : {0, 2, 3, 4}) set_velocity(model, node, flight);
    NodeDamping damping;
    damping.rate = 5;
    damping.reference_nodes = {2, 3, 4};
    model.dampings.push_back(damping);
    const Scene scene = run_to_end(model);
    EXPECT_NEAR(norm(scene.state.velocity[0] - flight), 0, 1e-12);
    EXPECT_NEAR(scene.state.velocity[1].z, 3 * (1 - std::exp(-5 * 0.25)), 0.02); // half a step at either end
}

TEST(NonReflecting, TakesUpMoreThan99PercentOfAPulse)
{
    // A smooth pulse in the middle of a bar runs to both ends; after twice the time to the ends, what is left
    // has been reflected. Dilatational (along x) and shear (along y) waves.
    for (int axis : {0, 1}) {
        constexpr int count = 120;
        const double young = 100, poisson = axis == 0 ? 0.0 : 0.25;
        testing::SolidBlock block({count, 1, 1}, {1.0 * count, 1, 1}, elastic(1, young, poisson));
        Model& model = block.model;
        block.set_viscosity(0, 1e-20);
        std::vector<Index> all(model.nodes.size());
        for (std::size_t n = 0; n < all.size(); ++n) all[n] = static_cast<Index>(n);
        hold(model, all, axis == 0 ? 6u : 5u);
        block.set_velocity([&](const Vec3& x) {
            const double distance = std::abs(x.x - 60);
            const double v = distance < 15 ? 0.5e-3 * (1 + std::cos(std::numbers::pi * distance / 15)) : 0;
            return axis == 0 ? Vec3{v, 0, 0} : Vec3{0, v, 0};
        });
        NonReflectingBoundary boundary;
        boundary.segments = {
            {block.node(0, 0, 0), block.node(0, 0, 1), block.node(0, 1, 1), block.node(0, 1, 0)},
            {block.node(count, 0, 0), block.node(count, 1, 0), block.node(count, 1, 1),
             block.node(count, 0, 1)}};
        model.non_reflecting_boundaries.push_back(boundary);
        const double speed = axis == 0 ? 10 : std::sqrt(young / (2 * (1 + poisson)));
        model.controls.time.end_time = 120 / speed;
        const Scene scene = run_to_end(model);
        const double start = scene.ledger.initial_total;
        ASSERT_GT(start, 0);
        EXPECT_LT(scene.ledger.kinetic + scene.ledger.internal, 0.01 * start) << axis;
        EXPECT_NEAR(-scene.ledger.external_work, start, 0.01 * start) << axis;
        EXPECT_LT(scene.ledger.balance_error(), 1e-3) << axis;
    }
}

TEST(Fixities, HoldFreedomsAlongLocalAxesAndOnSlidingPlanes)
{
    Model model = point_masses({{0, 0, 0}, {0, 0, 0}}, 1.0, 1.0, 128);
    CoordinateSystem system; // turned by 30 degrees about z
    const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
    system.axes = {Vec3{c, s, 0}, Vec3{-s, c, 0}, Vec3{0, 0, 1}};
    model.coordinate_systems.push_back(system);
    FixedNodes fixed;
    fixed.nodes = {0};
    fixed.freedoms = 2 | 4; // free along the local x alone
    fixed.system = 0;
    model.fixed_nodes.push_back(fixed);
    fixed.nodes = {1};
    fixed.freedoms = 1; // stays in the plane across (1, 1, 0)
    fixed.system = none;
    fixed.local = true;
    const double h = std::sqrt(0.5);
    fixed.axes = {Vec3{h, h, 0}, Vec3{-h, h, 0}, Vec3{0, 0, 1}};
    model.fixed_nodes.push_back(fixed);
    NodalLoad load;
    load.nodes = {0, 1};
    load.direction = {1, 0, 0};
    load.curve = add_constant(model, 2);
    model.nodal_loads.push_back(load);
    const Scene scene = run_to_end(model);
    const double t = 1; // x = a t^2 / 2, exact in central difference
    EXPECT_NEAR(norm(scene.state.position[0] - (2 * c * t * t / 2) * system.axes[0]), 0, 1e-12);
    EXPECT_NEAR(norm(scene.state.position[1] - (2 * -h * t * t / 2) * fixed.axes[1]), 0, 1e-12);
    EXPECT_LT(scene.ledger.balance_error(), 1e-12);
}

TEST(PrescribedMotion, DrivesNodesRoundAnAxis)
{
    Model model = point_masses({{3, 1, 5}, {1, 1, 0}}, 2.0, 2.0, 512);
    PrescribedMotion motion;
    motion.nodes = {0, 1}; // the second one stands on the axis and stays
    motion.direction = {0, 0, 1};
    motion.center = {1, 1, 0};
    motion.orbit = true;
    motion.only_component = false;
    motion.curve = add_constant(model, 0.75);
    model.prescribed_motions.push_back(motion);
    set_velocity(model, 0, {0, 0, 0.5}); // along the axis it stays free
    const Scene scene = run_to_end(model);
    const Vec3 expected{1 + 2 * std::cos(1.5), 1 + 2 * std::sin(1.5), 6};
    EXPECT_NEAR(norm(scene.state.position[0] - expected), 0, 1e-10); // the rotation of each step is exact
    EXPECT_NEAR(norm(scene.state.position[1] - Vec3{1, 1, 0}), 0, 1e-15);
    EXPECT_LT(scene.ledger.balance_error(), 1e-5);
}

TEST(PrescribedMotion, TakesVelocityAsAFunctionOfDisplacement)
{
    Model model = point_masses({{0, 0, 0}}, 1.0, 1.0, 1024);
    model.curves.push_back({9, "v = 1 + x", {}, Curve{{0, 10}, {1, 11}}});
    PrescribedMotion motion;
    motion.nodes = {0};
    motion.direction = {0, 1, 0};
    motion.kind = PrescribedMotion::Kind::velocity_of_displacement;
    motion.curve = static_cast<Index>(model.curves.size()) - 1;
    model.prescribed_motions.push_back(motion);
    const Scene scene = run_to_end(model);
    EXPECT_NEAR(scene.state.position[0].y, std::exp(1.0) - 1, 2e-3); // first order: e h / 2
}

TEST(PrescribedMotion, BeginsItsCurveAtItsBirth)
{
    Model model = point_masses({{0, 0, 0}}, 1.0, 1.0, 1024);
    model.curves.push_back({9, "ramp", {}, Curve{{0, 1}, {0, 2}}});
    PrescribedMotion motion;
    motion.nodes = {0};
    motion.direction = {1, 0, 0};
    motion.kind = PrescribedMotion::Kind::displacement;
    motion.curve = static_cast<Index>(model.curves.size()) - 1;
    motion.birth = 0.4;
    model.prescribed_motions.push_back(motion);
    EXPECT_NEAR(run_to_end(model).state.position[0].x, 2 * 0.6, 0.003); // within a step
}

/// VAD 0, 1, 2: x = t^2 as velocity 2 t at n + 1/2, as acceleration 2 at n and as displacement at n + 1.
TEST(PrescribedMotion, FollowsVelocityAccelerationAndDisplacement)
{
    using Kind = PrescribedMotion::Kind;
    const std::pair<Kind, Curve> ways[] = {{Kind::velocity, Curve{{0, 2}, {0, 4}}},
                                           {Kind::acceleration, Curve{{0, 2}, {2, 2}}},
                                           {Kind::displacement, Curve{{0, 0.5, 1, 1.5}, {0, 0.25, 1, 2.25}}}};
    for (const auto& [kind, curve] : ways) {
        Model model = point_masses({{0, 0, 0}}, 1.0, 1.0, 1024);
        model.curves.push_back({9, "", {}, curve});
        PrescribedMotion motion;
        motion.nodes = {0};
        motion.direction = {1, 0, 0};
        motion.kind = kind;
        motion.curve = static_cast<Index>(model.curves.size()) - 1;
        model.prescribed_motions.push_back(motion);
        Scene scene = make_scene(model);
        Recorders nobody;
        const double time = run(scene, nobody).clock.time;
        const double exact = kind == Kind::displacement ? 1 + 2.5 * (time - 1) : time * time;
        // Velocities are those of half a step later, accelerations begin with half a step.
        EXPECT_NEAR(scene.state.position[0].x, exact, kind == Kind::displacement ? 1e-12 : 1e-6) << int(kind);
    }
}

TEST(Terminations, EndTheRunAtACoordinateAndAtACurve)
{
    Model model = point_masses({{0, 0, 0}}, 1.0, 1.0, 1024);
    set_velocity(model, 0, {2, 0, 0});
    Termination end;
    end.index = 0;
    end.largest = 0.5;
    model.terminations.push_back(end);
    Scene scene = make_scene(model);
    Recorders nobody;
    Outcome outcome = run(scene, nobody);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal);
    EXPECT_NEAR(outcome.clock.time, 0.25, 0.0021);
    EXPECT_NE(outcome.message.find("node 1 has reached its limit"), std::string::npos);

    model.curves.push_back({9, "", {}, Curve{{0, 1}, {1, -1}}});
    model.terminations[0].kind = Termination::Kind::curve;
    model.terminations[0].index = static_cast<Index>(model.curves.size()) - 1;
    Scene again = make_scene(model);
    outcome = run(again, nobody);
    EXPECT_NEAR(outcome.clock.time, 0.5, 0.0021);
}

} // namespace plash
