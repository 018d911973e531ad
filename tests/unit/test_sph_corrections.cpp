#include "sph/density_filter.h"
#include "sph/density_rate.h"
#include "sph/laminar_force.h"
#include "sph/particle_drift.h"
#include "sph/tensile_force.h"
#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

/// The pair loops of *PLASH_SPH_FORMULATION, from their definitions and in lanes.
namespace plash {

namespace {

using TestKernel = WendlandC2;

/// A disordered block with two parts, random velocities and densities, in tension and in compression.
struct TwoPartBlock {
    ParticleWorld world;
    std::unique_ptr<ParticleBody> body;
    int dimension;

    TwoPartBlock(int dimension, bool volume_weighted, bool laminar_by_velocity = false) : dimension(dimension)
    {
        world.options.laminar_by_velocity = laminar_by_velocity;
        world.options.kernel = Kernel::wendland_c2;
        world.options.skin = 0.1; // lists hold although the laws change h before any step
        world.options.dimension = dimension;
        world.options.volume_weighted = volume_weighted;
        auto positions = lattice({0, 0, 0}, 10, 9, dimension == 3 ? 8 : 1, 1.0);
        disturb(positions, 0.2, 5, dimension);
        std::vector<Vec3> left, right;
        for (const Vec3& x : positions) (x.x < 5 ? left : right).push_back(x);
        TestLinear squeezed(1, 3), stretched(1, 3);
        squeezed.relative_volume = 0.9;
        stretched.relative_volume = 1.1;
        world.add_part(squeezed, left, 1.0, 1.3).constants.laminar_viscosity = 0.02;
        world.add_part(stretched, right, 1.2, 1.4).constants.laminar_viscosity = 0.05;
        world.open_state();
        disturb(world.state.velocity, 0.5, 6, dimension);
        body = world.make_body();
    }

    const ParticleArrays& arrays() const { return body->arrays(); }
    PairRecords records() const { return {arrays().motion.data(), arrays().push.data(), nullptr}; }

