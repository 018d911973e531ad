#include "solver/explicit_loop.h"
#include "tests/support/beam_model.h"
#include "tests/support/history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plash {

namespace {

/// Two masses on a spring of a given law along x; node 1 fixed.
Model oscillator(Record law, std::vector<std::pair<const char*, double>> section, double mass)
{
    Model model;
    model.materials.push_back(std::move(law));
    model.sections.push_back(make_record("SECTION_DISCRETE", std::move(section)));
    Part part;
    part.id = 1;
    part.section = 0;
    part.material = 0;
    model.parts.push_back(part);
    add_node(model, {0, 0, 0});
    add_node(model, {10, 0, 0});
    for (Index node : {0, 1}) {
        model.masses.id.push_back(node + 1);
        model.masses.node.push_back(node);
        model.masses.mass.push_back(mass);
    }
    model.discretes.id.push_back(7);
    model.discretes.part.push_back(0);
    model.discretes.nodes.push_back({0, 1});
    model.discretes.orientation.push_back(none);
    model.discretes.scale.push_back(1);
    model.discretes.initial_offset.push_back(0);
    hold(model, {0}, 7);
    InitialVelocity start;
    start.nodes = {1};
    start.translation = {1, 0, 0};
    model.initial_velocities.push_back(start);
    model.controls.time.step_scale = 0.1;
    return model;
}

} // namespace

TEST(Springs, SwingAtTheirFrequencyInBalance)
{
    Model model = oscillator(make_record("MAT_SPRING_ELASTIC", {{"K", 4}}), {}, 1);
    const double period = 2 * std::numbers::pi / 2;
    model.controls.time.end_time = 2.2 * period;
    Scene scene = make_scene(model);
    std::vector<double> time, way;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        time.push_back(clock.time);
        way.push_back(state.position[1].x - 10);
    }));
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    // A tenth of 2 / sqrt(k (1 / m1 + 1 / m2)); with omega = 2, central difference shortens the period by
    // (omega dt)^2 / 24 = 0.08 %.
    EXPECT_NEAR(outcome.first_step, 0.1 * 2 / std::sqrt(8), 1e-12);
    EXPECT_NEAR(period_of(time, way), period, 0.003 * period);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

TEST(Springs, WithAClearanceCarryCompressionAloneOnceItIsClosed)
{
    // The mass flies away from node 1 first: nothing holds it. Thrown towards it, it meets the spring after
    // 0.5.
    Model away = oscillator(make_record("MAT_SPRING_ELASTIC", {{"K", 4}}), {{"CL", 0.5}}, 1);
    away.controls.time.end_time = 1;
    Scene free = make_scene(away);
    Recorders none_wanted;
    run(free, none_wanted);
    EXPECT_NEAR(free.state.velocity[1].x, 1, 1e-12);

    Model towards = oscillator(make_record("MAT_SPRING_ELASTIC", {{"K", 4}}), {{"CL", 0.5}}, 1);
    towards.initial_velocities[0].translation = {-1, 0, 0};
    // The step in which the gap closes or opens leaves up to k (v dt)^2 / 8 unbalanced: 4e-4 of the energy.
    towards.controls.time.step_scale = 0.02;
    towards.controls.time.end_time =
        0.5 + 0.5 * std::numbers::pi + 0.2; // there, half a period of omega = 2, back
    Scene caught = make_scene(towards);
    double nearest = 10;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>(
        [&](const Clock&, const State& state) { nearest = std::min(nearest, state.position[1].x); }));
    run(caught, recorders);
    EXPECT_NEAR(nearest, 10 - 0.5 - 0.5, 2e-3); // v / omega beyond the gap
    EXPECT_NEAR(caught.state.velocity[1].x, 1, 2e-3);
    EXPECT_LT(caught.ledger.balance_error(), 4e-4);
}

TEST(Springs, DampersTakeTheEnergyThatTheBookShows)
{
    Model model = oscillator(make_record("MAT_DAMPER_VISCOUS", {{"DC", 0.5}}), {}, 1);
    model.controls.time.end_time = 4;
    model.controls.time.initial_step = 0.01;
    add_curve(model, {0, 100}, {0.01, 0.01});
    model.controls.time.largest_step_curve = 0;
    Scene scene = make_scene(model);
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal);
    // v = exp(-c t / m) with the force of the velocity half a step before: a factor 1 - c dt / m each step,
    // and half of that in the first, which leads from 0 to dt / 2. One step more than the time shows has been
    // taken.
    const double exact = (1 - 0.5 * 0.005) * std::pow(1 - 0.005, static_cast<double>(outcome.clock.cycle));
    EXPECT_NEAR(scene.state.velocity[1].x, exact, 1e-9);
    EXPECT_NEAR(scene.ledger.internal, 0.5 * (1 - std::exp(-4)), 0.005);
    EXPECT_EQ(scene.ledger.springs, scene.ledger.internal); // what glstat shows as spring and damper energy
    EXPECT_LT(scene.ledger.balance_error(), 0.005);
}

TEST(Springs, TorsionTurnsAboutItsAxisAndTheGroundHolds)
{
    Model model = oscillator(make_record("MAT_SPRING_ELASTIC", {{"K", 4}}), {{"DRO", 1}}, 1);
    Record orientation = make_record("DEFINE_SD_ORIENTATION", {{"IOP", 0}, {"ZT", 2}});
    model.others.push_back(orientation);
    model.discretes.orientation[0] = 0;
    model.discretes.nodes[0] = {1, none};
    model.initial_velocities.clear();
    const double period = 2 * std::numbers::pi * std::sqrt(0.25 / 4);
    model.controls.time.end_time = 2.2 * period;
    Scene scene = make_scene(model);
    ASSERT_TRUE(scene.state.rotational());
    scene.state.inertia[1] = 0.25;
    scene.state.angular_velocity[1] = {0, 0, 1};
    std::vector<double> time, rate;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        time.push_back(clock.time);
        rate.push_back(state.angular_velocity[1].z);
    }));
    ASSERT_EQ(run(scene, recorders).termination, Outcome::Termination::normal);
    EXPECT_NEAR(period_of(time, rate), period, 0.003 * period);
    EXPECT_LT(scene.ledger.balance_error(), 2e-3);
}

} // namespace plash
