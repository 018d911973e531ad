#include "math/lane_lines.h"
#include "sph/density_rate.h"
#include "sph/pair_force.h"
#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// A disordered block of gas with random velocities: every term of the pair loops is at work.
struct Block {
    ParticleWorld world;
    std::unique_ptr<ParticleBody> body;

    explicit Block(Kernel kernel, int dimension)
    {
        world.options.kernel = kernel;
        world.options.dimension = dimension;
        auto positions = lattice({0, 0, 0}, 14, 12, dimension == 3 ? 10 : 1, 1.0);
        disturb(positions, 0.2, 11, dimension);
        auto& part = world.add_part(TestGas(1.0, 2.0, 1.4), positions, 1.0, 1.2);
        part.constants.laminar_viscosity = 0.03;
        world.open_state();
        std::vector<Vec3> random(world.state.size());
        disturb(random, 0.5, 12, dimension);
        world.state.velocity = random;
        body = world.make_body();
    }
};

template <class Lane, class K>
std::vector<double> rates(const ParticleBody& body, int dimension)
{
    std::vector<double> all;
    for (const NeighbourRun& run : body.runs()) {
        std::vector<double> rate(run.length());
        DensityRate<Lane, K> pass(body.arrays().motion.data(), run.begin, dimension, 0.01, rate.data());
        walk_pairs<Lane>(run, pass);
        all.insert(all.end(), rate.begin(), rate.end());
    }
    return all;
}

template <class Lane, class K>
std::vector<ForceSums> forces(const ParticleBody& body, int dimension)
{
    std::vector<ForceSums> all;
    for (const NeighbourRun& run : body.runs()) {
        std::vector<ForceSums> sums(run.length());
        const auto& arrays = body.arrays();
        const PairRecords records{arrays.motion.data(), arrays.push.data(), nullptr};
        PairForce<Lane, K, false> pass(records, run.begin, dimension, {1.5, 1.0}, sums.data());
        walk_pairs<Lane>(run, pass);
        all.insert(all.end(), sums.begin(), sums.end());
    }
    return all;
}

} // namespace

TEST(LaneLines, LoadsAndAddsLikeTheScalarText)
{
    alignas(64) double records[12 * 8], half[12 * 4], sums[12 * 8] = {}, expected[12 * 8] = {};
    for (int i = 0; i < 96; ++i) records[i] = i * 1.25 - 7;
    for (int i = 0; i < 48; ++i) half[i] = 3 * i + 0.5;
    const std::uint16_t place[8] = {3, 11, 0, 7, 3, 5, 1, 9}; // 3 twice
    Lanes line[8], quarter[4];
    load_lines(records, place, line);
    load_half_lines(half, place, quarter);
    for (int l = 0; l < 8; ++l) {
        for (int k = 0; k < 8; ++k) EXPECT_EQ(line[k][l], records[place[l] * 8 + k]);
        for (int k = 0; k < 4; ++k) EXPECT_EQ(quarter[k][l], half[place[l] * 4 + k]);
        for (int k = 0; k < 8; ++k) expected[place[l] * 8 + k] += line[k][l];
    }
    add_to_lines(sums, place, line);
    for (int i = 0; i < 96; ++i) EXPECT_EQ(sums[i], expected[i]);
    subtract_from_lines(sums, place, line);
    for (double sum : sums) EXPECT_EQ(sum, 0); // multiples of 1/4: exact
    add_to_lines(sums, place, line);
    add_sums_to_line(sums, line);
    for (int k = 0; k < 8; ++k) EXPECT_DOUBLE_EQ(sums[k], expected[k] + sum_of_lanes(line[k]));
    add_to_places(sums, place, line[0]);
    EXPECT_EQ(sums[3], expected[3] + sum_of_lanes(line[3]) + line[0][0] + line[0][4]);
}

TEST(LaneLines, EstimatesKeepEightDigits)
{
    for (double a : {1e-200, 3e-7, 0.11, 1.0, 2.5, 7e11}) {
        // One Newton step squares the relative error 2^-14 of the estimate.
        EXPECT_NEAR(reciprocal(broadcast<Lanes>(a))[0] * a, 1, 4e-9);
        EXPECT_NEAR(reciprocal_root(broadcast<Lanes>(a))[0] * std::sqrt(a), 1, 6e-9);
    }
}

