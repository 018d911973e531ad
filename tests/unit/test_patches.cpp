#include "elements/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace plash {

namespace {

/// n x n x n cells of a lattice with their eight corners.
struct Lattice {
    std::vector<Vec3> position;
    std::vector<Index> elements, connectivity;

    explicit Lattice(int n)
    {
        const int m = n + 1;
        for (int k = 0; k < m; ++k)
            for (int j = 0; j < m; ++j)
                for (int i = 0; i < m; ++i) position.push_back({1.0 * i, 1.0 * j, 1.0 * k});
        const auto node = [m](int i, int j, int k) { return (k * m + j) * m + i; };
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    elements.push_back(static_cast<Index>(elements.size()));
                    for (int corner : {0, 1, 3, 2, 4, 5, 7, 6}) {
                        connectivity.push_back(
                            node(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2)));
                    }
                }
    }
};

State state_of(const Lattice& lattice)
{
    State state;
    state.position = lattice.position;
    state.velocity.resize(lattice.position.size());
    state.force.resize(lattice.position.size());
    std::mt19937 random(1);
    for (Vec3& v : state.velocity) v = {random() / 1e9, random() / 1e9, random() / 1e9};
    return state;
}

/// Every element adds a force that depends on its corner's velocity and its own number.
void scatter(Patches& patches, State& state)
{
    patches.for_each(state, false, [&](std::ptrdiff_t, const Patches::Patch& patch, NodeCopies& copies) {
        for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
            Lanes number{};
            for (int lane = 0; lane < lane_count; ++lane) {
                number[lane] = patches.elements[static_cast<std::size_t>(batch) * lane_count + lane] + 1;
            }
            for (int corner = 0; corner < 8; ++corner) {
                const auto* offset = patches.corner_offsets(batch, corner);
                const auto velocity = load_corner<Lanes>(copies.velocity.data(), offset);
                add_corner(copies.force.data(), offset, number * velocity, patches.active_lanes(batch));
            }
        }
    });
}

} // namespace

TEST(Patches, SumEveryElementOnceAtEveryCorner)
{
    const Lattice lattice(11);
    State state = state_of(lattice);
    Patches patches(8, lattice.elements, lattice.connectivity, lattice.position, 64);
    ASSERT_GT(patches.patches.size(), 10u);
    scatter(patches, state);

    std::vector<double> weight(state.size());
    for (std::size_t i = 0; i < lattice.connectivity.size(); ++i)
        weight[lattice.connectivity[i]] += i / 8 + 1;
    for (std::size_t node = 0; node < state.size(); ++node) {
        // Sums of eight products: round-off only.
        EXPECT_NEAR(state.force[node].x, weight[node] * state.velocity[node].x, 1e-12 * weight[node] * 4);
        EXPECT_NEAR(state.force[node].z, weight[node] * state.velocity[node].z, 1e-12 * weight[node] * 4);
    }
}

TEST(Patches, GiveTheSameBitsForAnyNumberOfThreads)
{
    const Lattice lattice(13);
    std::vector<Vec3> first;
    const int before = omp_get_max_threads();
    for (int threads : {1, 2, 4}) {
        omp_set_num_threads(threads);
        State state = state_of(lattice);
        Patches patches(8, lattice.elements, lattice.connectivity, lattice.position, 64);
        scatter(patches, state);
        if (first.empty()) first = state.force;
        for (std::size_t node = 0; node < state.size(); ++node) {
            ASSERT_EQ(state.force[node].x, first[node].x);
            ASSERT_EQ(state.force[node].y, first[node].y);
        }
    }
    omp_set_num_threads(before);
}

TEST(CornerAccess, LanesEqualTheScalarReference)
{
    alignas(64) double values[4 * 32], sum_lanes[4 * 32] = {}, sum_scalar[4 * 32] = {};
    for (int i = 0; i < 4 * 32; ++i) values[i] = i % 4 == 3 ? 0 : 1.5 * i;
    const std::uint16_t offset[8] = {40, 0, 4, 40, 124, 8, 60, 16};
    const auto lanes = load_corner<Lanes>(values, offset);
    add_corner(sum_lanes, offset, lanes, 7);
    for (int lane = 0; lane < 8; ++lane) {
        const auto one = load_corner<double>(values, offset + lane);
        EXPECT_EQ(lanes.x[lane], one.x);
        EXPECT_EQ(lanes.y[lane], one.y);
        EXPECT_EQ(lanes.z[lane], one.z);
        if (lane < 7) add_corner(sum_scalar, offset + lane, one, 1);
    }
    EXPECT_TRUE(std::equal(sum_lanes, sum_lanes + 4 * 32, sum_scalar));
}

} // namespace plash
