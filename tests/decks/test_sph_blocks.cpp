#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/support/shared_files.h"

#include <gtest/gtest.h>

namespace plash {

/// Two blocks of elastic-plastic particles (*CONTROL_SPH IDIM = 2) meet head on at 0.02. LS-DYNA's results
/// are not known. What must hold: no momentum in all, mirror symmetry of the two blocks, the balance, and
/// that the yielding blocks stop and part with less than they came with.
TEST(SphBlocks, CollideInBalance)
{
    const auto deck = testing::shared_file("decks/targets/sph_blocks_collide_2d/jednostruko.k");
    PLASH_NEED_SHARED(deck);
    const ReadResult read = read_model(deck.string());
    ASSERT_TRUE(read.ok);
    EXPECT_TRUE(unsupported_keywords(read.report).empty());
    Scene scene = make_scene(read.model);
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_GE(outcome.clock.time, 20.0);
    // 5400 particles of 0.001. The kinetic energy is a product of the velocities on both sides of t = 0, so
    // the forces of the first cycle (the blocks touch) are in it: 1.4e-6 of it here.
    EXPECT_NEAR(scene.ledger.initial_total, 0.5 * 5.4 * 0.01 * 0.01, 1e-9);
    EXPECT_LT(scene.ledger.balance_error(), 0.001);
    EXPECT_GT(scene.ledger.internal, 0.4 * scene.ledger.initial_total);

    Vec3 momentum{};
    double left = 0, right = 0;
    for (std::size_t i = 0; i < scene.state.size(); ++i) {
        momentum += scene.state.mass[i] * scene.state.velocity[i];
        (scene.model.nodes.position[i].x < 3 ? left : right) += scene.state.position[i].x / 2700;
    }
    EXPECT_LT(norm(momentum), 1e-12 * 5.4 * 0.01 * 1000); // 350 steps of round-off
    // The deck's own coordinates have six digits.
    EXPECT_NEAR(left + right, 6.0, 1e-4) << "the blocks are mirror images of each other about x = 3";
    // Blocks that passed through each other would stand 3 - 2 x 0.01 x 20 = 2.6 apart.
    EXPECT_GT(right - left, 2.65);
}

} // namespace plash