class SphPasses : public ::testing::TestWithParam<std::pair<Kernel, int>> {};

/// The lanes differ from the plain text by the estimates (6e-9) and by the order of sums.
TEST_P(SphPasses, LanesEqualTheScalarReference)
{
    const auto [kernel, dimension] = GetParam();
    const Block block(kernel, dimension);
    with_kernel(kernel, [&, dimension = dimension]<class K>(K) {
        const auto lanes = rates<Lanes, K>(*block.body, dimension);
        const auto plain = rates<double, K>(*block.body, dimension);
        ASSERT_EQ(lanes.size(), block.world.state.size());
        for (std::size_t p = 0; p < plain.size(); ++p) EXPECT_NEAR(lanes[p], plain[p], 1e-7);
        const auto lane_sums = forces<Lanes, K>(*block.body, dimension);
        const auto sums = forces<double, K>(*block.body, dimension);
        double largest = 0;
        for (std::size_t p = 0; p < sums.size(); ++p) {
            EXPECT_LT(norm(lane_sums[p].force - sums[p].force), 1e-7);
            EXPECT_LT(norm(lane_sums[p].viscous_force - sums[p].viscous_force), 1e-7);
            EXPECT_NEAR(lane_sums[p].heat, sums[p].heat, 1e-7);
            largest = std::max(largest, norm(sums[p].force));
        }
        EXPECT_GT(largest, 0.1) << "the test would show nothing";
    });
}

/// Every pair from the definition, particle by particle, without lists.
TEST_P(SphPasses, EqualTheDoubleSumOverAllParticles)
{
    const auto [kernel, dimension] = GetParam();
    const Block block(kernel, dimension);
    with_kernel(kernel, [&, dimension = dimension]<class K>(K) {
        const auto rate = rates<double, K>(*block.body, dimension);
        const auto sums = forces<double, K>(*block.body, dimension);
        const auto& motion = block.body->arrays().motion;
        const auto& push = block.body->arrays().push;
        for (std::size_t i = 0; i < motion.size(); i += 7) {
            double expected_rate = 0;
            Vec3 expected_force{};
            for (std::size_t j = 0; j < motion.size(); ++j) {
                if (i == j) continue;
                const Vec3 v = motion[i].velocity - motion[j].velocity;
                const double h = 0.5 * (motion[i].smoothing + motion[j].smoothing);
                const auto gradient = [&](const Vec3& r) {
                    return K::norm(dimension) / std::pow(h, dimension + 1) * K::slope(norm(r) / h) / norm(r) *
                           r;
                };
                const Vec3 middle = motion[i].position - motion[j].position - 0.01 * v;
                expected_rate += motion[j].weight * dot(v, gradient(middle));
                const Vec3 r = motion[i].position - motion[j].position;
                const double opening = dot(v, r) / (dot(r, r) + 0.01 * h * h),
                             mu = h * std::min(opening, 0.0);
                const double mean_sound = 0.5 * (push[i].sound + push[j].sound);
                double pi = (1.5 * mu * mu - 1.0 * mean_sound * mu) * 0.5 * (push[i].scale + push[j].scale);
                pi -= (push[i].viscosity + push[j].viscosity) * opening;
                expected_force -=
                    motion[i].weight * motion[j].weight * (push[i].push + push[j].push + pi) * gradient(r);
            }
            EXPECT_NEAR(rate[i], expected_rate, 1e-12);
            EXPECT_LT(norm(sums[i].force - expected_force), 1e-11);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(
    Kernels, SphPasses,
    ::testing::Values(std::pair{Kernel::cubic_spline, 3}, std::pair{Kernel::cubic_spline, 2},
                      std::pair{Kernel::quintic_spline, 3}, std::pair{Kernel::quadratic, 2},
                      std::pair{Kernel::quartic_spline, 3}, std::pair{Kernel::wendland_c2, 3},
                      std::pair{Kernel::wendland_c4, 2}));

} // namespace plash
