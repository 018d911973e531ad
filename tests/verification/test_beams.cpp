#include "solver/explicit_loop.h"
#include "tests/support/beam_model.h"
#include "tests/support/history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace plash {

namespace {

constexpr FreedomMask all_freedoms = 63;
constexpr double density = 7.8e-6, young_modulus = 210, poisson_ratio = 0.3; // kg, mm, ms, kN

Record steel()
{
    return make_record("MAT_ELASTIC", {{"RO", density}, {"E", young_modulus}, {"PR", poisson_ratio}});
}

using Fields = std::vector<std::pair<const char*, double>>;

/// A rectangle 4 (s, which is z here) by 6 (t, y) as integrated and as resultant section.
Fields integrated()
{
    return {{"ELFORM", 1}, {"SHRF", 5.0 / 6}, {"QR/IRID", 3}, {"TS1", 4}, {"TT1", 6}};
}

Fields resultant_section()
{
    return {{"ELFORM", 2}, {"A", 24}, {"ISS", 4 * 216.0 / 12}, {"ITT", 6 * 64.0 / 12}, {"SA", 20}};
}

/// Static tip displacement under a transverse tip force, reached with damping close to critical.
Vec3 tip_under(const Vec3& direction, double load, Fields section, double length, int count)
{
    Model model = beam_model(steel(), std::move(section), length, count);
    hold(model, {0}, all_freedoms);
    model.nodal_loads.push_back({{static_cast<Index>(count)}, direction, false, none, load, {}});
    const double inertia = std::abs(direction.z) > 0.5 ? 32 : 72;
    const double first_period =
        2 * std::numbers::pi * length * length / 3.516 * std::sqrt(density * 24 / (young_modulus * inertia));
    // With one element the lumped mass swings more slowly and is damped above its critical value.
    model.controls.time.end_time = 12 * first_period;
    Scene scene = make_scene(model);
    scene.terms.push_back(std::make_unique<MassDamping>(2 * 2 * std::numbers::pi / first_period));
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    return scene.state.position[count] - model.nodes.position[count];
}

} // namespace

TEST(Beams, BendAsTheirTheoriesSay)
{
    const double length = 100, load = 1e-4, shear_modulus = young_modulus / 2.6;
    for (const Vec3& direction : {Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const double inertia = direction.z > 0 ? 32 : 72; // s is z: a force along z bends about t
        const double bending = load * length * length * length / (3 * young_modulus * inertia);
        const double shear = load * length / (shear_modulus * 20);
        // The cubic element is exact with one element; the one-point element misses 1 / (4 n^2) of bending.
        const Vec3 one = tip_under(direction, load, resultant_section(), length, 1);
        EXPECT_NEAR(dot(one, direction), bending + shear, 1e-4 * bending);
        const Vec3 eight = tip_under(direction, load, integrated(), length, 8);
        EXPECT_NEAR(dot(eight, direction), bending * (1 - 1.0 / 256) + shear, 1e-4 * bending);
        const Vec3 four = tip_under(direction, load, integrated(), length, 4);
        EXPECT_NEAR(dot(four, direction), bending * (1 - 1.0 / 64) + shear, 1e-4 * bending);
    }
}

TEST(Beams, FirstFrequencyIsThatOfEulerAndBernoulli)
{
    for (const bool points : {true, false}) {
        const double length = 100;
        const int count = 20;
        Model model = beam_model(steel(), points ? integrated() : resultant_section(), length, count);
        hold(model, {0}, all_freedoms);
        const double b = 1.87510406871196; // cos(b) cosh(b) = -1
        const double omega = b * b * std::sqrt(young_modulus * 32 / (density * 24)) / (length * length);
        model.controls.time.end_time = 2.2 * 2 * std::numbers::pi / omega;
        Scene scene = make_scene(model);
        const double sigma = (std::sinh(b) - std::sin(b)) / (std::cosh(b) + std::cos(b));
        for (int node = 0; node <= count; ++node) {
            const double s = b * node / count;
            scene.state.velocity[node].z =
                -1e-3 * (std::cosh(s) - std::cos(s) - sigma * (std::sinh(s) - std::sin(s)));
            scene.state.angular_velocity[node].y =
                1e-3 * (std::sinh(s) + std::sin(s) - sigma * (std::cosh(s) - std::cos(s))) * b / length;
        }
        std::vector<double> time, tip;
        Recorders recorders;
        recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
            time.push_back(clock.time);
            tip.push_back(state.position[count].z);
        }));
        const Outcome outcome = run(scene, recorders);
        ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        // Shear and rotary inertia lower it: Timoshenko's first-order estimate is b^2 / 2 (r / L)^2 (1 + E /
        // kG) times about 2 for this mode = 0.2 %.
        EXPECT_NEAR(period_of(time, tip), 2 * std::numbers::pi / omega, 0.004 * 2 * std::numbers::pi / omega);
        EXPECT_LT(scene.ledger.balance_error(), 1e-3);
    }
}

