#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/paths.h"

#include <filesystem>
#include <gtest/gtest.h>

/// examples/wedge_drop/wedge.k: a wedge of 30 degrees on water of particles in a trough of solids.
namespace plash {

namespace {

/// Velocity of the wedge, downward [mm/s], from the similarity solution of the wedge that enters at constant
/// speed: force 14.023 rho V^2 s at the penetration s (independent solution, 0.05 %), so that an added mass
/// of half of that acts, d/dt ((m + f/2 rho s^2) V) = m g.
double estimated_wedge_velocity(double velocity, double end)
{
    const double mass = 1e-3 * 1.6394 / 333, fall = 5474,
                 added = 0.5 * 14.023 * 998e-12; // by depth; t, mm, s
    const int steps = 20000;
    double depth = 0;
    for (int i = 0; i < steps; ++i) {
        const double acceleration =
            (mass * fall - 2 * added * depth * velocity * velocity) / (mass + added * depth * depth);
        velocity += end / steps * acceleration;
        depth += end / steps * velocity;
    }
    return velocity;
}

} // namespace

TEST(WedgeDrop, GivesTheWaterTheMomentumOfTheSimilaritySolution)
{
    const std::filesystem::path deck =
        std::filesystem::path(PLASH_SOURCE_DIR) / "examples/wedge_drop/wedge.k";
    ReadResult read = read_model(deck.string());
    ASSERT_TRUE(read.ok);
    read.model.controls.time.end_time = 0.010;
    Scene scene = make_scene(read.model);
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    const double end = outcome.clock.time, fall = 5474 * end;
    const double given = 1046 + fall + scene.state.velocity[0].y; // node 1 belongs to the wedge
    const double wanted = 1046 + fall - estimated_wedge_velocity(1046, end);
    EXPECT_GT(wanted, 100);
    EXPECT_NEAR(given, wanted, 0.08 * wanted); // +5 % as measured; +0.5 % at 15 ms
    EXPECT_LT(scene.ledger.balance_error(), 0.001);
}

} // namespace plash
