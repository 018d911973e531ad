#include "core/recorder.h"
#include "tests/support/point_masses.h"
#include "tests/support/shell_model.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

using testing::add_constant;
using testing::point_masses;
using testing::run_to_end;
using testing::set_velocity;

RigidWall floor_wall()
{
    RigidWall wall;
    wall.id = 1;
    wall.normal = {0, 0, 1};
    return wall;
}

} // namespace

TEST(RigidWalls, CoulombFrictionStopsASlidingMassWhereItShould)
{
    // v = 3, g = 10, mu = 0.4: it stops after v / (mu g) = 0.75 s and v^2 / (2 mu g) = 1.125 m.
    Model model = point_masses({{0, 0, 0}}, 2.0, 1.0, 1024);
    BodyLoad gravity;
    gravity.direction = {0, 0, 1};
    gravity.curve = add_constant(model, 10);
    model.body_loads.push_back(gravity);
    set_velocity(model, 0, {3, 0, 0});
    RigidWall wall = floor_wall();
    wall.friction = 0.4;
    model.rigid_walls.push_back(wall);
    const Scene scene = run_to_end(model);
    EXPECT_NEAR(scene.state.position[0].x, 1.125, 0.002); // a step of 1 ms at 3 m/s
    EXPECT_NEAR(norm(scene.state.velocity[0]), 0, 1e-12);
    EXPECT_NEAR(scene.ledger.rigid_wall, 9.0, 0.02); // m v^2 / 2
    EXPECT_LT(scene.ledger.balance_error(), 1e-12);
}

TEST(RigidWalls, OrthotropicFrictionActsAlongItsAxesAlone)
{
    Model model = point_masses({{0, 0, 0}}, 2.0, 0.5, 512);
    BodyLoad gravity;
    gravity.direction = {0, 0, 1};
    gravity.curve = add_constant(model, 10);
    model.body_loads.push_back(gravity);
    set_velocity(model, 0, {0, 3, 0});
    RigidWall wall = floor_wall();
    wall.orthotropic = true;
    wall.friction_axis = {1, 0, 0};
    wall.static_friction = wall.dynamic_friction = {0.4, 0};
    model.rigid_walls.push_back(wall);
    EXPECT_NEAR(run_to_end(model).state.velocity[0].y, 3, 1e-12);
    model.rigid_walls[0].friction_axis = {0, 1, 0};
    EXPECT_NEAR(run_to_end(model).state.velocity[0].y, 3 - 0.4 * 10 * 0.5, 0.01); // half a step at either end
}

TEST(RigidWalls, AMovingMassSharesItsMomentum)
{
    // Plastic impact of M = 6 at 4 m/s with two masses of 1 at rest: 4 * 6 / 8 = 3 m/s; half of it lost ...
    Model model = point_masses({{0, 0, 1}, {5, 0, 1}}, 1.0, 1.0, 1024);
    RigidWall wall = floor_wall();
    wall.mass = 6;
    wall.start_velocity = 4;
    model.rigid_walls.push_back(wall);
    const Scene scene = run_to_end(model);
    EXPECT_NEAR(scene.state.velocity[0].z, 3, 1e-12);
    EXPECT_NEAR(scene.state.velocity[1].z, 3, 1e-12);
    EXPECT_NEAR(scene.ledger.kinetic, 0.5 * 8 * 9, 1e-10);
    EXPECT_NEAR(scene.ledger.rigid_wall, 0.5 * 6 * 16 - 0.5 * 8 * 9, 1e-10); // ... 48 - 36
    EXPECT_LT(scene.ledger.balance_error(), 1e-12);
}

TEST(RigidWalls, ADrivenWallPushesAndItsWorkComesFromOutside)
{
    Model model = point_masses({{0, 0, 1}}, 2.0, 1.0, 1024);
    RigidWall wall = floor_wall();
    wall.motion_curve = add_constant(model, 5);
    wall.motion_direction = {0, 0, 1};
    model.rigid_walls.push_back(wall);
    const Scene scene = run_to_end(model);
    EXPECT_NEAR(scene.state.velocity[0].z, 5, 1e-12);
    EXPECT_NEAR(scene.state.position[0].z, 5, 1e-9);            // stands on the wall
    EXPECT_NEAR(scene.ledger.external_work, 2.0 * 5 * 5, 1e-9); // impulse m v at speed v
    EXPECT_NEAR(scene.ledger.rigid_wall, 25, 1e-9);             // half of it is lost in a plastic impact
    EXPECT_LT(scene.ledger.balance_error(), 1e-12);
}

