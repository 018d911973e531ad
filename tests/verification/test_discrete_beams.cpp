#include "solver/explicit_loop.h"
#include "tests/support/beam_model.h"
#include "tests/support/each_cycle.h"
#include "tests/support/history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plash {

namespace {

using Fields = std::vector<std::pair<const char*, double>>;

/// One discrete beam along x from the origin; RO = 1, so that VOL is its mass. Without a third node.
Model one_beam(Record material, Fields section, double length)
{
    section.insert(section.begin(), {"ELFORM", 6});
    Model model = beam_model(std::move(material), std::move(section), length, 1);
    model.beams.nodes[0][2] = none;
    if (length == 0) model.nodes.position[1] = {0, 0, 0};
    return model;
}

void start(Model& model, Index node, const Vec3& velocity, const Vec3& spin = {})
{
    InitialVelocity entry;
    entry.nodes = {node};
    entry.translation = velocity;
    entry.angular_velocity = spin;
    entry.set_rotation = true;
    model.initial_velocities.push_back(entry);
}

Record spring(Fields fields)
{
    fields.insert(fields.begin(), {"RO", 1});
    return make_record("MAT_LINEAR_ELASTIC_DISCRETE_BEAM", std::move(fields));
}

/// A discrete beam's state at the end of a run.
ElementResults::DiscreteBeam state_of(const Scene& scene)
{
    ElementResults results;
    results.springs_wanted = true;
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    return results.discrete_beams.at(0);
}

void run_to_end(
    Scene& scene, EachCycle::Function look = [](const Clock&, const State&) {})
{
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>(std::move(look)));
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
}

Vec3 angular_momentum(const State& state)
{
    Vec3 sum{};
    for (Index node : {0, 1}) {
        sum += state.mass[node] * cross(state.position[node], state.velocity[node]);
        sum += state.inertia[node] * state.angular_velocity[node];
    }
    return sum;
}

} // namespace

TEST(DiscreteBeams, EachFreedomSwingsAtItsFrequencyInBalance)
{
    // Node 1 held; half the mass 2 and half the inertia 0.5 swing: omega = sqrt(k / 1), sqrt(k / 0.25).
    for (int freedom = 0; freedom < 6; ++freedom) {
        const char* names[] = {"TKR", "TKS", "TKT", "RKR", "RKS", "RKT"};
        Model model = one_beam(spring({{names[freedom], 9}}), {{"VOL", 2}, {"INER", 0.5}}, 0);
        hold(model, {0}, 63);
        Vec3 way{};
        way.*vector_component[freedom % 3] = 1;
        start(model, 1, freedom < 3 ? way : Vec3{}, freedom < 3 ? Vec3{} : way);
        const double omega = freedom < 3 ? 3 : 6, period = 2 * std::numbers::pi / omega;
        model.controls.time.end_time = 3.2 * period;
        model.controls.time.step_scale = 0.05;
        Scene scene = make_scene(model);
        std::vector<double> time, rate;
        run_to_end(scene, [&](const Clock& clock, const State& state) {
            time.push_back(clock.time);
            const auto& rates = freedom < 3 ? state.velocity : state.angular_velocity;
            rate.push_back(rates[1].*vector_component[freedom % 3]);
        });
        // The step is 0.05 sqrt(mass / k) of the whole beam: (omega dt)^2 / 24 = 2.1e-4 of the period.
        EXPECT_NEAR(period_of(time, rate), period * (1 - 2.1e-4), 2e-5 * period) << names[freedom];
        EXPECT_LT(scene.ledger.balance_error(), 2e-5);
    }
}

TEST(DiscreteBeams, FirstStepIsThatOfTheirOwnMass)
{
    // LS-DYNA: 'time step size depends on volume, density and stiffness'; two halves of 2 on k: sqrt(2 / 9).
    Model model = one_beam(spring({{"TKR", 9}}), {{"VOL", 2}}, 0);
    model.masses.id = {1, 2};
    model.masses.node = {0, 1};
    model.masses.mass = {100, 100};
    model.controls.time.end_time = 0.01;
    model.controls.time.step_scale = 0.9;
    Scene scene = make_scene(model);
    Recorders none_wanted;
    EXPECT_NEAR(run(scene, none_wanted).first_step, 0.9 * std::sqrt(2.0 / 9), 1e-12);
}

