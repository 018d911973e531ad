// Joints of rigid bodies against closed solutions.

#include "tests/support/rigid_scene.h"

#include <gtest/gtest.h>

#include <numbers>

namespace plash {

namespace {

using testing::diagonal;
using testing::RigidScene;
using Type = Joint::Type;
constexpr FreedomMask ground = 63;

/// A bar from a pivot at the origin that starts `angle` from hanging straight down, on a revolute joint whose
/// axis is y.
struct Pendulum {
    static constexpr double mass = 2, inertia = 0.7, arm = 0.8, g = 9.81;
    RigidScene scene;
    Index bar;

    explicit Pendulum(double angle)
    {
        const Index a1 = scene.node({0, 0, 0}), a3 = scene.node({0, 1, 0});
        const Index b2 = scene.node({0, 0, 0}), b4 = scene.node({0, 1, 0});
        scene.body({1, {0, 0, 0}, diagonal(1, 1, 1)}, {a1, a3}, ground);
        bar = scene.body(
            {mass, {arm * std::sin(angle), 0, -arm * std::cos(angle)}, diagonal(0.3, inertia, 0.4)},
            {b2, b4});
        scene.joint(Type::revolute, {a1, b2, a3, b4, none, none});
        scene.gravity = {0, 0, -g};
    }
    double about_pivot() const { return inertia + mass * arm * arm; }
};

} // namespace

/// Period at 60 degrees: 4 sqrt(I / m g d) K(sin(30 deg)) (physical pendulum). Leapfrog's own error is
/// (omega dt)^2 / 24 = 4e-7 at 2,000 steps a period; the angle at the crossing is interpolated linearly.
TEST(RigidJoints, PendulumHasThePeriodOfTheEllipticIntegral)
{
    const double start = std::numbers::pi / 3;
    Pendulum pendulum(start);
    RigidScene& scene = pendulum.scene;
    const double scale = std::sqrt(pendulum.about_pivot() / (Pendulum::mass * Pendulum::g * Pendulum::arm));
    const double period = 4 * scale * std::comp_ellint_1(std::sin(start / 2));
    scene.start(period / 2000);
    double first_energy = 0, largest = 0, last_x = 0, first_crossing = -1, last_crossing = -1,
           largest_force = 0;
    int crossings = 0;
    for (int cycle = 0; cycle < 21000; ++cycle) {
        const double x = scene.bodies->bodies()[1].center.x;
        if (cycle > 0 && x * last_x < 0) {
            const double time = scene.clock.time - scene.clock.step * x / (x - last_x);
            if (crossings == 0) first_crossing = time;
            last_crossing = time;
            ++crossings;
        }
        last_x = x;
        scene.step();
        if (cycle == 0) first_energy = scene.energy;
        largest = std::max(largest, std::abs(scene.energy - first_energy));
        largest_force = std::max(largest_force, norm(scene.joint_force(0).force));
        const RigidBody& bar = scene.bodies->bodies()[1];
        ASSERT_NEAR(norm(bar.center), Pendulum::arm, 1e-12); // the joint does not give
        ASSERT_NEAR(bar.center.y, 0, 1e-12);
    }
    ASSERT_GT(crossings, 15);
    EXPECT_NEAR((last_crossing - first_crossing) / (0.5 * (crossings - 1)) / period, 1, 2e-6);
    const double swing = Pendulum::mass * Pendulum::g * Pendulum::arm * (1 - std::cos(start));
    EXPECT_LT(largest, 5e-6 * swing); // an oscillation of order (omega dt)^2 = 1e-5, no drift over 10 periods
    // Hanging force at the lowest point: weight + m d omega^2, omega^2 = 2 swing / I.
    const double expected =
        Pendulum::mass * Pendulum::g + Pendulum::mass * Pendulum::arm * 2 * swing / pendulum.about_pivot();
    EXPECT_NEAR(largest_force / expected, 1, 1e-5);
}

/// The error of the period falls with the square of the step.
TEST(RigidJoints, PendulumConvergesWithTheSquareOfTheStep)
{
    const double start = std::numbers::pi / 3;
    const auto place_after = [&](int steps) { // after a quarter period at twice the time of the crossing
        Pendulum pendulum(start);
        pendulum.scene.start(1.0 / steps);
        for (int i = 0; i < steps; ++i) pendulum.scene.step();
        return pendulum.scene.bodies->bodies()[1].center.x;
    };
    const double exact = place_after(8000), coarse = place_after(100) - exact,
                 fine = place_after(200) - exact;
    EXPECT_NEAR(coarse / fine, 4, 0.1);
}

/// Steady precession of a fast top whose axis is level: Omega = m g l / (I3 omega3), exactly, without
/// nutation (Goldstein, 'Classical mechanics', heavy symmetrical top with theta = 90 degrees). The angular
/// velocity is omega3 along the axis plus Omega about the vertical.
TEST(RigidJoints, LevelTopPrecessesSteadily)
{
    RigidScene scene;
    const double mass = 1.5, arm = 0.2, axial = 0.01, across = 0.02, spin = 200, g = 9.81;
    const Index a = scene.node({0, 0, 0}), b = scene.node({0, 0, 0});
    scene.body({1, {0, 0, 0}, diagonal(1, 1, 1)}, {a}, ground);
    const Index top = scene.body({mass, {arm, 0, 0}, diagonal(axial, across, across)}, {b});
    scene.joint(Type::spherical, {a, b, none, none, none, none});
    scene.gravity = {0, 0, -g};
    const double precession = mass * g * arm / (axial * spin);
    give_velocity(scene.draft(top), {0, precession * arm, 0}, {spin, 0, precession});
    const double quarter = 0.5 * std::numbers::pi / precession;
    const int steps = 20000;
    scene.start(quarter / steps);
    double lowest = 0;
    for (int i = 0; i < steps; ++i) {
        scene.step();
        lowest = std::max(lowest, std::abs(scene.bodies->bodies()[1].center.z));
    }
    const Vec3 center = scene.bodies->bodies()[1].center;
    // The wheel turns 7.5e-3 a step: errors of second order of it.
    EXPECT_NEAR(std::atan2(center.y, center.x), 0.5 * std::numbers::pi, 1e-4);
    EXPECT_LT(lowest, 1e-4 * arm);
    EXPECT_NEAR(norm(center), arm, 1e-12);
}

/// A plane crank and rocker (1, 2.5, 2, base 2.2) with four revolute joints: in space three of its conditions
/// follow from the others. The crank is driven; the rocker's angle must be that of Freudenstein's equation.
TEST(RigidJoints, FourBarLinkageFollowsFreudenstein)
{
    const double crank = 1, coupler = 2.5, rocker = 2, base = 2.2, speed = 3;
    // Assembled with the crank at 90 degrees; the rocker's angle from the triangle.
    const auto rocker_angle = [&](double angle) { // open configuration
        const Vec3 a{crank * std::cos(angle), crank * std::sin(angle), 0};
        const double dx = a.x - base, dy = a.y, r = std::hypot(dx, dy);
        const double inner = std::acos((r * r + rocker * rocker - coupler * coupler) / (2 * r * rocker));
        return std::atan2(dy, dx) - inner;
    };
    RigidScene scene;
    const double phi = 0.5 * std::numbers::pi, psi = rocker_angle(phi);
    const Vec3 o{}, a{crank * std::cos(phi), crank * std::sin(phi), 0};
    const Vec3 c{base, 0, 0}, b{base + rocker * std::cos(psi), rocker * std::sin(psi), 0};
    const Vec3 z{0, 0, 0.3};
    const auto pair = [&](const Vec3& place) { return std::array{scene.node(place), scene.node(place + z)}; };
    const auto o1 = pair(o), o2 = pair(o), a1 = pair(a), a2 = pair(a), b1 = pair(b), b2 = pair(b),
               c1 = pair(c), c2 = pair(c);
    scene.body({1, {0, 0, 0}, diagonal(1, 1, 1)}, {o1[0], o1[1], c1[0], c1[1]}, ground);
    scene.body({1, 0.5 * a, diagonal(.1, .1, .1)}, {o2[0], o2[1], a1[0], a1[1]});
    scene.body({2, 0.5 * (a + b), diagonal(.4, .4, .5)}, {a2[0], a2[1], b1[0], b1[1]});
    const Index last = scene.body({1.5, 0.5 * (b + c), diagonal(.3, .3, .3)}, {b2[0], b2[1], c2[0], c2[1]});
    const auto revolute = [&](const auto& first, const auto& second) {
        scene.joint(Type::revolute, {first[0], second[0], first[1], second[1], none, none});
    };
    revolute(o1, o2);
    revolute(a1, a2);
    revolute(b1, b2);
    revolute(c1, c2);
    scene.motor(Type::rotational_motor, {o1[0], o2[0], o1[1], o2[1], none, none}, speed);
    const int turn = 4000;
    scene.start(2 * std::numbers::pi / speed / turn);
    double worst = 0, first_energy = 0, worst_energy = 0, largest_kinetic = 0;
    for (int i = 0; i < 2 * turn; ++i) {
        scene.step();
        const RigidBody& body = scene.bodies->bodies()[last];
        const double angle = std::atan2(body.orientation.row[1].x, body.orientation.row[0].x) + psi;
        const double expected = rocker_angle(phi + speed * scene.clock.time);
        worst = std::max(worst, std::abs(std::remainder(angle - expected, 2 * std::numbers::pi)));
        ASSERT_NEAR(body.center.z, 0, 1e-10);
        if (i == 0) first_energy = scene.kinetic - scene.work;
        worst_energy = std::max(worst_energy, std::abs(scene.kinetic - scene.work - first_energy));
        largest_kinetic = std::max(largest_kinetic, scene.kinetic);
    }
    EXPECT_LT(worst, 1e-9); // positions are exact: conditions hold at the end of every step
    // The motor's work is the kinetic energy to the second order of the step (1.6e-3 of a turn: 2.5e-6).
    EXPECT_LT(worst_energy, 1e-5 * largest_kinetic);
}

/// Two shafts at 30 degrees on a universal joint: tan(out) = tan(in) / cos(30 deg) up to the starting phase
/// (Cardan's equation; input fork in the plane of the shafts at the start).
TEST(RigidJoints, UniversalJointFollowsCardan)
{
    RigidScene scene;
    const double bend = std::numbers::pi / 6, speed = 5;
    const Vec3 x{1, 0, 0}, out{std::cos(bend), std::sin(bend), 0}, z{0, 0, 1},
        across{-std::sin(bend), std::cos(bend), 0};
    const Index g1 = scene.node({}), g3 = scene.node(x), h1 = scene.node({}), h3 = scene.node(out);
    const Index a1 = scene.node({}), a3 = scene.node(x), a_arm = scene.node(z);
    const Index b2 = scene.node({}), b3 = scene.node(out), b_arm = scene.node(across);
    scene.body({1, {}, diagonal(1, 1, 1)}, {g1, g3, h1, h3}, ground);
    scene.body({1, {}, diagonal(.2, .2, .2)}, {a1, a3, a_arm});
    const Index driven = scene.body({1, {}, diagonal(.1, .1, .1)}, {b2, b3, b_arm});
    scene.joint(Type::revolute, {g1, a1, g3, a3, none, none});
    scene.joint(Type::revolute, {h1, b2, h3, b3, none, none});
    scene.joint(Type::universal, {a1, b2, a_arm, b_arm, none, none});
    scene.motor(Type::rotational_motor, {g1, a1, g3, a3, none, none}, speed);
    const int turn = 4000;
    scene.start(2 * std::numbers::pi / speed / turn);
    double worst = 0;
    for (int i = 0; i < turn; ++i) {
        scene.step();
        const RigidBody& body = scene.bodies->bodies()[driven];
        const Vec3 arm = body.orientation * across;
        const double angle = std::atan2(dot(arm, z), dot(arm, across)); // about `out`
        const double input = speed * scene.clock.time;
        const double expected = std::atan2(std::sin(input) * std::cos(bend), std::cos(input));
        const double other = std::atan2(std::sin(input), std::cos(input) * std::cos(bend));
        worst = std::max(worst, std::min(std::abs(std::remainder(angle - expected, 2 * std::numbers::pi)),
                                         std::abs(std::remainder(angle - other, 2 * std::numbers::pi))));
    }
    EXPECT_LT(worst, 1e-9);
}

/// The same shafts on a constant-velocity joint turn alike.
TEST(RigidJoints, ConstantVelocityJointTurnsShaftsAlike)
{
    RigidScene scene;
    const double bend = std::numbers::pi / 6, speed = 5;
    const Vec3 x{1, 0, 0}, out{std::cos(bend), std::sin(bend), 0};
    const Index g1 = scene.node({}), g3 = scene.node(x), h1 = scene.node({}), h3 = scene.node(out);
    const Index a1 = scene.node({}), a3 = scene.node(x), b2 = scene.node({}), b3 = scene.node(out);
    scene.body({1, {}, diagonal(1, 1, 1)}, {g1, g3, h1, h3}, ground);
    scene.body({1, {}, diagonal(.2, .2, .2)}, {a1, a3});
    const Index driven = scene.body({1, {}, diagonal(.1, .1, .1)}, {b2, b3});
    scene.joint(Type::revolute, {g1, a1, g3, a3, none, none});
    scene.joint(Type::revolute, {h1, b2, h3, b3, none, none});
    scene.joint(Type::constant_velocity, {a1, b2, a3, b3, none, none});
    scene.motor(Type::rotational_motor, {g1, a1, g3, a3, none, none}, speed);
    scene.start(1e-3);
    for (int i = 0; i < 1000; ++i) scene.step();
    EXPECT_LT(norm(scene.bodies->bodies()[driven].angular_velocity - speed * out), 1e-9);
}

/// A slider on an inclined translational joint: s = g sin(alpha) t^2 / 2, which leapfrog hits exactly.
TEST(RigidJoints, SliderFallsDownItsIncline)
{
    RigidScene scene;
    const double slope = 0.4;
    const Vec3 down{std::cos(slope), 0, -std::sin(slope)};
    const Index g1 = scene.node({}), g3 = scene.node(down), b2 = scene.node({}), b4 = scene.node(down);
    scene.body({1, {}, diagonal(1, 1, 1)}, {g1, g3}, ground);
    scene.body({3, {0.1, 0.2, 0.3}, diagonal(.2, .3, .4)}, {b2, b4});
    scene.joint(Type::translational, {g1, b2, g3, b4, none, none});
    scene.gravity = {0, 0, -9.81};
    scene.start(1e-3);
    for (int i = 0; i < 1000; ++i) scene.step();
    const RigidBody& body = scene.bodies->bodies()[1];
    const Vec3 moved = body.center - Vec3{0.1, 0.2, 0.3};
    const double distance = 0.5 * 9.81 * std::sin(slope);
    EXPECT_NEAR(dot(moved, down), distance, 1e-10);
    EXPECT_NEAR(norm(moved), distance, 1e-10);
    EXPECT_NEAR(body.orientation.row[0].x, 1, 1e-12);
    // Normal force m g cos(alpha); its moment about the joint's node from the center that lies off the line.
    EXPECT_NEAR(norm(scene.joint_force(0).force), 3 * 9.81 * std::cos(slope), 1e-7);
}

/// Cylindrical and planar joints leave exactly their freedoms: a push along the axis and a couple about it,
/// or two pushes and a couple, move the free body as if it were alone; other loads do nothing.
TEST(RigidJoints, CylindricalAndPlanarJointsLeaveTheirFreedoms)
{
    for (const Type type : {Type::cylindrical, Type::planar}) {
        RigidScene scene;
        const Index g1 = scene.node({}), g3 = scene.node({0, 0, 1}), b2 = scene.node({}),
                    b4 = scene.node({0, 0, 1});
        scene.body({1, {}, diagonal(1, 1, 1)}, {g1, g3}, ground);
        const Index body = scene.body({2, {}, diagonal(.5, .6, .7)}, {b2, b4});
        scene.joint(type, {g1, b2, g3, b4, none, none});
        scene.model.curves.push_back({1, "", {}, Curve{{0, 1e9}, {1, 1}}});
        for (const bool moment : {false, true}) {
            for (const Vec3& e : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
                RigidBodyLoad load;
                load.body = body;
                load.direction = e;
                load.moment = moment;
                load.curve = 0;
                load.scale = moment ? 0.14 : 4;
                scene.model.rigid_body_loads.push_back(load);
            }
        }
        scene.start(1e-3);
        for (int i = 0; i < 1000; ++i) scene.step();
        const RigidBody& now = scene.bodies->bodies()[1];
        // a = 4 / 2 over one second: 1; angular acceleration 0.14 / 0.7: 0.1 rad.
        const bool along = type == Type::cylindrical;
        EXPECT_NEAR(now.center.z, along ? 1 : 0, 1e-9);
        EXPECT_NEAR(now.center.x, along ? 0 : 1, 1e-9);
        EXPECT_NEAR(now.center.y, along ? 0 : 1, 1e-9);
        EXPECT_NEAR(std::atan2(now.orientation.row[1].x, now.orientation.row[0].x), 0.1, 1e-9);
        EXPECT_NEAR(now.orientation.row[2].z, 1, 1e-12);
    }
}

/// Screw, gears, pulley and rack tie rates; the energy that a couple puts in is shared by the right inertias.
TEST(RigidJoints, ScrewGearsPulleyAndRackTieTheirRates)
{
    struct Case {
        Type type;
        double parameter, expected; ///< rate of the second over that of the first
    };
    constexpr FreedomMask only_z_spin = 7 | 8 | 16, only_x_run = 2 | 4 | 56;
    for (const Case& test : {Case{Type::gears, 2, -0.5}, Case{Type::pulley, 2, 0.5},
                             Case{Type::rack_and_pinion, 0.3, 0.3}, Case{Type::screw, 0.3, -0.3}}) {
        RigidScene scene;
        const bool rack = test.type == Type::rack_and_pinion, screw = test.type == Type::screw;
        const Index a1 = scene.node({}), a3 = scene.node({0, 0, 1});
        const Index b2 = scene.node({1, 0, 0}), b4 = scene.node(rack ? Vec3{2, 0, 0} : Vec3{1, 0, 1});
        const Index first = scene.body({1, {}, diagonal(1, 1, 0.7)}, {a1, a3}, only_z_spin);
        const FreedomMask held = rack ? only_x_run : screw ? FreedomMask{3 | 56} : only_z_spin;
        scene.body({2, {1, 0, 0}, diagonal(1, 1, 0.4)}, {b2, b4}, held);
        scene.joint(test.type, {a1, b2, a3, b4, none, none}, test.parameter);
        scene.model.curves.push_back({1, "", {}, Curve{{0, 1e9}, {1, 1}}});
        RigidBodyLoad load;
        load.body = first;
        load.direction = {0, 0, 1};
        load.moment = true;
        load.curve = 0;
        scene.model.rigid_body_loads.push_back(load);
        scene.start(1e-3);
        for (int i = 0; i < 1000; ++i) scene.step();
        const RigidBody& driver = scene.bodies->bodies()[0];
        const RigidBody& driven = scene.bodies->bodies()[1];
        const double rate = rack ? driven.velocity.x : screw ? driven.velocity.z : driven.angular_velocity.z;
        EXPECT_NEAR(rate / driver.angular_velocity.z, test.expected, 1e-12) << static_cast<int>(test.type);
        const double second = rack || screw ? 2.0 : 0.4; // what the second body opposes
        const double reduced = 0.7 + second * test.expected * test.expected;
        EXPECT_NEAR(driver.angular_velocity.z, 0.9995 / reduced, 1e-9) << static_cast<int>(test.type);
    }
}

namespace {

/// A wheel on a revolute joint about z with a joint stiffness in the angle psi (about z).
struct Wheel {
    static constexpr double inertia = 0.7;
    RigidScene scene;

