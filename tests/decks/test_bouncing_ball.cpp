#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/support/shared_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plash {

namespace {

/// Follows the ball: mean velocity towards the wall and the lowest node.
class BallWatch : public Recorder {
public:
    double lowest = 1e30, last_velocity = 0;

    double next_time() const override { return -1; }
    void write(const Snapshot& snapshot) override
    {
        double momentum = 0, mass = 0;
        for (std::size_t node = 0; node < snapshot.state.size(); ++node) {
            momentum += snapshot.state.mass[node] * snapshot.state.velocity[node].y;
            mass += snapshot.state.mass[node];
            lowest = std::min(lowest, snapshot.state.position[node].y);
        }
        last_velocity = momentum / mass;
    }
};

} // namespace

class BouncingBall : public ::testing::TestWithParam<const char*> {};

/// A Mooney-Rivlin ball (30 mm/ms) bounces from a planar wall at y = -22. LS-DYNA's results are not known; a
/// rubber ball must leave with most of its speed, no node may pass the wall, and the balance is asked to be
/// within 1 %.
TEST_P(BouncingBall, ReboundsInBalance)
{
    const auto deck =
        testing::shared_file("decks/targets/bouncing_ball_rigidwall/" + std::string(GetParam()));
    PLASH_NEED_SHARED(deck);
    const ReadResult read = read_model(deck.string());
    ASSERT_TRUE(read.ok);
    EXPECT_TRUE(unsupported_keywords(read.report).empty());
    Scene scene = make_scene(read.model);
    Recorders recorders;
    auto watch = std::make_unique<BallWatch>();
    const BallWatch& ball = *watch;
    recorders.push_back(std::move(watch));
    const Outcome outcome = run(scene, recorders);

    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_GE(outcome.clock.time, 10.0);
    EXPECT_LT(scene.ledger.balance_error(), 0.01);
    EXPECT_GT(ball.lowest, -22 - 1e-9);
    EXPECT_LT(ball.lowest, -22 + 1e-6) << "the ball never reached the wall";
    EXPECT_GT(ball.last_velocity, 15) << "rebound slower than half of the 30 mm/ms of the impact";
    EXPECT_LT(ball.last_velocity, 30);
}

INSTANTIATE_TEST_SUITE_P(Targets, BouncingBall, ::testing::Values("bouncyball_v1.k", "bouncyball_v2.k"),
                         [](const auto& info) { return std::string(info.param).substr(0, 13); });

} // namespace plash