TEST(DiscreteBeams, LocalAxesOfTheirCoordinateSystem)
{
    const double angle = 0.4;
    Model model = one_beam(spring({{"TKR", 5}, {"TKS", 11}}), {{"VOL", 2}, {"CID", 8}}, 0);
    CoordinateSystem system;
    system.id = 8;
    system.axes = {Vec3{std::cos(angle), std::sin(angle), 0}, Vec3{-std::sin(angle), std::cos(angle), 0},
                   Vec3{0, 0, 1}};
    model.coordinate_systems.push_back(system);
    hold(model, {0}, 63);
    add_curve(model, {0, 1}, {0, 1});
    PrescribedMotion motion;
    motion.nodes = {1};
    motion.kind = PrescribedMotion::Kind::displacement;
    motion.curve = 0;
    motion.direction = {1, 0, 0};
    motion.scale = 0.01;
    model.prescribed_motions.push_back(motion);
    hold(model, {1}, 6);
    model.controls.time.end_time = 1;
    Scene scene = make_scene(model);
    run_to_end(scene);
    const double way = scene.state.position[1].x;
    ASSERT_GT(way, 0.009);
    const auto beam = state_of(scene);
    EXPECT_NEAR(beam.resultant[0], 5 * way * std::cos(angle), 1e-12);
    EXPECT_NEAR(beam.resultant[1], -11 * way * std::sin(angle), 1e-12);
}

TEST(DiscreteBeams, StressedBeamTurnsWithoutChange)
{
    // A beam of finite length with forces and moments at the start, carried round once by its nodes.
    for (const double scoor : {-3.0, 3.0, 2.0, -2.0, 13.0}) {
        Model model = one_beam(spring({{"TKR", 5},
                                       {"TKS", 4},
                                       {"TKT", 3},
                                       {"RKS", 2},
                                       {"FOR", 1},
                                       {"FOS", 0.5},
                                       {"FOT", -0.25},
                                       {"MOS", 0.125}}),
                               {{"VOL", 2}, {"INER", 0.5}, {"SCOOR", scoor}}, 2);
        add_curve(model, {0, 1}, {1, 1});
        for (Index node : {0, 1}) {
            for (const bool own : {false, true}) {
                PrescribedMotion motion; // round the z axis through the origin, and about itself
                motion.nodes = {node};
                motion.direction = {0, 0, 1};
                motion.rotation = own;
                motion.orbit = !own;
                motion.only_component = own;
                motion.curve = 0;
                motion.scale = 2 * std::numbers::pi;
                if (node == 0 && !own) continue;
                model.prescribed_motions.push_back(motion);
            }
        }
        hold(model, {0}, 7);
        hold(model, {1}, 4);
        hold(model, {0, 1}, 8 | 16);
        model.controls.time.end_time = 1;
        model.controls.time.step_scale = 0.01;
        Scene scene = make_scene(model);
        run_to_end(scene);
        const auto beam = state_of(scene);
        const double wanted[] = {1, 0.5, -0.25, 0, 0.125, 0};
        // Chords against arcs: 2 pi r theta^2 / 12 in a turn of steps theta = 0.02, times the stiffness:
        // 0.002.
        for (int i = 0; i < 6; ++i) EXPECT_NEAR(beam.resultant[i], wanted[i], 5e-3) << scoor << " " << i;
    }
}

TEST(DiscreteBeams, FiniteLengthKeepsAngularMomentumAndEnergy)
{
    for (const double scoor : {-3.0, 2.0, 12.0}) {
        Model model =
            one_beam(spring({{"TKR", 50}, {"TKS", 40}, {"TKT", 30}, {"RKR", 5}, {"RKS", 6}, {"RKT", 7}}),
                     {{"VOL", 2}, {"INER", 0.5}, {"SCOOR", scoor}}, 2);
        start(model, 0, {0.1, 0.2, -0.3}, {0.3, -0.1, 0.2});
        start(model, 1, {-0.2, 0.3, 0.1}, {0.1, 0.2, -0.3});
        model.controls.time.end_time = 20;
        model.controls.time.step_scale = 0.1;
        Scene scene = make_scene(model);
        Vec3 first{};
        bool started = false;
        double worst = 0;
        run_to_end(scene, [&](const Clock&, const State& state) {
            // With places at n and velocities at n + 1/2 it is exact: each cycle adds x_n x F_n and M_n.
            if (!started) first = angular_momentum(state);
            started = true;
            worst = std::max(worst, norm(angular_momentum(state) - first));
        });
        EXPECT_LT(worst, 1e-11 * norm(first)) << scoor;
        EXPECT_LT(scene.ledger.balance_error(), 2e-3) << scoor;
    }
}