    explicit Wheel(const JointStiffness::Freedom& freedom, double spin)
    {
        const Index g1 = scene.node({}), g3 = scene.node({0, 0, 1}), b2 = scene.node({}),
                    b4 = scene.node({0, 0, 1});
        scene.body({1, {}, diagonal(1, 1, 1)}, {g1, g3}, ground);
        const Index wheel = scene.body({2, {}, diagonal(.5, .6, inertia)}, {b2, b4});
        scene.joint(Type::revolute, {g1, b2, g3, b4, none, none});
        JointStiffness stiffness;
        stiffness.first = 0;
        stiffness.second = 1;
        stiffness.first_axes = stiffness.second_axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
        stiffness.freedoms[2] = freedom;
        scene.model.joint_stiffnesses.push_back(stiffness);
        give_velocity(scene.draft(wheel), {}, {0, 0, spin});
    }
    double angle() const
    {
        const Matrix3& turned = scene.bodies->bodies()[1].orientation;
        return std::atan2(turned.row[1].x, turned.row[0].x);
    }
};

} // namespace

/// Torsion pendulum: amplitude omega / sqrt(k / I), period 2 std::numbers::pi sqrt(I / k); 1,000 steps a
/// period.
TEST(JointStiffness, SpringGivesTheTorsionPendulum)
{
    JointStiffness::Freedom freedom;
    freedom.stiffness_curve = 0;
    Wheel wheel(freedom, 2);
    const double stiffness = 5, frequency = std::sqrt(stiffness / Wheel::inertia);
    wheel.scene.model.curves.push_back({1, "", {}, Curve{{-10, 10}, {-10 * stiffness, 10 * stiffness}}});
    wheel.scene.start(2 * std::numbers::pi / frequency / 1000);
    double largest = 0, crossing = 0, last = 0;
    int crossings = 0;
    for (int i = 0; i < 10100; ++i) {
        const double angle = i == 0 ? 0 : wheel.angle();
        if (last < 0 && angle >= 0) {
            crossing = wheel.scene.clock.time - wheel.scene.clock.step * angle / (angle - last);
            ++crossings;
        }
        last = angle;
        largest = std::max(largest, angle);
        wheel.scene.step();
    }
    ASSERT_EQ(crossings, 10);
    EXPECT_NEAR(crossing / (10 * 2 * std::numbers::pi / frequency), 1,
                3e-6); // leapfrog: (omega dt)^2 / 24 = 1.6e-6
    EXPECT_NEAR(largest, 2 / frequency, 1e-5 * largest);
}

/// Friction alone: constant deceleration FM / I, then rest within its elastic angle. A stop turns the wheel
/// back with its speed.
TEST(JointStiffness, FrictionBrakesAndStopsReflect)
{
    JointStiffness::Freedom friction;
    friction.elastic = 1e4;
    friction.friction = 0.35;
    Wheel braked(friction, 1);
    braked.scene.start(1e-3);
    for (int i = 0; i < 1000; ++i) braked.scene.step();
    EXPECT_NEAR(braked.scene.bodies->bodies()[1].angular_velocity.z, 1 - 0.35 / Wheel::inertia, 2e-3);
    for (int i = 0; i < 3000; ++i) braked.scene.step();
    EXPECT_NEAR(braked.angle(), 0.5 * Wheel::inertia / 0.35, 2e-3);

    JointStiffness::Freedom stop;
    stop.elastic = 1e4;
    stop.positive_stop = 0.5;
    Wheel stopped(stop, 1);
    stopped.scene.start(1e-3);
    double largest = 0;
    for (int i = 0; i < 800; ++i) {
        stopped.scene.step();
        largest = std::max(largest, stopped.angle());
    }
    // Depth omega sqrt(I / k) = 8.4e-3.
    EXPECT_NEAR(largest, 0.5 + std::sqrt(Wheel::inertia / 1e4), 2e-4);
    EXPECT_NEAR(stopped.scene.bodies->bodies()[1].angular_velocity.z, -1, 2e-2);
}

/// A chain of three bars on spherical joints, let go from the level: chaotic, but its energy must not drift.
TEST(RigidJoints, ThreeFoldPendulumKeepsItsEnergyOver50000Steps)
{
    RigidScene scene;
    const Index g = scene.node({});
    scene.body({1, {}, diagonal(1, 1, 1)}, {g}, ground);
    Index last = g;
    for (int link = 0; link < 3; ++link) {
        const Index from = scene.node({1.0 * link, 0, 0}), to = scene.node({link + 1.0, 0, 0});
        scene.body({1, {link + 0.5, 0, 0}, diagonal(0.01, 0.1, 0.08)}, {from, to});
        scene.joint(Type::spherical, {last, from, none, none, none, none});
        last = to;
    }
    scene.gravity = {0, 0.5, -9.81};
    scene.start(2e-4);
    double first = 0, largest = 0, late = 0, peak = 0;
    for (int i = 0; i < 50000; ++i) {
        scene.step();
        if (i == 0) first = scene.energy;
        const double error = std::abs(scene.energy - first);
        largest = std::max(largest, error);
        if (i >= 40000) late = std::max(late, error);
        peak = std::max(peak, scene.kinetic);
    }
    EXPECT_GT(peak, 20);
    EXPECT_LT(largest, 1e-4 * peak); // oscillates with (omega dt)^2 of the whipping last link
    EXPECT_LT(late, 1e-4 * peak);
    const auto& bodies = scene.bodies->bodies();
    for (int link = 1; link < 3; ++link) { // joints have not opened
        const Vec3 end = bodies[link].center + bodies[link].orientation * Vec3{0.5, 0, 0};
        const Vec3 begin = bodies[link + 1].center + bodies[link + 1].orientation * Vec3{-0.5, 0, 0};
        EXPECT_LT(norm(end - begin), 1e-11);
    }
}

} // namespace plash