/// A disc of *ELEMENT_INERTIA at the end of a bar: torsion pendulum, T = 2 pi sqrt(I L / (G J)). The bar's
/// own rotary inertia at its end is nothing beside the disc's.
TEST(Beams, SwingADiscInTorsion)
{
    constexpr double length = 100, torsion = 50, inertia = 1e8, shear_modulus = young_modulus / 2.6;
    Fields section = resultant_section();
    section.push_back({"J", torsion});
    Model model = beam_model(steel(), section, length, 1);
    hold(model, {0}, all_freedoms);
    hold(model, {1}, 1 | 2 | 4 | 16 | 32);
    const auto disc = [=](double yy) {
        return make_record("ELEMENT_INERTIA",
                           {{"NID", 2}, {"IXX", inertia}, {"IYY", yy}, {"IZZ", inertia}, {"MASS", 3}});
    };
    const double period = 2 * std::numbers::pi * std::sqrt(inertia * length / (shear_modulus * torsion));
    model.controls.time.end_time = 1.9 * period; // of some 500 steps each
    model.others.push_back(disc(inertia));
    Scene scene = make_scene(model);
    EXPECT_NEAR(scene.state.mass[1], 3 + 0.5 * density * 24 * length, 1e-12);
    scene.state.angular_velocity[1].x = 1e-6;
    std::vector<double> time, spin;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        time.push_back(clock.time);
        spin.push_back(state.angular_velocity[1].x);
    }));
    const Outcome outcome = run(scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_NEAR(period_of(time, spin), period, 2e-4 * period);
    EXPECT_LT(scene.ledger.balance_error(), 1e-6);

    // Another moment about y makes the node a body with a tensor; about x it swings all the same.
    model.others.back() = disc(0.5 * inertia);
    InitialVelocity initial;
    initial.nodes = {1};
    initial.angular_velocity = {1e-6, 0, 0};
    initial.set_rotation = true;
    model.initial_velocities = {initial};
    Scene other = make_scene(model);
    time.clear();
    spin.clear();
    const Outcome of_tensor = run(other, recorders);
    EXPECT_EQ(of_tensor.termination, Outcome::Termination::normal) << of_tensor.message;
    EXPECT_NEAR(period_of(time, spin), period, 2e-4 * period);
    EXPECT_LT(other.ledger.balance_error(), 1e-6);
    model.others.back() = disc(-inertia);
    EXPECT_THROW(make_scene(model), DeckError);
}

TEST(Beams, RollUpIntoACircle)
{
    // A cantilever under the end moment 2 pi E I / L bends into a full circle: its tip comes back to the
    // clamp. Twelve elements; the end turns by 360 degrees. Held in its plane, since a moment about a fixed
    // axis would throw it out.
    const double length = 100;
    const int count = 12;
    Model model =
        beam_model(steel(), {{"ELFORM", 2}, {"A", 24}, {"ISS", 32}, {"ITT", 32}, {"SA", 20}}, length, count);
    hold(model, {0}, all_freedoms);
    for (Index node = 1; node <= count; ++node) hold(model, {node}, 2 + 8 + 32);
    const double first_period =
        2 * std::numbers::pi * length * length / 3.516 * std::sqrt(density * 24 / (young_modulus * 32));
    model.controls.time.end_time = 24 * first_period;
    add_curve(model, {0, 6 * first_period, 1e9}, {0, 1, 1});
    const double moment = 2 * std::numbers::pi * young_modulus * 32 / length;
    model.nodal_loads.push_back({{count}, {0, -1, 0}, true, 0, moment, {}});
    Scene scene = make_scene(model);
    scene.terms.push_back(std::make_unique<MassDamping>(2 * 2 * std::numbers::pi / first_period));
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    // Twelve straight chords that each turn by 30 degrees close exactly; the damped motion leaves less than
    // 1e-3 of the length.
    EXPECT_LT(norm(scene.state.position[count]), 2e-3 * length);
    // The middle of the beam stands a chord polygon's diameter away.
    const double chord = length / count, diameter = chord / std::sin(std::numbers::pi / count);
    EXPECT_NEAR(norm(scene.state.position[count / 2]), diameter, 3e-3 * diameter);
}

