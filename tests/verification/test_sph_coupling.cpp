#include "sph/particle_coupling.h"
#include "tests/support/deck_run.h"

#include <cmath>
#include <numbers>

namespace plash {

namespace {

/// Two particles of 1 and 3 units of mass fly at each other at 1 and -1; h = 1 and 2, so that they touch
/// at 1.5 SRAD.
std::string meeting(const std::string& coupling, int alone = 1)
{
    return "*KEYWORD\n*CONTROL_TERMINATION\n3.0\n" + fmt::format("*CONTROL_SPH\n,,,3\n{}\n", alone) +
           "*SECTION_SPH\n1,,,,1.0\n*SECTION_SPH\n2,,,,2.0\n*MAT_NULL\n1,1.0\n*EOS_LINEAR_POLYNOMIAL\n1,0,"
           "4.0e4\n\n"
           "*PART\nleft\n1,1,1,1\n*PART\nright\n2,2,1,1\n*NODE\n1,-2.0,0,0\n2,2.0,0,0\n"
           "*ELEMENT_SPH\n1,1,1.0\n2,2,3.0\n*SET_NODE_LIST\n1\n1\n*SET_NODE_LIST\n2\n2\n"
           "*INITIAL_VELOCITY\n1\n1.0\n*INITIAL_VELOCITY\n2\n-1.0\n*DEFINE_SPH_TO_SPH_COUPLING\n" +
           coupling + "\n*END\n";
}

} // namespace

/// An elastic bounce: velocities after the collision, the depth v sqrt(m / k), the distance of the first
/// touch, and work that comes back.
TEST(SphCoupling, TwoParticlesBounce)
{
    testing::DeckRun run(meeting("1,2,1,1,,,0.04,1.2"));
    ASSERT_TRUE(run.scene);
    double nearest = 1e9, first_step = 0, touch = 0;
    run.watch([&](const Clock& clock, const State& state) {
        const double distance = state.position[1].x - state.position[0].x;
        if (clock.last_step > 0 && first_step == 0) first_step = clock.last_step;
        nearest = std::min(nearest, distance);
        if (touch == 0 && norm(state.force[0]) > 0) touch = distance;
    });
    run.go();
    const State& state = run.scene->state;
    EXPECT_NEAR(state.velocity[0].x, -2,
                0.002); // common velocity -1/2, which the difference of 3/2 is mirrored at
    EXPECT_NEAR(state.velocity[1].x, 0, 0.001);
    EXPECT_NEAR(state.velocity[0].x + 3 * state.velocity[1].x, -2, 1e-13);
    const double reduced = 0.75, stiffness = 0.04 * 0.1 * 2 * reduced / (first_step * first_step);
    EXPECT_NEAR(1.8 - nearest, 2 * std::sqrt(reduced / stiffness), 0.01 * (1.8 - nearest));
    EXPECT_NEAR(touch, 1.8, 2 * first_step);
    EXPECT_LE(touch, 1.8);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-12);
    EXPECT_NEAR(run.scene->ledger.sliding, 0, 1e-3 * run.scene->ledger.initial_total);
    EXPECT_EQ(run.find<ParticleCoupling>()->notices(state).size(), 0u);
}

/// With the share d of critical damping a bounce keeps exp(-pi d / sqrt(1 - d^2)) of the speed, or a little
/// more: the force lets go when the particles part, and damping acts only while they close.
TEST(SphCoupling, DampingTakesWhatItsShareSays)
{
    testing::DeckRun run(meeting("1,2,1,1,,,0.04,1.0\n0.2"));
    ASSERT_TRUE(run.scene);
    run.go();
    const State& state = run.scene->state;
    const double kept = 0.5 * (state.velocity[1].x - state.velocity[0].x);
    // While closing, x'' + 2 d w x' + w^2 x = 0 from x = 0, x' = 1 comes to rest at the depth
    // exp(-d t) with tan(sqrt(1 - d^2) t) = sqrt(1 - d^2) / d, in units of 1 / w; what is stored comes back
    // whole.
    const double d = 0.2, root = std::sqrt(1 - d * d);
    // The damper looks at the velocity half a step ago: an error of the first order in w dt = 0.09; 0.021
    // measured.
    EXPECT_NEAR(kept, std::exp(-d * std::atan2(root, d) / root), 0.03);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-12);
    EXPECT_GT(run.scene->ledger.sliding, 0);
}

TEST(SphCoupling, WarnsWhenKernelsSeeTheOtherPart)
{
    testing::DeckRun run(meeting("1,2,1,1", 0));
    ASSERT_TRUE(run.scene);
    EXPECT_EQ(run.find<ParticleCoupling>()->notices(run.scene->state).size(), 1u);
}

} // namespace plash
