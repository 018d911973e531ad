#include "rigid/rigid_bodies.h"
#include "solver/scene.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

/// *ELEMENT_INERTIA with unequal moments and *ELEMENT_INERTIA_OFFSET: a node with a mass that has a shape.
namespace plash {

namespace {

/// A model with one free node at (1, 2, 3) and these mass properties.
Model model_with(Record inertia, const Vec3& velocity, const Vec3& spin)
{
    Model model;
    model.nodes.id = {7};
    model.nodes.position = {{1, 2, 3}};
    model.others.push_back(std::move(inertia));
    InitialVelocity initial;
    initial.nodes = {0};
    initial.translation = velocity;
    initial.angular_velocity = spin;
    initial.set_rotation = true;
    model.initial_velocities = {initial};
    return model;
}

/// Steps the rigid bodies of a scene, which hold the node, under a constant force and moment on it.
struct Stepper {
    Model model;
    Scene scene;
    RigidBodies* bodies = nullptr;
    Clock clock;
    EnergyLedger ledger;

    Stepper(Model its_model, double step) : model(std::move(its_model)), scene(make_scene(model))
    {
        for (auto& term : scene.terms)
            if (auto* found = dynamic_cast<RigidBodies*>(term.get())) bodies = found;
        clock.step = step;
    }
    const RigidBody& body() const { return bodies->bodies().front(); }

    void step(const Vec3& force = {})
    {
        scene.state.force[0] = force;
        scene.state.moment[0] = {};
        bodies->constrain(clock, scene.state);
        ledger = {};
        ledger.open_cycle(model.parts.size());
        bodies->report(ledger);
        scene.state.position[0] += clock.step * scene.state.velocity[0];
        clock.last_step = clock.step;
        clock.time += clock.step;
        ++clock.cycle;
    }
};

Record inertia_record(const char* keyword, std::vector<std::pair<const char*, double>> more)
{
    std::vector<std::pair<const char*, double>> fields{{"EID", 1}, {"NID", 7}, {"MASS", 2},
                                                       {"IXX", 1}, {"IYY", 2}, {"IZZ", 2.5}};
    fields.insert(fields.end(), more.begin(), more.end());
    return make_record(keyword, fields);
}

} // namespace

/// Free spin about the intermediate axis, which is not stable: the body tips over again and again, and keeps
/// its angular momentum exactly and its energy within 1e-6 of 1e5 steps (it swings with the tumbling and does
/// not drift).
TEST(NodalInertia, SpinAboutTheIntermediateAxisKeepsEnergyAndAngularMomentum)
{
    Stepper free(model_with(inertia_record("ELEMENT_INERTIA", {}), {}, {0.05, 1, 0.005}), 1e-3);
    ASSERT_NE(free.bodies, nullptr);
    const RigidBody start = free.body();
    EXPECT_NEAR(start.mass, 2, 1e-15);
    const double energy = 0.5 * dot(start.angular_velocity, start.angular_momentum);
    EXPECT_NEAR(energy, 0.5 * (1 * 0.05 * 0.05 + 2 * 1 + 2.5 * 0.005 * 0.005), 1e-15);
    double largest = 0, last = 1;
    int flips = 0;
    for (int cycle = 0; cycle < 100000; ++cycle) {
        free.step();
        largest = std::max(largest, std::abs(free.ledger.kinetic / energy - 1));
        const double along = free.body().orientation.row[1].y;
        if (along * last < 0) ++flips;
        if (along != 0) last = along;
    }
    EXPECT_GE(flips, 5);
    EXPECT_LT(largest, 1e-6);
    EXPECT_EQ(norm(free.body().angular_momentum - start.angular_momentum), 0);
    EXPECT_EQ(norm(free.scene.state.position[0] - Vec3{1, 2, 3}), 0);
}

/// Axes of CSID: turned by 90 degrees about z, IXX belongs to the global y.
TEST(NodalInertia, TakesItsAxesFromTheCoordinateSystem)
{
    Model model = model_with(inertia_record("ELEMENT_INERTIA", {{"CSID", 4}}), {}, {});
    CoordinateSystem system;
    system.id = 4;
    system.axes = {Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}};
    model.coordinate_systems = {system};
    const Stepper free(std::move(model), 1e-3);
    EXPECT_NEAR(free.body().body_inertia.row[0].x, 2, 1e-15);
    EXPECT_NEAR(free.body().body_inertia.row[1].y, 1, 1e-15);
    EXPECT_NEAR(free.body().body_inertia.row[2].z, 2.5, 1e-15);
}

/// A force on the node acts off the centre of the mass: centre and spin after one step are those of Newton
/// and Euler, and the node moves as the point of the body that it is.
TEST(NodalInertia, OffsetMassesTurnUnderAForceOnTheirNode)
{
    const Vec3 offset{0.5, 0, 0}, force{0, 3, 0};
    Stepper pushed(
        model_with(inertia_record("ELEMENT_INERTIA_OFFSET", {{"X-OFF", offset.x}}), {0, 0, 0}, {0, 0, 0}),
        1e-4);
    ASSERT_NE(pushed.bodies, nullptr);
    EXPECT_NEAR(norm(pushed.body().center - (Vec3{1, 2, 3} + offset)), 0, 1e-15);
    const double half = 0.5e-4; // the first velocity is half a step after the start
    pushed.step(force);
    EXPECT_NEAR(pushed.body().velocity.y, half * 3 / 2, 1e-18);
    EXPECT_NEAR(pushed.body().angular_velocity.z, half * -0.5 * 3 / 2.5, 1e-18);
    EXPECT_NEAR(pushed.scene.state.velocity[0].y, half * 3 * (1.0 / 2 + 0.25 / 2.5),
                1e-11); // along the chord
    // Work of the force is the energy of the body.
    double work = 0;
    const double start = pushed.ledger.kinetic;
    for (int i = 0; i < 2000; ++i) {
        const double before = pushed.scene.state.velocity[0].y;
        pushed.step(force);
        work += 1e-4 * 3 * before;
    }
    EXPECT_NEAR(pushed.ledger.kinetic - start, work, 1e-4 * work);
}

/// With the velocity of the node and a spin, the centre moves with both.
TEST(NodalInertia, OffsetMassesStartWithTheSpinOfTheirNode)
{
    const Stepper free(
        model_with(inertia_record("ELEMENT_INERTIA_OFFSET", {{"Y_OFF", 0.25}}), {1, 0, 0}, {0, 0, 2}), 1e-4);
    EXPECT_NEAR(norm(free.body().velocity - Vec3{1 - 2 * 0.25, 0, 0}), 0, 1e-15);
    EXPECT_NEAR(free.body().angular_velocity.z, 2, 1e-15);
}

TEST(NodalInertia, RefusesTensorsThatNoMassHas)
{
    EXPECT_THROW(make_scene(model_with(inertia_record("ELEMENT_INERTIA", {{"IXY", 1.5}}), {}, {})),
                 DeckError);
    Record flat = make_record("ELEMENT_INERTIA",
                              {{"EID", 1}, {"NID", 7}, {"MASS", 2}, {"IXX", 5}, {"IYY", 2}, {"IZZ", 2.5}});
    EXPECT_THROW(make_scene(model_with(flat, {}, {})), DeckError);
}

} // namespace plash