TEST(DiscreteBeams, SidDamperStopsAMassByItsOrifice)
{
    // One large orifice and the linear term alone: v' = -c / m v with c = K C1 A / A0 constant while it is
    // open.
    Record material =
        make_record("MAT_SID_DAMPER_DISCRETE_BEAM",
                    {{"ST", 10}, {"D", 2}, {"R", 0.5}, {"K", 2}, {"C", 0.6}, {"STF", 100}, {"C1", 0.25}});
    Table table;
    table.columns = {"ORFLOC", "ORFRAD", "SF", "DC"};
    table.values = {1, 0, 1, 0};
    table.lines = {1};
    material.tables.push_back(table);
    Model model = one_beam(material, {}, 10);
    hold(model, {0}, 7);
    model.masses.id = {1};
    model.masses.node = {1};
    model.masses.mass = {2};
    start(model, 1, {-3, 0, 0});
    model.controls.time.end_time = 2;
    model.controls.time.step_scale = 0.01;
    Scene scene = make_scene(model);
    double speed = 0, length = 0;
    run_to_end(scene, [&](const Clock& clock, const State& state) {
        speed = state.velocity[1].x;
        length = state.position[1].x - 0.5 * clock.last_step * speed;
    });
    const double decay = 2 * 0.25 * 4 / 2; // K C1 A / A0 / m, A / A0 = (2 / 1)^2
    EXPECT_NEAR(speed, -3 * std::exp(-2 * decay), 1e-3);
    EXPECT_NEAR(length, 10 - 3 / decay * (1 - std::exp(-2 * decay)), 2e-2);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

TEST(DiscreteBeams, CableIsSlackUntilItsLengthIsReached)
{
    // A mass flies off at speed 1 with 0.5 of slack; E A / N = 8: caught, it turns round with the same speed.
    Model model = one_beam(make_record("MAT_CABLE_DISCRETE_BEAM", {{"RO", 0.1}, {"E", 40}}),
                           {{"CA/DOFN1", 0.5}, {"OFFSET/DOFN2", -0.5}}, 2);
    hold(model, {0}, 7);
    model.masses.id = {1};
    model.masses.node = {1};
    model.masses.mass = {2 - 0.5 * 0.1 * 0.5 * 2};
    start(model, 1, {1, 0, 0});
    const double contact = std::numbers::pi / std::sqrt(8.0 / 2);
    model.controls.time.end_time = 0.5 + contact + 0.2;
    model.controls.time.step_scale = 0.1;
    Scene scene = make_scene(model);
    double speed = 0, furthest = 0;
    run_to_end(scene, [&](const Clock&, const State& state) {
        speed = state.velocity[1].x;
        furthest = std::max(furthest, state.position[1].x);
    });
    EXPECT_NEAR(speed, -1, 2e-3);
    EXPECT_NEAR(furthest, 2.5 + 1 / std::sqrt(8.0 / 2), 1e-3);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
    // VOL = 0: the volume of a cable is that of its length.
    EXPECT_NEAR(scene.state.mass[1], 2, 1e-12);
}

TEST(DiscreteBeams, BrokenBeamCarriesNothingAndIsBooked)
{
    Model model = one_beam(make_record("MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM",
                                       {{"RO", 1}, {"TKR", 100}, {"LCPDR", 1}, {"UFAILR", 0.3}}),
                           {{"VOL", 2}}, 0);
    add_curve(model, {0, 1}, {2, 2});
    hold(model, {0}, 7);
    start(model, 1, {2, 0, 0});
    model.controls.time.end_time = 0.4;
    model.controls.time.step_scale = 0.01;
    Scene scene = make_scene(model);
    run_to_end(scene);
    // Elastic to 0.02 at 2, then 2 along to 0.3: 0.02 + 0.56; the rest goes on as motion.
    EXPECT_NEAR(scene.ledger.eroded_internal, 0.58, 0.005);
    EXPECT_NEAR(0.5 * scene.state.velocity[1].x * scene.state.velocity[1].x, 2 - 0.58, 0.005);
    EXPECT_EQ(scene.ledger.internal, 0);
    EXPECT_EQ(scene.state.deleted_beams.at(0), 1);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

TEST(DiscreteBeams, WrongSectionsAreNamed)
{
    const auto message = [](Fields section, double length) -> std::string {
        try {
            const Model model = one_beam(spring({{"TKR", 1}}), std::move(section), length);
            make_scene(model);
        } catch (const DeckError& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_NE(message({{"SCOOR", 2}}, 0).find("has no length"), std::string::npos);
    EXPECT_NE(message({{"SCOOR", 5}}, 1).find("SCOOR"), std::string::npos);
    EXPECT_NE(message({{"CID", 3}}, 1).find("coordinate system 3"), std::string::npos);
}

} // namespace plash
