#include "eos/gruneisen.h"
#include "eos/murnaghan.h"
#include "eos/tabulated.h"
#include "tests/support/particle_setup.h"
#include "tests/support/records.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

/// Shocks in gas and water, and particles in tension.
namespace plash::shock_cases {

/// Sod's tube: (rho, p) = (1, 1) and (0.125, 0.1), gamma = 1.4, particles of one mass. Exact plateau values
/// from the Riemann solution: p = 0.30313, u = 0.92745, density 0.42632 before and 0.26557 behind the
/// contact. FORM 6: volumes as weights, since densities jump, and corrected gradients, since the rarefaction
/// pulls the lattice apart along x alone.
void check_sod_tube(bool bulk_viscosity, double tolerance, double balance)
{
    ParticleWorld world;
    world.options.bulk_viscosity = bulk_viscosity;
    world.options.dimension = 2;
    world.options.viscosity = {1.5, 1};
    world.options.volume_weighted = world.options.renormalised = true;
    // Square lattices of one mass on both sides: 17 and 6 rows, since 17 / 6 is nearly sqrt(8).
    const double fine = 0.005, width = 17 * fine, coarse = width / 6;
    const double mass = fine * fine, along = mass / 0.125 / coarse;
    std::vector<Vec3> left, right;
    for (int i = 0; i < 100; ++i)
        for (int j = 0; j < 17; ++j) left.push_back({-fine * (i + 0.5), fine * (j + 0.5), 0});
    for (int i = 0; i < std::lround(0.5 / along); ++i)
        for (int j = 0; j < 6; ++j) right.push_back({along * (i + 0.5), coarse * (j + 0.5), 0});
    world.options.periods = {{{0, 0, 0}, {0, width, 0}}};
    world.options.mirrors = {{{-0.5, 0, 0}, {1, 0, 0}, false, {}}, {{0.5, 0, 0}, {-1, 0, 0}, false, {}}};
    world.add_part(TestGas(1, 1, 1.4), left, mass, 1.3 * fine);
    world.add_part(TestGas(0.125, 0.1, 1.4), right, mass, 1.3 * coarse);
    if (bulk_viscosity) {
        for (ParticlePart& part : world.parts) part.constants.bulk_length = 1 / 1.3;
    }
    world.open_state();
    world.model.controls.time.step_scale = 0.4;
    world.model.controls.time.end_time = 0.2;
    Scene scene = world.make_scene_of_particles();
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    struct Mean {
        double pressure = 0, density = 0, velocity = 0;
        int count = 0;
    };
    // Between the tail of the rarefaction at -0.0140 and the shock at 0.3504; the contact stands at 0.1855.
    const auto mean = [&](double from, double to) {
        Mean m;
        const ParticleArrays& a = world.body->arrays();
        for (Index p = 0; p < a.real_count(); ++p) {
            const double x = a.motion[p].position.x;
            if (x < from || x > to) continue;
            m.pressure += a.pressure(p);
            m.density += a.density(p);
            m.velocity += scene.state.velocity[a.node[p]].x;
            ++m.count;
        }
        m.pressure /= m.count;
        m.density /= m.count;
        m.velocity /= m.count;
        return m;
    };
    const Mean before = mean(0.03, 0.15), behind = mean(0.22, 0.31);
    for (const Mean& plateau : {before, behind}) {
        EXPECT_NEAR(plateau.pressure, 0.30313, tolerance * 0.30313);
        EXPECT_NEAR(plateau.velocity, 0.92745, tolerance * 0.92745);
    }
    EXPECT_NEAR(before.density, 0.42632, tolerance * 0.42632);
    EXPECT_NEAR(behind.density, 0.26557, tolerance * 0.26557);
    EXPECT_LT(scene.ledger.balance_error(), balance);
}

/// 1.1 % as measured, 0.5 % with half of the spacing.
TEST(SphShocks, SodTubeHasItsPlateaus)
{
    check_sod_tube(false, 0.015, 0.001);
}

/// IAVIS = 1.
TEST(SphShocks, SodTubeHasItsPlateausWithTheViscosityOfSolids)
{
    check_sod_tube(true, 0.015, 0.001);
}

namespace {

constexpr double radius = 0.01, speed = 116; // of the bird [m], [m/s]

/// A quarter of a cylinder of water, with or without a hemispherical nose, that meets a rigid plate.
struct Bird {
    ParticleWorld world;
    double spacing;

    static Gruneisen water()
    {
        Gruneisen eos;
        eos.s1 = 2;
        eos.gamma = 0.1;
        eos.bulk_modulus = 1000 * 1482.9 * 1482.9;
        return eos;
    }

