#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// Smoothing length of a particle of unit smoothing length after `steps` equal steps of a flow that grows
/// volumes by the rate `expansion`, over one unit of time.
double smoothing_after_flow(double expansion, bool by_cube_root, int steps)
{
    const TestLinear eos(1000, 1500);
    NullFluid fluid;
    fluid.density = eos.density;
    const FluidLaw<TestLinear> law(fluid, eos);
    PartConstants part;
    part.density = eos.density;
    part.smoothing = 1;
    part.smallest_smoothing = 0.2;
    part.largest_smoothing = 2;
    part.smoothing_by_cube_root = by_cube_root;
    ParticleArrays arrays;
    arrays.motion.push_back({{}, 1, {}, 1});
    arrays.push.resize(1);
    arrays.set_density(0, eos.density);
    arrays.part.push_back(0);
    arrays.node.push_back(0);
    arrays.energy.push_back(0);
    arrays.rate.push_back(0);
    const Index place = 0;
    for (int i = 0; i < steps; ++i) {
        arrays.rate[0] = -arrays.density(0) * expansion;
        law.advance(part, {&place, 1}, 1.0 / steps, arrays);
    }
    return arrays.motion[0].smoothing;
}

} // namespace

/// dh/dt = h div(v) / 3: with div(v) = 0.3 over one unit of time h grows by exp(0.1). Density goes by
/// explicit steps of the first order, so h is off by 0.1 * 0.3 / 2 a step, relative.
TEST(SphSmoothing, FollowsTheFlow)
{
    EXPECT_NEAR(smoothing_after_flow(0.3, false, 1000), std::exp(0.1), 2e-5);
    EXPECT_NEAR(smoothing_after_flow(-0.3, false, 1000), std::exp(-0.1), 2e-5);
}

/// dh/dt = h div(v)^(1/3) / 3 (DERIV = 1): with div(v) = 0.008 over one unit of time h grows by exp(0.2 / 3),
/// and it stays within its bounds. The rate of density is divided by the density of the end of a step, so the
/// exponent is off by 0.2 / 3 * 0.008 / 3 a step.
TEST(SphSmoothing, FollowsTheCubeRootOfTheFlow)
{
    for (int steps : {10, 1000}) {
        const double tolerance = 1.1 * 0.2 / 3 * 0.008 / 3 / steps;
        EXPECT_NEAR(smoothing_after_flow(0.008, true, steps), std::exp(0.2 / 3), tolerance);
        EXPECT_NEAR(smoothing_after_flow(-0.008, true, steps), std::exp(-0.2 / 3), tolerance);
    }
    EXPECT_EQ(smoothing_after_flow(27, true, 30), 2);
}

} // namespace plash