TEST(RigidWalls, AFinitePlaneStopsWhatFallsOnItAlone)
{
    Model model = point_masses({{0.5, 0.5, 1}, {1.5, 0.5, 1}, {0.5, 2.5, 1}, {-0.1, 0.5, 1}}, 1.0, 1.0, 128);
    for (Index node = 0; node < 4; ++node) set_velocity(model, node, {0, 0, -3});
    RigidWall wall = floor_wall();
    wall.shape = RigidWall::Shape::finite_plane;
    wall.edge = {1, 0, 0};
    wall.length = {1, 2, 0};
    model.rigid_walls.push_back(wall);
    const Scene scene = run_to_end(model);
    EXPECT_NEAR(scene.state.position[0].z, 0, 1e-13);
    for (Index node = 1; node < 4; ++node) EXPECT_NEAR(scene.state.position[node].z, -2, 1e-12) << node;
}

TEST(RigidWalls, CurvedWallsAndPrismsStopMassesAtTheirSurface)
{
    // From above onto the top of a sphere, a lying cylinder and a prism; all have their highest point at z
    // = 2.
    for (const RigidWall::Shape shape :
         {RigidWall::Shape::sphere, RigidWall::Shape::cylinder, RigidWall::Shape::prism}) {
        Model model = point_masses({{0, 0, 5}, {3.5, 0, 5}}, 1.0, 1.0, 256);
        for (Index node : {0, 1}) set_velocity(model, node, {0, 0, -8});
        RigidWall wall = floor_wall();
        wall.shape = shape;
        wall.radius = 2;
        if (shape == RigidWall::Shape::cylinder) {
            wall.normal = {0, 1, 0};
            wall.tail = {0, -1, 0};
            wall.edge = {1, 0, 0};
            wall.length = {2, 0, 0};
        } else if (shape == RigidWall::Shape::prism) {
            wall.tail = {-1, -1, 2};
            wall.edge = {1, 0, 0};
            wall.length = {2, 2, 4};
        }
        model.rigid_walls.push_back(wall);
        const Scene scene = run_to_end(model);
        EXPECT_NEAR(scene.state.position[0].z, 2, 1e-12) << static_cast<int>(shape);
        EXPECT_NEAR(scene.state.position[1].z, -3, 1e-12) << static_cast<int>(shape); // passes beside it
    }
}

TEST(RigidWalls, AMassSlidesRoundTheInsideOfACylinder)
{
    Model model = point_masses({{2, 0, 0}}, 1.0, 3.0, 3072);
    set_velocity(model, 0, {0, 4, 1});
    RigidWall wall = floor_wall();
    wall.shape = RigidWall::Shape::cylinder;
    wall.radius = 2;
    wall.interior = true;
    wall.edge = {1, 0, 0};
    model.rigid_walls.push_back(wall);
    const Scene scene = run_to_end(model);
    const Vec3& x = scene.state.position[0];
    EXPECT_NEAR(std::hypot(x.x, x.y), 2, 1e-9);
    EXPECT_NEAR(x.z, 3, 1e-12);
    // The wall takes what turns the velocity: with d = v h / R a step, the free step ends 3 d / 2 off the
    // tangent, of which the wall takes d, so v falls by d^2 a step: v = v_0 / sqrt(1 + 2 n d_0^2).
    const double turn = 4.0 / 1024 / 2;
    EXPECT_NEAR(std::hypot(scene.state.velocity[0].x, scene.state.velocity[0].y),
                4 / std::sqrt(1 + 2 * 3072 * turn * turn), 1e-3);
    EXPECT_LT(scene.ledger.balance_error(), 1e-10);
}

TEST(RigidWalls, ARigidBodyBouncesBackWithItsEnergy)
{
    testing::SolidBlock block({2, 2, 2}, {1, 1, 1},
                              testing::record_of("MAT_RIGID", 1, {{"RO", 1}, {"E", 1e4}, {"PR", 0.3}}));
    Model& model = block.model;
    for (Vec3& place : model.nodes.position) place.z += 0.5;
    model.controls.time.end_time = 0.2;
    model.curves.push_back({1, "step", {}, Curve{{0, 1e9}, {2e-4, 2e-4}}});
    model.controls.time.largest_step_curve = 0;
    block.set_velocity([](const Vec3&) { return Vec3{0, 0, -5}; });
    model.rigid_walls.push_back(floor_wall());
    const Scene scene = run_to_end(model);
    // A spring of 0.1 m / dt^2 rests for pi / sqrt(0.1) = 10 steps; its onset within a step costs 1/(2 * 10).
    EXPECT_NEAR(scene.state.velocity[0].z, 5, 0.1);
    for (std::size_t node = 1; node < scene.state.size(); ++node)
        EXPECT_NEAR(scene.state.velocity[node].z, scene.state.velocity[0].z, 1e-6); // without turning
    EXPECT_LT(scene.ledger.balance_error(), 0.02);
}

} // namespace plash