    /// across  particles along the radius; length in radii
    Bird(int across, int length, bool nose, Kernel kernel, double smoothing_ratio)
        : Bird(across, length, nose, kernel, smoothing_ratio, water(), 1000)
    {}
    template <class Eos>
    Bird(int across, int length, bool nose, Kernel kernel, double smoothing_ratio, const Eos& eos,
         double density)
        : spacing(radius / across)
    {
        NullFluid fluid;
        fluid.density = density;
        fluid.lowest_pressure = 0;
        std::vector<Vec3> positions;
        for (const Vec3& x : lattice({0, 0, 0}, across, across, length * across, spacing)) {
            const double behind = nose ? std::min(0.0, x.z - radius) : 0;
            if (x.x * x.x + x.y * x.y + behind * behind < radius * radius) positions.push_back(x);
        }
        world.options.kernel = kernel;
        world.options.viscosity = {1.5, 0.3};
        world.options.mirrors = {{{0, 0, 0}, {1, 0, 0}, false, {}},
                                 {{0, 0, 0}, {0, 1, 0}, false, {}},
                                 {{0, 0, 0}, {0, 0, 1}, false, {}}};
        world.add_part(std::make_shared<FluidLaw<Eos>>(fluid, eos), density, positions,
                       density * spacing * spacing * spacing, smoothing_ratio * spacing);
        world.open_state();
        for (Vec3& velocity : world.state.velocity) velocity.z = -speed;
        world.model.controls.time.step_scale = 0.5;
    }

    /// Mean pressure at the axis over some time [stress]: around it to a quarter of the radius, two spacings
    /// deep.
    double pressure_between(double begin, double end)
    {
        world.model.controls.time.end_time = end;
        Scene scene = world.make_scene_of_particles();
        double impulse = 0, duration = 0;
        add_particle_probe(scene, [&](const Clock& clock, const State&) {
            if (clock.time < begin) return;
            const ParticleArrays& a = world.body->arrays();
            double sum = 0, count = 0;
            for (Index p = 0; p < a.real_count(); ++p) {
                const Vec3& x = a.motion[p].position;
                if (x.z > 2 * spacing || x.x * x.x + x.y * x.y > 0.06 * radius * radius) continue;
                sum += a.pressure(p);
                ++count;
            }
            if (count == 0) return;
            impulse += sum / count * clock.last_step;
            duration += clock.last_step;
        });
        Recorders nobody;
        const Outcome outcome = run(scene, nobody);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        EXPECT_LT(scene.ledger.balance_error(), 0.005);
        return impulse / duration;
    }
};

} // namespace

/// Wilbeck (1978): the first pressure is rho u_s u with u_s = c + k u, 198.9 MPa at 116 m/s for water with
/// c = 1482.9 m/s, k = 2. It stands at the axis from when the shock has left the particles looked at until
/// the release wave from the rim arrives. Measured: +1.1 % with 10 particles along the radius, -1.7 % with
/// 20, -1.2 % with 28. The first peak is 9 % higher, which is what the linear viscosity of 0.3 leaves of the
/// ringing behind a shock.
TEST(SphShocks, ABirdOnAPlateFeelsTheHugoniotPressure)
{
    const double passage = radius / 1482.9;
    for (int across : {10, 20}) {
        Bird bird(across, 1, false, Kernel::cubic_spline, 1.2);
        EXPECT_NEAR(bird.pressure_between(0.2 * passage, 0.6 * passage), 198.93e6, 0.05 * 198.93e6) << across;
    }
}

/// The same with Tait's water (*EOS_MURNAGHAN, GAMMA = 7), whose pressure does not know the energy: the jumps
/// of mass and momentum give the compression r of the shock, K0 (r^7 - 1) = rho u^2 r / (r - 1).
TEST(SphShocks, ABirdOfTaitsWaterFeelsItsHugoniotPressure)
{
    Murnaghan eos;
    eos.stiffness = 1000 * 1482.9 * 1482.9 / 7;
    eos.bulk_modulus = 7 * eos.stiffness;
    double low = 1, high = 2;
    for (int i = 0; i < 100; ++i) {
        const double r = 0.5 * (low + high);
        (eos.stiffness * (std::pow(r, 7) - 1) * (r - 1) > 1000 * speed * speed * r ? high : low) = r;
    }
    const double expected = eos.stiffness * (std::pow(low, 7) - 1), passage = radius / 1482.9;
    Bird bird(20, 1, false, Kernel::cubic_spline, 1.2, eos, 1000);
    EXPECT_NEAR(bird.pressure_between(0.2 * passage, 0.6 * passage), expected, 0.05 * expected);
}

/// The same with *EOS_TABULATED, as bird strikes use it: water with 10 % of air by volume, soft at first and
/// as stiff as water once the air has gone. Behind the shock p = rho u^2 / (1 - V), V the table's volume at p
/// (momentum and mass across a shock that comes to rest; the table does not depend on energy). Steps are
/// capped: sound in the bird at rest is slow and would allow steps that the shock does not. Measured: +2.5 %
/// with 20 particles along the radius, -2.2 % with 28; with 10 the ringing behind the shock has not died out
/// when the release wave comes.
TEST(SphShocks, ABirdOfWaterAndAirFeelsTheHugoniotPressureOfItsTable)
{
    const std::vector<double> table = {0, 0.5e6, 2e6, 6e6, 20e6, 50e6, 100e6, 200e6, 400e6, 800e6};
    std::vector<double> strain;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double p = table[i], stiffness = 1000 * 1482.9 * 1482.9 / 7;
        strain.push_back(
            std::log(0.9 * std::pow(p / stiffness + 1, -1 / 7.0) + 0.1 * std::pow(p / 101325 + 1, -1 / 1.4)));
    }
    const Record record = make_record(
        "EOS_TABULATED",
        {{"EV1", strain[0]}, {"EV2", strain[1]}, {"EV3", strain[2]}, {"EV4", strain[3]}, {"EV5", strain[4]},
         {"EV6", strain[5]}, {"EV7", strain[6]}, {"EV8", strain[7]}, {"EV9", strain[8]}, {"EV10", strain[9]},
         {"C1", table[0]},   {"C2", table[1]},   {"C3", table[2]},   {"C4", table[3]},   {"C5", table[4]},
         {"C6", table[5]},   {"C7", table[6]},   {"C8", table[7]},   {"C9", table[8]},   {"C10", table[9]}});
    const double density = 900;
    double low = table[1], high = table.back(); // of the pressure behind the shock
    for (int i = 0; i < 60; ++i) {
        const double p = 0.5 * (low + high);
        std::size_t k = 1;
        while (table[k] < p) ++k;
        const double share = (p - table[k - 1]) / (table[k] - table[k - 1]);
        const double volume = std::exp(strain[k - 1] + share * (strain[k] - strain[k - 1]));
        (p < density * speed * speed / (1 - volume) ? low : high) = p;
    }
    // From Wilbeck's (1978) formulas without a table, in steps of their own.
    EXPECT_NEAR(low, 91.988e6, 0.005 * 91.988e6);
    for (int across : {20, 28}) {
        Bird bird(across, 1, false, Kernel::wendland_c2, 1.5, Tabulated::from_record(record, density),
                  density);
        const double passage = radius / 1482.9;
        NamedCurve largest;
        largest.curve.abscissa = {0, 1};
        largest.curve.ordinate = {0.3 * bird.spacing / 1500, 0.3 * bird.spacing / 1500};
        bird.world.model.curves.push_back(largest);
        bird.world.model.controls.time.largest_step_curve = 0;
        EXPECT_NEAR(bird.pressure_between(0.3 * passage, 0.65 * passage), low, 0.05 * low) << across;
    }
}

