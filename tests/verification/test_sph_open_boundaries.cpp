#include "materials/elastic.h"
#include "sph/solid_law.h"
#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

/// Boundaries that waves and particles pass: *BOUNDARY_SPH_NON_REFLECTING and *BOUNDARY_SPH_FLOW.
namespace plash {

namespace {

MirrorPlane open_plane(const Vec3& point, const Vec3& normal)
{
    MirrorPlane plane{point, normal, false, {}};
    plane.absorbing = true;
    return plane;
}

struct Pulse {
    double left = 0;          ///< largest kinetic energy, over the first one, once the pulse should be gone
    double balance_error = 0; ///< over the energy at the start
};

/// A pulse of 20 spacings runs along a strip with density and speed of sound 1 and through its end at x = 1.
/// motion  direction in which the particles move
Pulse run_pulse(ParticleWorld& world, std::shared_ptr<const ParticleLaw> law, const Vec3& motion,
                double speed)
{
    const int rows = 60;
    const double spacing = 1.0 / rows;
    world.options.kernel = Kernel::wendland_c2;
    world.options.dimension = 2;
    world.options.viscosity = {0, 0};
    world.options.periods = {{{0, 0, 0}, {0, 8 * spacing, 0}}};
    const auto positions = lattice({0, 0, -spacing / 2}, rows, 8, 1, spacing);
    world.add_part(std::move(law), 1, positions, spacing * spacing, 1.5 * spacing);
    world.open_state();
    const auto shape = [](double x) {
        return std::abs(x - 0.5) < 1.0 / 6 ? std::pow(std::cos(3 * M_PI * (x - 0.5)), 2) : 0;
    };
    for (std::size_t i = 0; i < positions.size(); ++i) {
        world.state.velocity[i] = 1e-5 * shape(positions[i].x) * motion;
    }
    // Half of the pulse goes either way: both ends are open.
    world.options.mirrors = {open_plane({1, 0, 0}, {-1, 0, 0}), open_plane({0, 0, 0}, {1, 0, 0})};
    world.model.controls.time.step_scale = 0.4;
    world.model.controls.time.end_time = 1.6 / speed;
    Scene scene = world.make_scene_of_particles();
    double first = 0, late = 0;
    add_particle_probe(scene, [&](const Clock& clock, const State& state) {
        double energy = 0;
        for (std::size_t i = 0; i < state.size(); ++i) {
            energy += 0.5 * state.mass[i] * dot(state.velocity[i], state.velocity[i]);
        }
        if (clock.cycle == 0) first = energy;
        if (clock.time > 1.2 / speed) late = std::max(late, energy);
    });
    Recorders nobody;
    run(scene, nobody);
    return {late / first, scene.ledger.balance_error()};
}

std::shared_ptr<const ParticleLaw> acoustic_law()
{
    NullFluid fluid;
    fluid.density = 1;
    fluid.lowest_pressure = -INFINITY;
    return std::make_shared<FluidLaw<TestLinear>>(fluid, TestLinear(1, 1));
}

} // namespace

/// An impedance that is wrong by a tenth gives back 0.25 % of the energy, a wall or a surface all of it.
/// Measured: 0.07 %.
TEST(SphOpenBoundaries, LetSoundOut)
{
    for (const bool volume_weighted : {false, true}) {
        for (const bool renormalised : {false, true}) {
            ParticleWorld world;
            world.options.volume_weighted = volume_weighted;
            world.options.renormalised = renormalised;
            const Pulse pulse = run_pulse(world, acoustic_law(), {1, 0, 0}, 1);
            EXPECT_LT(pulse.left, 2.5e-3) << volume_weighted << renormalised;
            EXPECT_LT(pulse.balance_error, 0.01) << volume_weighted << renormalised;
        }
    }
}

TEST(SphOpenBoundaries, LetWavesOfSolidsOut)
{
    const double nu = 0.3, young = (1 + nu) * (1 - 2 * nu) / (1 - nu); // longitudinal waves have speed 1
    const auto law = std::make_shared<SolidParticleLaw<Elastic>>(Elastic{1.0, young, nu});
    ParticleWorld longitudinal, shear;
    const Pulse first = run_pulse(longitudinal, law, {1, 0, 0}, 1);
    const Pulse second = run_pulse(shear, law, {0, 1, 0}, law->shear_sound());
    EXPECT_LT(first.left, 2.5e-3);
    EXPECT_LT(second.left, 2.5e-3);
    EXPECT_LT(std::max(first.balance_error, second.balance_error), 0.01);
}

TEST(SphOpenBoundaries, HoldWhatPressesOnThemAtTheStart)
{
    ParticleWorld world;
    world.options.dimension = 2;
    world.options.volume_weighted = true;
    const int rows = 12;
    const double spacing = 1.0 / rows;
    const auto positions = lattice({0, 0, -spacing / 2}, rows, rows, 1, spacing);
    TestLinear water(1, 1);
    water.relative_volume = 0.95; // p = 0.0526
    world.add_part(water, positions, spacing * spacing / 0.95, 1.5 * spacing);
    world.open_state();
    world.options.mirrors = {open_plane({1, 0, 0}, {-1, 0, 0}), open_plane({0, 0, 0}, {1, 0, 0}),
                             open_plane({0, 1, 0}, {0, -1, 0}), open_plane({0, 0, 0}, {0, 1, 0})};
    world.model.controls.time.end_time = 10;
    Scene scene = world.make_scene_of_particles();
    Recorders nobody;
    run(scene, nobody);
    double fastest = 0;
    for (const Vec3& velocity : scene.state.velocity) fastest = std::max(fastest, norm(velocity));
    EXPECT_LT(fastest, 1e-10); // round-off
}

TEST(SphOpenBoundaries, CountTheParticlesThatLeave)
{
    ParticleWorld world;
    world.options.dimension = 2;
    const double spacing = 0.1;
    const auto positions = lattice({0, 0, -spacing / 2}, 10, 4, 1, spacing);
    world.add_part(acoustic_law(), 1, positions, spacing * spacing, 1.3 * spacing);
    world.options.periods = {{{0, 0, 0}, {0, 4 * spacing, 0}}};
    world.open_state();
    for (Vec3& velocity : world.state.velocity) velocity = {0.01, 0, 0};
    world.options.mirrors = {open_plane({1.2, 0, 0}, {-1, 0, 0})};
    world.model.controls.time.end_time = 50; // the plane is 0.2 ahead; three columns pass it
    Scene scene = world.make_scene_of_particles();
    Recorders nobody;
    run(scene, nobody);
    EXPECT_EQ(world.body->departed()[0].count, 12);
    EXPECT_EQ(world.body->departed()[0].count + world.body->arrays().real_count(), 40);
}

/// A stream that goes on as it came: who stands ready must look like the particles in front of it.
TEST(SphInflow, FeedsAStreamWithoutASound)
{
    ParticleWorld world;
    world.options.dimension = 2;
    world.options.volume_weighted = true;
    const double spacing = 0.1, speed = 0.2;
    const auto positions = lattice({-2, 0, -spacing / 2}, 30, 4, 1, spacing); // 20 columns wait, 10 are in
    world.options.periods = {{{0, 0, 0}, {0, 4 * spacing, 0}}};
    world.add_part(acoustic_law(), 1, positions, spacing * spacing, 1.3 * spacing);
    world.open_state();
    Inflow inflow;
    inflow.normal = inflow.motion.direction = {1, 0, 0};
    inflow.motion.scale = speed;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        inflow.motion.nodes.push_back(static_cast<Index>(i));
        if (positions[i].x > 0) world.state.velocity[i].x = speed;
    }
    world.options.inflows = {inflow};
    world.model.controls.time.end_time = 5; // ten columns come in
    Scene scene = world.make_scene_of_particles();
    Recorders nobody;
    run(scene, nobody);
    // Ten columns still wait; those farther than 2.5 kernels, 0.65, have no neighbours.
    int asleep = 0;
    for (Index p = 0; p < world.body->arrays().real_count(); ++p) asleep += world.body->arrays().asleep[p];
    EXPECT_NEAR(asleep, 3.5 * 4, 2);
    double off = 0, apart = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        off = std::max(off, norm(scene.state.velocity[i] - Vec3{speed, 0, 0}));
        apart = std::max(apart, norm(scene.state.position[i] - positions[i] - Vec3{1, 0, 0}));
    }
    EXPECT_LT(off, 1e-10);
    EXPECT_LT(apart, 5 * spacing * speed); // the last step passes the end of the run
    EXPECT_LT(scene.ledger.balance_error(), 1e-10);
}