    /// The sums of a pass over all runs; make(run, sums) builds the pass.
    template <class Lane, class Sums, class Make>
    std::vector<Sums> sums(Make&& make) const
    {
        std::vector<Sums> all;
        for (const NeighbourRun& run : body->runs()) {
            std::vector<Sums> sums(run.length());
            auto pass = make(run, sums.data());
            walk_pairs<Lane>(run, pass);
            all.insert(all.end(), sums.begin(), sums.end());
        }
        return all;
    }
};

/// What the definitions need of a pair.
struct Pair {
    Vec3 apart;          ///< x_i - x_j
    Vec3 gradient;       ///< grad_i W
    double kernel, f;    ///< W; W over its value at the spacing of the mean volume
    double volume, mass; ///< of j
    double density_i, density_j, sound, smoothing;
};

template <class Work>
void for_pairs(const TwoPartBlock& block, Index i, Work&& work)
{
    const ParticleArrays& a = block.arrays();
    const int d = block.dimension;
    for (Index j = 0; j < a.size(); ++j) {
        if (i == j) continue;
        Pair pair;
        pair.apart = a.motion[i].position - a.motion[j].position;
        const double r = norm(pair.apart), h = 0.5 * (a.motion[i].smoothing + a.motion[j].smoothing);
        pair.smoothing = h;
        pair.kernel = TestKernel::norm(d) / std::pow(h, d) * TestKernel::value(r / h);
        pair.gradient = TestKernel::norm(d) / std::pow(h, d + 1) * TestKernel::slope(r / h) / r * pair.apart;
        pair.mass = a.mass(j);
        pair.density_i = a.density(i);
        pair.density_j = a.density(j);
        pair.volume = a.mass(j) / a.density(j);
        const double mean_volume = 0.5 * (a.mass(i) / a.density(i) + pair.volume);
        pair.f = TestKernel::value(r / h) / TestKernel::value(std::pow(mean_volume, 1.0 / d) / h);
        pair.sound = 0.5 * (a.push[i].sound + a.push[j].sound);
        work(j, pair);
    }
}

} // namespace

/// What re-initialises densities and what calms the wake leave pressures to the law of the next step.
TEST(SphArrays, AnotherDensityLeavesThePressureAlone)
{
    for (const bool volumes : {false, true}) {
        ParticleArrays arrays;
        arrays.push.resize(1);
        if (volumes) arrays.own_mass = {1.5};
        arrays.set_density(0, 2);
        arrays.set_pressure(0, 3);
        arrays.change_density(0, 2.5);
        EXPECT_DOUBLE_EQ(arrays.density(0), 2.5);
        EXPECT_DOUBLE_EQ(arrays.pressure(0), 3);
    }
}

class SphCorrections : public ::testing::TestWithParam<std::pair<int, bool>> {};

TEST_P(SphCorrections, DriftsAreTheirSums)
{
    const auto [dimension, volumes] = GetParam();
    const TwoPartBlock block(dimension, volumes);
    const auto sums_in = [&, dimension = dimension, volumes = volumes]<class Lane>(Lane) {
        return block.sums<Lane, DriftSums>([&](const NeighbourRun& run, DriftSums* sums) {
            return DriftPass<Lane, TestKernel>(block.records(), run.begin, dimension, volumes, sums);
        });
    };
    const auto plain = sums_in(double{}), lanes = sums_in(Lanes{});
    const auto& motion = block.arrays().motion;
    for (Index i = 0; i < block.arrays().size(); i += 5) {
        Vec3 smoothed{}, crowding{};
        double filling = 0, spread = 0;
        for_pairs(block, i, [&](Index j, const Pair& p) {
            smoothed += 2 * p.mass / (p.density_i + p.density_j) * p.kernel *
                        (motion[j].velocity - motion[i].velocity);
            filling += p.volume * p.kernel;
            crowding += p.volume * (1 + 0.2 * std::pow(p.f, 4)) * p.gradient;
            spread -= p.volume * dot(p.apart, p.gradient);
        });
        EXPECT_LT(norm(plain[i].smoothed - smoothed), 1e-12);
        EXPECT_NEAR(plain[i].filling, filling, 1e-12);
        EXPECT_LT(norm(plain[i].crowding - crowding), 1e-11);
        EXPECT_NEAR(plain[i].spread, spread, 1e-12);
        EXPECT_LT(norm(lanes[i].smoothed - smoothed), 1e-7); // estimates of 1 / a
        EXPECT_NEAR(lanes[i].filling, filling, 1e-7);
        EXPECT_LT(norm(lanes[i].crowding - crowding), 1e-6);
        EXPECT_NEAR(lanes[i].spread, spread, 1e-7);
    }
}

TEST_P(SphCorrections, TensileForcesActBetweenStretchedParticlesAlone)
{
    const auto [dimension, volumes] = GetParam();
    const TwoPartBlock block(dimension, volumes);
    const auto sums_in = [&, dimension = dimension, volumes = volumes]<class Lane>(Lane) {
        return block.sums<Lane, ForceSums>([&](const NeighbourRun& run, ForceSums* sums) {
            return TensileForce<Lane, TestKernel>(block.records(), run.begin, dimension, volumes, 0.3, sums);
        });
    };
    const auto plain = sums_in(double{}), lanes = sums_in(Lanes{});
    const ParticleArrays& a = block.arrays();
    Vec3 total{};
    double largest = 0, work = 0;
    for (Index i = 0; i < a.size(); ++i) {
        Vec3 force{};
        for_pairs(block, i, [&](Index j, const Pair& p) {
            const double pull = std::min(a.push[i].push, 0.0) + std::min(a.push[j].push, 0.0);
            force += a.motion[i].weight * a.motion[j].weight * 0.3 * pull * std::pow(p.f, 4) * p.gradient;
        });
        EXPECT_LT(norm(plain[i].force - force), 1e-11) << i;
        EXPECT_LT(norm(lanes[i].force - force), 1e-6) << i;
        total += plain[i].force;
        work += plain[i].heat + dot(plain[i].force, a.motion[i].velocity);
        largest = std::max(largest, norm(force));
    }
    EXPECT_GT(largest, 0.01) << "the test would show nothing";
    EXPECT_LT(norm(total), 1e-11);
    EXPECT_NEAR(work, 0, 1e-11) << "heat is what the motion loses";
}

TEST_P(SphCorrections, LaminarForcesActAlongDifferencesOfVelocity)
{
    const auto [dimension, volumes] = GetParam();
    const TwoPartBlock block(dimension, volumes, true);
    const auto sums_in = [&, dimension = dimension]<class Lane>(Lane) {
        return block.sums<Lane, ForceSums>([&](const NeighbourRun& run, ForceSums* sums) {
            return LaminarForce<Lane, TestKernel>(block.arrays().motion.data(), block.arrays().laminar.data(),
                                                  nullptr, block.arrays().real_count(), run.begin, dimension,
                                                  sums);
        });
    };
    const auto plain = sums_in(double{}), lanes = sums_in(Lanes{});
    const ParticleArrays& a = block.arrays();
    const auto viscosity_of = [&](Index i) { // as the pair sees it: by 1 / density^2 where weights are masses
        return (a.part[i] == 0 ? 0.02 : 0.05) * (volumes ? 1 : 1 / (a.density(i) * a.density(i)));
    };
    Vec3 total{};
    double work = 0, heat = 0;
    for (Index i = 0; i < a.size(); ++i) {
        Vec3 force{};
        for_pairs(block, i, [&](Index j, const Pair& p) {
            const Vec3 velocity = a.motion[i].velocity - a.motion[j].velocity;
            force += a.motion[i].weight * a.motion[j].weight * (viscosity_of(i) + viscosity_of(j)) *
                     (dot(p.apart, p.gradient) / dot(p.apart, p.apart)) * velocity;
        });
        EXPECT_LT(norm(plain[i].force - force), 1e-12) << i;
        EXPECT_LT(norm(lanes[i].force - force), 1e-7) << i;
        total += plain[i].force;
        work += dot(plain[i].force, a.motion[i].velocity);
        heat += plain[i].heat;
    }
    EXPECT_GT(heat, 0.1) << "the test would show nothing";
    EXPECT_NEAR(work + heat, 0, 1e-12 * heat) << "heat is what the motion loses";
    EXPECT_LT(norm(total), 1e-12);
}

TEST_P(SphCorrections, DiffusionLeavesMassAndTheHydrostaticStateAlone)
{
    const auto [dimension, volumes] = GetParam();
    const TwoPartBlock block(dimension, volumes);
    const ParticleArrays& a = block.arrays();
    const Vec3 gravity{0, -0.7, 0};
    const DensityDiffusion diffusion{
        0.1, gravity, a.push.data(), a.part.data(), a.image.data(), a.real_count(), volumes};
    const auto spread_in = [&, dimension = dimension]<class Lane>(Lane) {
        return block.sums<Lane, double>([&](const NeighbourRun& run, double* spread) {
            static std::vector<double> rate;
            rate.assign(run.length(), 0);
            return DensityRate<Lane, TestKernel, true>(a.motion.data(), run.begin, dimension, 0, rate.data(),
                                                       diffusion, spread);
        });
    };
    const auto plain = spread_in(double{}), lanes = spread_in(Lanes{});
    double mass = 0, size = 0;
    for (Index i = 0; i < a.size(); ++i) {
        double expected = 0;
        for_pairs(block, i, [&](Index j, const Pair& p) {
            if (a.part[i] != a.part[j]) return;
            const double at_rest =
                0.5 * (p.density_i + p.density_j) * dot(gravity, -p.apart) / (p.sound * p.sound);
            const double r2 = dot(p.apart, p.apart);
            expected += 2 * 0.1 * p.smoothing * p.sound * p.volume * (p.density_j - p.density_i - at_rest) *
                        dot(-p.apart, p.gradient) / r2;
        });
        EXPECT_NEAR(plain[i], expected, 1e-12) << i;
        EXPECT_NEAR(lanes[i], expected, 1e-7) << i;
        mass += plain[i] * a.mass(i) / a.density(i);
        size += std::abs(plain[i] * a.mass(i) / a.density(i));
    }
    EXPECT_GT(size, 1e-3) << "the test would show nothing";
    EXPECT_NEAR(mass, 0, 1e-12 * static_cast<double>(a.size()));
}

TEST_P(SphCorrections, FilteredDensityIsTheMeanOfTheNeighbours)
{
    const auto [dimension, volumes] = GetParam();
    const TwoPartBlock block(dimension, volumes);
    const ParticleArrays& a = block.arrays();
    const int d = dimension;
    const auto density_in = [&, dimension = dimension, volumes = volumes]<class Lane>(Lane) {
        std::vector<double> mass(a.motion.size()), volume(a.motion.size());
        for (const NeighbourRun& run : block.body->runs()) {
            DensityFilter<Lane, TestKernel> pass(block.records(), run.begin, dimension, volumes,
                                                 mass.data() + run.begin, volume.data() + run.begin);
            walk_pairs<Lane>(run, pass);
        }
        for (std::size_t p = 0; p < mass.size(); ++p) mass[p] /= volume[p];
        return mass;
    };
    const auto plain = density_in(double{}), lanes = density_in(Lanes{});
    for (Index i = 0; i < a.size(); i += 3) {
        const double self = TestKernel::norm(d) / std::pow(a.motion[i].smoothing, d) * TestKernel::value(0.0);
        double mass = self * a.mass(i), volume = self * a.mass(i) / a.density(i);
        for_pairs(block, i, [&](Index, const Pair& p) {
            mass += p.mass * p.kernel;
            volume += p.volume * p.kernel;
        });
        EXPECT_NEAR(plain[i], mass / volume, 1e-12);
        EXPECT_NEAR(lanes[i], mass / volume, 1e-7);
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, SphCorrections,
                         ::testing::Values(std::pair{2, false}, std::pair{2, true}, std::pair{3, false},
                                           std::pair{3, true}));

/// Particles that fly out of the box, or too fast, take their energies with them; the rest goes on.
TEST(SphLeaving, ParticlesOutsideTheBoxLeaveWithTheirEnergy)
{
    ParticleWorld world;
    world.options.viscosity = {0, 0};
    world.options.box = Box{{-1, -1, -1}, {6, 5, 5}};
    world.add_part(TestLinear(1, 1), lattice({0, 0, 0}, 4, 4, 4, 1.0), 2.0, 1.2);
    world.add_part(TestLinear(1, 1), lattice({20, 0, 0}, 1, 1, 3, 1.0), 2.0, 1.2);
    world.open_state();
    auto body = world.make_body();
    EXPECT_EQ(body->items(), 64u); // three stood outside from the start
    EXPECT_EQ(body->departed()[1].count, 3);
    EXPECT_DOUBLE_EQ(body->departed()[1].mass, 6);
    for (std::size_t node = 64; node < 67; ++node) EXPECT_EQ(world.state.mass[node], 0);

    for (std::size_t i = 0; i < 64; ++i) {
        world.state.position[i].x += 3; // the two columns at 6.5 and 5.5 + ...: one of them is out
        world.state.velocity[i] = {3, 0, 0};
    }
    Clock clock;
    clock.last_step = clock.time = 1e-3;
    clock.cycle = 1;
    body->add_forces(clock, world.state);
    EXPECT_EQ(body->items(), 48u);
    EXPECT_EQ(body->departed()[0].count, 16);
    EXPECT_DOUBLE_EQ(body->departed()[0].kinetic, 16 * 0.5 * 2 * 9);
    EnergyLedger ledger;
    ledger.open_cycle(2);
    body->report(ledger);
    EXPECT_DOUBLE_EQ(ledger.eroded_kinetic, 144);
    ElementResults results;
    results.part_motion.resize(2);
    body->collect(world.state, results);
    EXPECT_DOUBLE_EQ(results.part_motion[0].mass, 96);
    EXPECT_DOUBLE_EQ(results.part_motion[0].eroded_kinetic, 144);
}

} // namespace plash
