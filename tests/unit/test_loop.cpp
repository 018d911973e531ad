#include "contact/rigid_wall.h"
#include "solver/explicit_loop.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// A point mass: gives one node its mass and a step.
class PointMass : public Term {
public:
    PointMass(State& state, Index node, double mass, double step) : step_(step) { state.mass[node] = mass; }
    std::string_view name() const override { return "point mass"; }
    StepVote stable_step() const override { return {step_, "mass", 1, 1}; }

private:
    double step_;
};

/// A unit mass on a unit spring along x, about x = 0; the step that it bears halves at a cycle.
class HalvedSwing : public Term {
public:
    HalvedSwing(State& state, double step, long cycle) : step_(step), cycle_(cycle)
    {
        state.mass[0] = 1;
        state.position[0] = {1, 0, 0};
    }
    std::string_view name() const override { return "swing"; }
    StepVote stable_step() const override { return {step_, "mass", 1, 1}; }
    void add_forces(const Clock& clock, State& state) override
    {
        if (clock.cycle == cycle_) step_ *= 0.5;
        const double x = state.position[0].x;
        state.force[0].x -= x;
        energy_ = 0.5 * x * x;
    }
    void constrain(const Clock& clock, State& state) override
    {
        if (clock.last_step == 0) return;
        const double force = state.force[0].x;
        gained += 0.25 * (clock.last_step - clock.step) * clock.velocity_step() * force * force;
    }
    void report(EnergyLedger& ledger) const override { ledger.internal += energy_; }

    double gained = 0; ///< by central difference whose step changes [energy]

private:
    double step_, energy_ = 0;
    long cycle_;
};

Model one_node_model()
{
    Model model;
    model.nodes.id = {1};
    model.nodes.position = {{0, 0, 1}};
    model.controls.time.step_scale = 1;
    model.controls.time.end_time = 1;
    return model;
}

/// make_scene gives terms in its own order; the mass must be there before walls and loads look at it.
Scene scene_of(const Model& model, double mass, double step)
{
    Scene scene = make_scene(model);
    scene.terms.insert(scene.terms.begin(), std::make_unique<PointMass>(scene.state, 0, mass, step));
    return scene;
}

} // namespace

TEST(ExplicitLoop, FollowsTheParabolaOfConstantForceExactly)
{
    Model model = one_node_model();
    model.nodal_loads.push_back({{0}, {0, 0, -1}, false, none, 4.0, {}});
    Scene scene = scene_of(model, 2.0, 1.0 / 64);
    Recorders none_recorded;
    const Outcome outcome = run(scene, none_recorded);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal);
    EXPECT_EQ(outcome.clock.cycle, 64);
    // Central difference is exact for a constant acceleration of -2: z = 1 - t^2.
    EXPECT_NEAR(scene.state.position[0].z, 1 - outcome.clock.time * outcome.clock.time, 1e-13);
    EXPECT_LT(scene.ledger.balance_error(), 1e-13);
    EXPECT_NEAR(scene.ledger.external_work, 4.0, 1e-12);
}

TEST(ExplicitLoop, WallStopsAMassAndBooksItsEnergy)
{
    Model model = one_node_model();
    RigidWall wall;
    wall.normal = {0, 0, 1};
    model.rigid_walls.push_back(wall);
    InitialVelocity thrown;
    thrown.nodes = {0};
    thrown.translation = {3, 0, -4};
    model.initial_velocities.push_back(thrown);
    Scene scene = make_scene(model);
    scene.terms.clear();
    scene.terms.push_back(std::make_unique<PointMass>(scene.state, 0, 2.0, 0.01));
    scene.terms.push_back(std::make_unique<RigidWallTerm>(model.rigid_walls[0], model, scene.state));
    Recorders none_recorded;
    run(scene, none_recorded);
    EXPECT_NEAR(scene.state.position[0].z, 0, 1e-14);
    EXPECT_DOUBLE_EQ(scene.state.velocity[0].x, 3);
    EXPECT_NEAR(scene.ledger.rigid_wall, 16, 1e-12); // m v_n^2 / 2
    EXPECT_LT(scene.ledger.balance_error(), 1e-13);
}

TEST(ExplicitLoop, DrivenNodeTakesItsWorkFromOutside)
{
    Model model = one_node_model();
    model.curves.push_back({1, "", {}, Curve{{0, 2}, {0, 12}}});
    PrescribedMotion motion;
    motion.nodes = {0};
    motion.direction = {1, 0, 0};
    motion.curve = 0;
    model.prescribed_motions.push_back(motion);
    Scene scene = scene_of(model, 2.0, 0.01);
    Recorders none_recorded;
    const Outcome outcome = run(scene, none_recorded);
    const double t = outcome.clock.time;
    EXPECT_NEAR(scene.state.position[0].x, 3 * t * t, 1e-10);
    // m v(n-1/2) . v(n+1/2) / 2 = m (v^2 - (a dt / 2)^2) / 2
    EXPECT_NEAR(scene.ledger.kinetic, 36 * t * t - 0.03 * 0.03, 1e-10);
    EXPECT_LT(scene.ledger.balance_error(), 1e-12);
}

/// What the book then shows is what the scheme has gained, to round-off: the sum of
/// (last step - step) velocity_step f^2 / (4 m), docs/theory/time_integration.md. The product of the
/// half-step velocities alone is off by (last step - step) f v / 4 in the cycle of the change, first order in
/// the step.
TEST(ExplicitLoop, AStepThatChangesLeavesTheBookExact)
{
    Model model = one_node_model();
    model.controls.time.end_time = 20;
    Scene scene = make_scene(model);
    auto term = std::make_unique<HalvedSwing>(scene.state, 0.1, 100);
    const HalvedSwing& swing = *term;
    scene.terms.push_back(std::move(term));
    Recorders none_recorded;
    run(scene, none_recorded);
    EXPECT_GT(swing.gained, 1e-4);
    EXPECT_NEAR(scene.ledger.total() - scene.ledger.initial_total, swing.gained, 1e-13);
    EXPECT_NEAR(scene.ledger.largest_error, swing.gained, 1e-13);
}

/// NOSOL: the first cycle's forces and results are there, and nothing has moved.
TEST(ExplicitLoop, WithoutASolutionTheRunEndsAtItsStart)
{
    Model model = one_node_model();
    model.controls.time.no_solution = true;
    model.nodal_loads.push_back({{0}, {0, 0, -1}, false, none, 4.0, {}});
    Scene scene = scene_of(model, 2.0, 1.0 / 64);
    Recorders none_recorded;
    const Outcome outcome = run(scene, none_recorded);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal);
    EXPECT_EQ(outcome.clock.cycle, 0);
    EXPECT_EQ(scene.state.position[0].z, 1);
    EXPECT_EQ(scene.state.force[0].z, -4);
    EXPECT_NE(outcome.message.find("NOSOL"), std::string::npos);
}

} // namespace plash
