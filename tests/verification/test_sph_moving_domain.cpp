#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

/// Periodic planes that go along with a node (*PLASH_SPH_MOVING_PERIODIC).
namespace plash {

namespace {

constexpr double tank_speed = 2, tank_length = 2, tank_spacing = 0.05, tank_sound = 20;

/// Moves the last node along x.
class Towing : public Term {
public:
    std::string_view name() const override { return "towing"; }
    void add_forces(const Clock&, State& state) override { state.velocity.back() = {tank_speed, 0, 0}; }
    void after_motion(const Clock& clock, State& state) override
    {
        state.position.back().x += clock.step * tank_speed;
    }
};

struct Channel {
    ParticleWorld world;
    std::vector<Vec3> start;

    explicit Channel(double calm)
    {
        world.options.dimension = 2;
        world.options.kernel = Kernel::wendland_c2;
        world.options.viscosity = {0, 0};
        world.options.mirrors = {{{0, 0, 0}, {0, 1, 0}, false, {}}, {{0, 0.5, 0}, {0, -1, 0}, false, {}}};
        start = lattice({0, 0, 0}, 40, 10, 1, tank_spacing);
        world.add_part(TestLinear(1, tank_sound), start, tank_spacing * tank_spacing, 1.3 * tank_spacing);
        world.model.nodes.id.push_back(1000);
        world.model.nodes.position.push_back({1, 1, 0});
        world.options.periods = {{{0, 0, 0}, {tank_length, 0, 0}, static_cast<Index>(start.size()), calm}};
        world.open_state();
        world.model.controls.time.step_scale = 0.5;
    }

    Scene make()
    {
        Scene scene = world.make_scene_of_particles();
        scene.terms.insert(scene.terms.begin(), std::make_unique<Towing>());
        return scene;
    }
};

double kinetic_of(const Scene& scene)
{
    double sum = 0;
    for (std::size_t i = 0; i < scene.state.size(); ++i) {
        sum += 0.5 * scene.state.mass[i] * dot(scene.state.velocity[i], scene.state.velocity[i]);
    }
    return sum;
}

struct Disturbance {
    double left = 0;          ///< share of its kinetic energy
    double balance_error = 0; ///< of the run
};

/// What is left of a disturbance after the domain has moved by two of its lengths.
Disturbance pass_over_a_disturbance(double calm)
{
    Channel channel(calm);
    for (std::size_t i = 0; i < channel.start.size(); ++i) {
        const double x = channel.start[i].x - 1.5;
        channel.world.state.velocity[i].y =
            0.2 * std::exp(-40 * x * x) * std::cos(2 * M_PI * channel.start[i].y);
        channel.world.state.velocity[i].x = 0.1 * std::exp(-40 * x * x);
    }
    channel.world.model.controls.time.end_time = 2 * tank_length / tank_speed;
    Scene scene = channel.make();
    const double before = kinetic_of(scene);
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    return {kinetic_of(scene) / before, scene.ledger.balance_error()};
}

} // namespace

TEST(SphMovingDomain, StillWaterStaysStillWhileTheDomainPassesOverIt)
{
    Channel channel(0.3);
    channel.world.model.controls.time.end_time = 3.3 * tank_length / tank_speed;
    Scene scene = channel.make();
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_EQ(channel.world.body->items(), channel.start.size());
    for (std::size_t i = 0; i < channel.start.size(); ++i) {
        const Vec3 moved = scene.state.position[i] - channel.start[i];
        const double periods = moved.x / tank_length;
        EXPECT_NEAR(periods, std::round(periods), 1e-9);
        EXPECT_GE(std::round(periods), 3);
        EXPECT_LT(std::abs(moved.y), 1e-9);
        EXPECT_LT(norm(scene.state.velocity[i]), 1e-9);
    }
}

TEST(SphMovingDomain, TheWakeDoesNotComeBack)
{
    EXPECT_LT(pass_over_a_disturbance(0.5).left, 0.02);
    const Disturbance without = pass_over_a_disturbance(0);
    EXPECT_GT(without.left, 0.2) << "without the calm zone the wake must stay, or this shows nothing";
    EXPECT_LT(without.balance_error, 0.01);
}

TEST(SphMovingDomain, CalmingIsBooked)
{
    // 0.1 % as measured; 4.6 % when the force of the step in which a particle is calmed is not counted.
    EXPECT_LT(pass_over_a_disturbance(0.5).balance_error, 0.01);
}

} // namespace plash