TEST(Trusses, CarryTheBarWaveAndNoMoments)
{
    const double length = 100, speed = std::sqrt(young_modulus / density);
    const int count = 200;
    Model model = beam_model(steel(), {{"ELFORM", 3}, {"A", 10}}, length, count);
    for (int i = 0; i <= count; ++i) hold(model, {static_cast<Index>(i)}, 2 + 4);
    InitialVelocity all;
    for (int i = 0; i <= count; ++i) all.nodes.push_back(i);
    all.translation = {-1, 0, 0};
    model.initial_velocities.push_back(all);
    hold(model, {0}, 1);
    model.controls.time.end_time = 0.5 * length / speed;
    Scene scene = make_scene(model);
    EXPECT_FALSE(scene.state.rotational());
    Recorders recorders;
    ASSERT_EQ(run(scene, recorders).termination, Outcome::Termination::normal);
    ElementResults results;
    results.beams.resize(model.beams.size());
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    // Behind the front: -rho c v, in its mean (the front rings).
    double mean = 0;
    for (int i = 10; i < 60; ++i) mean += results.beams[i].axial / 50;
    EXPECT_NEAR(mean, -10 * density * speed * 1, 0.01 * 10 * density * speed);
    EXPECT_LT(std::abs(results.beams[190].axial), 1e-3 * 10 * density * speed);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

namespace {

Record weld(Fields more)
{
    Fields fields{{"RO", density}, {"E", young_modulus}, {"PR", poisson_ratio}, {"SIGY", 0.64}, {"EH", 9.5}};
    fields.insert(fields.end(), more.begin(), more.end());
    return make_record("MAT_SPOTWELD", fields);
}

Model pulled_weld(Fields more, double speed)
{
    Model model = beam_model(weld(std::move(more)), {{"ELFORM", 9}, {"CST", 1}, {"TS1", 10}}, 12, 1);
    hold(model, {0}, all_freedoms);
    hold(model, {1}, all_freedoms & ~1u);
    model.prescribed_motions.push_back({});
    PrescribedMotion& motion = model.prescribed_motions.back();
    motion.nodes = {1};
    motion.direction = {1, 0, 0};
    motion.scale = speed;
    return model;
}

ElementResults::BeamState weld_state(const Scene& scene)
{
    ElementResults results;
    results.beams.resize(scene.model.beams.size());
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    return results.beams[0];
}

} // namespace

TEST(SpotWelds, HardenAndBreakAtTheirAxialForce)
{
    const double area = 25 * std::numbers::pi, strain = std::log((12 + 0.5) / 12.0);
    {
        Model model = pulled_weld({}, 0.1);
        model.controls.time.end_time = 5;
        Scene scene = make_scene(model);
        Recorders recorders;
        ASSERT_EQ(run(scene, recorders).termination, Outcome::Termination::normal);
        // sigma = (SIGY + EH eps) / (1 + EH / E): EH is the slope over plastic strain.
        const double stress = (0.64 + 9.5 * strain) / (1 + 9.5 / young_modulus);
        const double last = 0.1 * 5 / 12.5 * 1e-2; // the last step may end short of the end
        EXPECT_NEAR(weld_state(scene).axial, area * stress, last * area * stress);
        EXPECT_NEAR(weld_state(scene).plastic_strain, strain - stress / young_modulus, last);
    }
    Model model = pulled_weld({{"NRR", 60}, {"NRS", 10}}, 0.1);
    model.controls.time.end_time = 5;
    Scene scene = make_scene(model);
    double largest = 0;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>(
        [&](const Clock&, const State&) { largest = std::max(largest, weld_state(scene).axial); }));
    ASSERT_EQ(run(scene, recorders).termination, Outcome::Termination::normal);
    ASSERT_EQ(scene.state.deleted_beams.size(), 1u);
    EXPECT_EQ(scene.state.deleted_beams[0], 1);
    EXPECT_EQ(weld_state(scene).axial, 0);
    // The force of the last cycle before 60: one cycle adds E A v dt / L.
    EXPECT_LT(largest, 60);
    EXPECT_GT(largest, 60 - 1.5 * young_modulus * area * 0.1 * 2.2e-3 / 12);
}

TEST(SpotWelds, PreloadIsTheForceOfTheCurveAndBalances)
{
    Model model = beam_model(weld({}), {{"ELFORM", 9}, {"CST", 1}, {"TS1", 10}}, 12, 1);
    // The weld pulls two heavy masses together; a truss beside it holds them apart.
    for (Index node : {0, 1}) {
        model.masses.id.push_back(node + 1);
        model.masses.node.push_back(node);
        model.masses.mass.push_back(1e-2);
        hold(model, {node}, all_freedoms & ~1u);
    }
    Part bar = model.parts[0];
    bar.id = 2;
    bar.section = 1;
    bar.material = 1;
    model.parts.push_back(bar);
    model.sections.push_back(make_record("SECTION_BEAM", {{"ELFORM", 3}, {"A", 50}}));
    model.materials.push_back(steel());
    model.beams.id.push_back(2);
    model.beams.part.push_back(1);
    model.beams.nodes.push_back({0, 1, none});
    add_curve(model, {0, 1}, {0, 20});
    model.beam_preloads.push_back({{0}, 0, 1, false, {}});
    model.controls.time.end_time = 2;
    Scene scene = make_scene(model);
    double worst = 0;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State&) {
        if (clock.time < 1) worst = std::max(worst, std::abs(weld_state(scene).axial - 20 * clock.time));
    }));
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_LT(worst, 1e-9);
    // Afterwards the bar of 50 and the weld share: both go on vibrating a little about 20.
    EXPECT_NEAR(weld_state(scene).axial, 20, 0.4);
    EXPECT_GT(scene.ledger.preload_work, 0);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

} // namespace plash