/// When the waves have gone, a long bird stands on the plate with rho u^2 / 2 = 6.73 MPa at the axis. It has
/// a hemispherical nose: a flat one leaves a cavity under it that stays for more than a radius of length.
/// Wendland C2 and density diffusion; measured +9, +3, -0.2, -0.3 % with 8, 10, 12, 16 particles along the
/// radius.
TEST(SphShocks, ABirdOnAPlateFeelsTheStagnationPressure)
{
    Bird bird(10, 5, true, Kernel::wendland_c2, 1.5);
    bird.world.options.density_diffusion = 0.1;
    const double passage = radius / speed;
    EXPECT_NEAR(bird.pressure_between(2.5 * passage, 3.8 * passage), 6.728e6, 0.05 * 6.728e6);
}

namespace {

struct Tension {
    double nearest = 0;       ///< smallest distance of two particles at the end, in spacings
    double balance_error = 0; ///< against the energy of the tension, 0.05^2 / 2 times 400 volumes
};

/// Swegle's test (1995): a lattice in uniform tension, periodic, with one particle a little off its place.
Tension in_tension(double repulsion)
{
    ParticleWorld world;
    world.options.dimension = 2;
    world.options.viscosity = {0, 0.1};
    world.options.tensile_repulsion = repulsion;
    world.options.periods = {{{0, 0, 0}, {20, 0, 0}}, {{0, 0, 0}, {0, 20, 0}}};
    TestLinear fluid(1, 1);
    fluid.relative_volume = 1.05; // 5 % of the bulk modulus in tension
    auto positions = lattice({0, 0, 0}, 20, 20, 1, 1.0);
    positions[210].x += 0.01;
    world.add_part(fluid, positions, 1 / 1.05, 1.2);
    world.open_state();
    world.model.controls.time.step_scale = 0.5;
    world.model.controls.time.end_time = 300;
    Scene scene = world.make_scene_of_particles();
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    Tension tension;
    tension.nearest = 20;
    for (std::size_t i = 0; i < positions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            Vec3 apart = scene.state.position[i] - scene.state.position[j];
            apart.x -= 20 * std::round(apart.x / 20);
            apart.y -= 20 * std::round(apart.y / 20);
            tension.nearest = std::min(tension.nearest, norm(apart));
        }
    // The ledger counts energies from where they start, and here their sum stays zero.
    tension.balance_error = scene.ledger.largest_error / 0.5;
    return tension;
}

} // namespace

/// A fluid has no lattice to keep, but its particles must not clump (Monaghan 2000).
TEST(SphTension, ArtificialPressureKeepsParticlesApart)
{
    const Tension plain = in_tension(0), held = in_tension(0.3);
    EXPECT_LT(plain.nearest, 0.1) << "the cubic spline clumps in tension, or the test shows nothing";
    EXPECT_GT(held.nearest, 0.8);
    EXPECT_LT(plain.balance_error, 0.01);
    EXPECT_LT(held.balance_error, 0.01);
}

} // namespace plash::shock_cases