/// A stream that drives a piston of water against a wall: all that is done on it comes from those who wait.
/// Pressure behind the shock: rho U u, its speed U from U (U - u) = c^2 (linear equation of state).
TEST(SphInflow, PaysForThePressureThatItMakes)
{
    ParticleWorld world;
    world.options.dimension = 2;
    world.options.volume_weighted = true;
    const double spacing = 1.0 / 40, speed = 0.02;
    const auto positions = lattice({-0.5, 0, -spacing / 2}, 60, 4, 1, spacing);
    world.options.periods = {{{0, 0, 0}, {0, 4 * spacing, 0}}};
    world.options.mirrors = {{{1, 0, 0}, {-1, 0, 0}, false, {}}};
    world.add_part(acoustic_law(), 1, positions, spacing * spacing, 1.3 * spacing);
    world.open_state();
    Inflow inflow;
    inflow.normal = inflow.motion.direction = {1, 0, 0};
    inflow.motion.scale = speed;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (positions[i].x < 0) inflow.motion.nodes.push_back(static_cast<Index>(i));
    }
    world.options.inflows = {inflow};
    world.model.controls.time.end_time = 0.7; // the shock is 0.3 before the wall
    Scene scene = world.make_scene_of_particles();
    Recorders nobody;
    run(scene, nobody);
    double pressure = 0;
    int count = 0;
    const ParticleArrays& a = world.body->arrays();
    for (Index p = 0; p < a.real_count(); ++p) {
        if (a.motion[p].position.x < 0.2 || a.motion[p].position.x > 0.5) continue;
        pressure += a.pressure(p);
        ++count;
    }
    EXPECT_NEAR(pressure / count / speed, 1 + speed / 2, 0.02);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

} // namespace plash
