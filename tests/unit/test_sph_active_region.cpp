#include "sph/active_region.h"
#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

namespace plash {

TEST(SphActiveRegion, KnowsInsideFromOutside)
{
    ActiveRegion box;
    box.outer = {{0, 0, 0}, {4, 4, 4}};
    box.inner = {{1, 1, 1}, {2, 2, 2}};
    EXPECT_TRUE(box.holds({0.5, 0.5, 0.5}, {}));
    EXPECT_FALSE(box.holds({1.5, 1.5, 1.5}, {}));
    EXPECT_FALSE(box.holds({5, 1, 1}, {}));
    EXPECT_TRUE(box.holds({5, 1, 1}, {2, 0, 0})); // the region has gone along
    ActiveRegion sphere;
    sphere.shape = ActiveRegion::Shape::sphere;
    sphere.least_radius = 1;
    sphere.largest_radius = 3;
    EXPECT_TRUE(sphere.holds({0, 2, 0}, {}));
    EXPECT_FALSE(sphere.holds({0, 0.5, 0}, {}));
    EXPECT_FALSE(sphere.holds({0, 3.5, 0}, {}));
    ActiveRegion cylinder = sphere;
    cylinder.shape = ActiveRegion::Shape::cylinder;
    cylinder.axis = {0, 0, 1};
    cylinder.largest_height = 5;
    cylinder.least_height = 2;
    EXPECT_TRUE(cylinder.holds({2, 0, 1}, {}));
    EXPECT_FALSE(cylinder.holds({0.5, 0, 1}, {}));
    EXPECT_TRUE(cylinder.holds({0.5, 0, 3}, {})); // above the hole
    EXPECT_FALSE(cylinder.holds({2, 0, 6}, {}));
}

/// Half of a bar of water is asleep: it stays where it is and holds the other half, whose pressure it keeps.
TEST(SphActiveRegion, SleepersStandStillAndAreSeen)
{
    ParticleWorld world;
    world.options.viscosity = {0, 0};
    TestLinear squeezed(1, 1);
    squeezed.relative_volume = 0.95;
    const auto positions = lattice({0, 0, 0}, 16, 5, 5, 1.0);
    world.add_part(squeezed, positions, 1 / 0.95, 1.2);
    ActiveRegion region;
    region.parts = {0};
    region.outer = {{8, -1, -1}, {17, 6, 6}};
    world.options.regions = {region};
    world.options.periods = {{{0, 0, 0}, {0, 5, 0}, none, 0}, {{0, 0, 0}, {0, 0, 5}, none, 0}};
    world.open_state();
    world.model.controls.time.step_scale = 0.5;
    world.model.controls.time.end_time = 4;
    Scene scene = world.make_scene_of_particles();
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    double free_end = 0, at_border = 0, asleep_pressure = 0;
    const ParticleArrays& a = world.body->arrays();
    for (Index p = 0; p < a.real_count(); ++p) {
        const Vec3& start = positions[a.node[p]];
        if (start.x < 8) {
            EXPECT_EQ(norm(scene.state.position[a.node[p]] - start), 0);
            EXPECT_EQ(norm(scene.state.velocity[a.node[p]]), 0);
            asleep_pressure = a.pressure(p);
        }
        if (start.x > 15) free_end = std::max(free_end, scene.state.velocity[a.node[p]].x);
        if (start.x > 8 && start.x < 10)
            at_border = std::max(at_border, std::abs(scene.state.velocity[a.node[p]].x));
    }
    EXPECT_NEAR(asleep_pressure, 1 / 0.95 - 1, 1e-12);
    // The free end expands with p / (rho c) = 0.05; the wave needs a time of 8 to the border.
    EXPECT_GT(free_end, 0.03);
    EXPECT_LT(at_border, 0.002);
}

} // namespace plash
