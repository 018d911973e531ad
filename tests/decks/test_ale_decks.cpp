#include "ale/fluid_term.h"
#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/support/shared_files.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

struct Finished {
    ReadResult read;
    std::unique_ptr<Scene> scene;
    Outcome outcome;
};

/// A deck of other people, run to its end.
std::unique_ptr<Finished> finish(const std::string& deck)
{
    auto finished = std::make_unique<Finished>();
    finished->read = read_model(deck);
    EXPECT_TRUE(finished->read.ok);
    EXPECT_TRUE(unsupported_keywords(finished->read.report).empty());
    finished->scene = std::make_unique<Scene>(make_scene(finished->read.model));
    Recorders nobody;
    finished->outcome = run(*finished->scene, nobody);
    EXPECT_EQ(finished->outcome.termination, Outcome::Termination::normal) << finished->outcome.message;
    return finished;
}

} // namespace

/// A bird in a mesh that moves with it hits an elastic plate on spot-weld beams (ELFORM 12, METH 1, PRTYPE
/// 4). LS-DYNA's results are not known.
TEST(AleDecks, EulerianBirdRunsInBalance)
{
    const auto deck = testing::shared_file("decks/targets/eulerian_bird_fsi/bird_B.k");
    PLASH_NEED_SHARED(deck);
    const auto bird = finish(deck.string());
    EXPECT_GE(bird->outcome.clock.time, 0.6);
    const EnergyLedger& ledger = bird->scene->ledger;
    EXPECT_LT(ledger.balance_error(), 1e-3);
    // The bird, 0.781 x 0.34^2 x 0.1 at 5, -1, has hit and bent the plate.
    EXPECT_GT(ledger.internal, 0.01 * ledger.initial_total);
}

/// Three O-grids of ambient cells, one with a coupling that never touches. LS-DYNA runs 5,102 cycles
/// of 3.96e-6; see docs/results/eulerian.md.
TEST(AleDecks, WindTunnelRunsToItsEnd)
{
    const auto deck = testing::shared_file("decks/targets/ale_wind_tunnel_fsi/PILLARS_v33.k");
    PLASH_NEED_SHARED(deck);
    const auto tunnel = finish(deck.string());
    EXPECT_GE(tunnel->outcome.clock.time, 0.02);
    EXPECT_LT(tunnel->scene->ledger.balance_error(), 1e-6);
    int meshes = 0;
    for (const auto& term : tunnel->scene->terms) {
        const auto* fluid = dynamic_cast<const EulerianFluid*>(term.get());
        if (!fluid) continue;
        ++meshes;
        EXPECT_FALSE(fluid->block().is_box());
        EXPECT_EQ(fluid->fluid().cell_count(), 525u);
    }
    EXPECT_EQ(meshes, 3);
}

} // namespace plash
