#include "conditions/body_loads.h"
#include "materials/elastic.h"
#include "sph/solid_law.h"
#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

/// Particles that begin or cease to act on others: the balance must not see it. Forces that begin or end in
/// the middle of a step and are booked over all of it leave an error of the first order in the step. With
/// smoothing lengths that stay, fluids keep their energy to second order otherwise, so a quarter of the step
/// must leave a sixteenth of the error. Solids and corrected gradients are of first order by themselves;
/// theirs must stay near what it is without a switch.
namespace plash {

namespace {

/// What a body is made of and how its pairs are weighed.
struct Form {
    const char* name;
    bool volume_weighted, renormalised, solid;
    double largest; ///< error of the coarse step [-]
    bool second_order() const { return !renormalised && !solid; }
};
constexpr Form forms[] = {{"plain", false, false, false, 3e-3},
                          {"fluid", true, false, false, 3e-3},
                          {"corrected fluid", true, true, false, 1e-2},
                          {"corrected solid", false, true, true, 1.2e-3},
                          {"solid", false, false, true, 1e-3}};

/// Keeps the step as it is: half of a time of the sound over a spacing.
class Pace : public Term {
public:
    std::string_view name() const override { return "pace"; }
    StepVote stable_step() const override { return {0.5, "pace"}; }
};

/// A squeezed block of 8 x 5 x 5, disturbed, with its options; a lateral speed makes viscosity work.
struct Block {
    ParticleWorld world;

    explicit Block(const Form& form)
    {
        world.options.volume_weighted = form.volume_weighted;
        world.options.renormalised = form.renormalised;
        world.options.viscosity = {1, 0.5};
        auto positions = lattice({0, 0, 0}, 8, 5, 5, 1.0);
        disturb(positions, 0.05, 3);
        if (form.solid) {
            world.add_part(std::make_shared<SolidParticleLaw<Elastic>>(Elastic{1.0, 0.9, 0.25}), 1, positions,
                           1, 1.3);
        } else {
            TestLinear fluid(1, 1);
            fluid.relative_volume = 0.95;
            world.add_part(fluid, positions, 1 / 0.95, 1.3);
        }
        PartConstants& constants = world.parts[0].constants;
        constants.smallest_smoothing = constants.largest_smoothing = constants.smoothing;
        world.open_state();
        for (std::size_t i = 0; i < positions.size(); ++i)
            world.state.velocity[i] = {-0.01 * (positions[i].x - 4), 0.03 * std::sin(positions[i].x),
                                       -0.02 * (positions[i].z - 2.5)};
    }

    /// Largest error of the balance over the largest turnover of energy [-].
    double error(double step_scale, double end)
    {
        world.model.controls.time.step_scale = step_scale;
        world.model.controls.time.end_time = end;
        Scene scene = world.make_scene_of_particles();
        scene.terms.push_back(std::make_unique<Pace>());
        if (!world.model.body_loads.empty())
            scene.terms.push_back(std::make_unique<BodyLoads>(scene.model, scene.state));
        Recorders nobody;
        const Outcome outcome = run(scene, nobody);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        departed = world.body->departed()[0].count;
        return scene.ledger.balance_error();
    }
    long departed = 0;

    /// A node without mass that goes along x.
    Index add_towed_node()
    {
        const auto node = static_cast<Index>(world.model.nodes.id.size());
        world.model.nodes.id.push_back(node + 1);
        world.model.nodes.position.push_back({});
        world.state.position.push_back({});
        world.state.velocity.push_back({0.5, 0, 0});
        world.state.force.push_back({});
        world.state.mass.push_back(0);
        return node;
    }
};

/// Errors with a step, and with a quarter of it.
template <class Prepare>
void expect_balance(double end, Prepare&& prepare)
{
    for (const Form& form : forms) {
        double errors[2];
        for (int i = 0; i < 2; ++i) {
            Block block(form);
            prepare(block);
            errors[i] = block.error(i == 0 ? 0.2 : 0.05, end);
            if (block.world.options.box) {
                EXPECT_GT(block.departed, 20) << form.name;
            }
        }
        EXPECT_LT(errors[0], form.largest) << form.name;
        if (form.second_order()) {
            EXPECT_GT(errors[0] / errors[1], 14) << form.name;
        }
    }
}

} // namespace

TEST(SphSwitches, NobodyIsSwitched)
{
    expect_balance(6, [](Block&) {});
}

TEST(SphSwitches, BirthAndDeathOfAPartAreBookedExactly)
{
    expect_balance(6, [](Block& block) {
        block.world.parts[0].birth = 2;
        block.world.parts[0].death = 4;
    });
}

TEST(SphSwitches, BirthAndDeathOfAllAreBookedExactly)
{
    expect_balance(6, [](Block& block) {
        block.world.options.birth = 2;
        block.world.options.death = 4;
    });
}

TEST(SphSwitches, WhoLeavesIsBookedExactly)
{
    expect_balance(8, [](Block& block) { block.world.options.box = {{-10, -10, -10}, {7.45, 4.5, 4.5}}; });
}

/// A region as wide as three particles goes along the block: those ahead wake, those behind fall asleep.
void add_travelling_region(Block& block)
{
    ActiveRegion region;
    region.parts = {0};
    region.outer = {{1.5, -20, -20}, {4.5, 20, 20}};
    region.node = block.add_towed_node();
    block.world.options.regions = {region};
}

TEST(SphSwitches, FallingAsleepAndWakingAreBookedExactly)
{
    expect_balance(6, add_travelling_region);
}

/// A load that has worked on particles over the whole step in which they fall asleep, or leave.
TEST(SphSwitches, LoadsOnThoseThatFallAsleepOrLeaveAreBookedExactly)
{
    BodyLoad load;
    load.direction = {0, 0, 1};
    load.scale = 0.1;
    expect_balance(6, [&](Block& block) {
        add_travelling_region(block);
        block.world.model.body_loads.push_back(load);
    });
    expect_balance(8, [&](Block& block) {
        block.world.options.box = {{-10, -10, -10}, {7.45, 4.5, 4.5}};
        block.world.model.body_loads.push_back(load);
    });
}

} // namespace plash
