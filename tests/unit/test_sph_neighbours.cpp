#include "sph/neighbours.h"

#include "core/run_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <omp.h>
#include <random>
#include <set>

namespace plash {

namespace {

struct Cloud {
    static constexpr double support = 2, smoothing = 0.3;
    std::vector<Vec3> given, position; ///< as made, and by sorted place
    std::vector<float> given_skin, skin;
    std::vector<std::uint8_t> given_asleep, asleep,
        group; ///< asleep: of particles, the images stand behind them
    std::vector<std::uint64_t> sees;
    ParticleCells cells;
    std::vector<NeighbourRun> runs;

    Cloud(std::size_t count, unsigned seed, bool with_images)
    {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> unit(0, 1);
        for (std::size_t i = 0; i < count; ++i) {
            given.push_back({12 * unit(random), 5 * unit(random), 3 * unit(random)});
            if (i % 97 == 0) given.back() = 40.0 * given.back(); // spray, far away
            given_skin.push_back(static_cast<float>(0.4 * unit(random)));
        }
        given_asleep.resize(with_images ? count - count / 5 : count);
        for (std::uint8_t& sleeps : given_asleep) sleeps = with_images && unit(random) < 0.1;
        sort(1.0);
    }
    /// Sorts into cells of that side, and builds.
    void sort(double side)
    {
        cells.sort(given, side, given_asleep.size());
        for (auto* values : {&asleep, &group}) values->clear();
        position.clear();
        skin.clear();
        for (Index from : cells.order()) {
            position.push_back(given[from]);
            skin.push_back(given_skin[from]);
            if (asleep.size() < given_asleep.size()) asleep.push_back(given_asleep[from]);
            group.push_back(static_cast<std::uint8_t>(from % 3));
        }
        build();
    }
    void build(std::size_t largest_halo = 65536)
    {
        std::vector<MotionRecord> motion(position.size());
        for (std::size_t p = 0; p < position.size(); ++p) motion[p] = {position[p], smoothing, {}, 0};
        std::vector<float> reach;
        for (std::size_t p = 0; p < position.size(); ++p) {
            reach.push_back(static_cast<float>(0.5 * (support * smoothing + skin[p])));
        }
        build_neighbours(cells, {motion, reach, asleep.size(), asleep, group, sees}, runs, largest_halo);
    }

    /// margin  taken for reach, too [length]
    bool close(Index a, Index b, double margin = 0) const
    {
        const Vec3 apart = position[a] - position[b];
        const auto reach = [&](Index p) {
            return static_cast<double>(static_cast<float>(0.5 * (support * smoothing + skin[p])));
        };
        const double limit = reach(a) + reach(b) + margin;
        return a != b && dot(apart, apart) < limit * limit;
    }
    bool looks(Index a) const { return a < static_cast<Index>(asleep.size()) && !asleep[a]; }
    bool seen(Index a, Index b) const { return sees.empty() || (sees[group[a]] >> group[b] & 1); }
};

using Pairs = std::multiset<std::pair<Index, Index>>;

/// Directed pairs (who adds, whose influence) as the pair loop will walk them.
Pairs walked_pairs(const Cloud& cloud)
{
    Pairs pairs;
    for (const NeighbourRun& run : cloud.runs) {
        std::size_t inside = 0, outside = 0;
        for (Index i = 0; i < run.length(); ++i) {
            const Index p = run.begin + i;
            EXPECT_EQ(run.counts[i].inside % pair_count, 0) << "two batches at a time";
            for (int k = 0; k < run.counts[i].inside; ++k) {
                const Index other = run.begin + run.inside[inside++];
                if (other == p) continue; // filling
                pairs.insert({p, other});
                pairs.insert({other, p});
            }
            for (int k = 0; k < run.counts[i].outside; ++k) {
                pairs.insert({p, run.halo[run.outside[outside++]]});
            }
        }
        EXPECT_EQ(inside, run.inside.size());
        EXPECT_EQ(outside > 0 ? outside + lane_count : 0, run.outside.size()) << "room to read a batch";
    }
    return pairs;
}

Pairs all_close_pairs(const Cloud& cloud)
{
    Pairs pairs;
    const auto count = static_cast<Index>(cloud.position.size());
    for (Index a = 0; a < count; ++a)
        for (Index b = 0; b < count; ++b)
            if (cloud.looks(a) && cloud.close(a, b) && cloud.seen(a, b)) pairs.insert({a, b});
    return pairs;
}

/// All close pairs stand on the lists, once; and no others but those that positions in single precision do
/// not tell from close ones.
void expect_close_pairs(const Cloud& cloud)
{
    const Pairs expected = all_close_pairs(cloud), walked = walked_pairs(cloud);
    EXPECT_TRUE(std::includes(walked.begin(), walked.end(), expected.begin(), expected.end()));
    std::vector<std::pair<Index, Index>> others;
    std::set_difference(walked.begin(), walked.end(), expected.begin(), expected.end(),
                        std::back_inserter(others));
    for (const auto& [a, b] : others) {
        EXPECT_TRUE(cloud.close(a, b, 4e-6 * cloud.cells.side()) && !cloud.close(a, b)) << a << " " << b;
        EXPECT_TRUE(cloud.looks(a) && cloud.seen(a, b));
    }
}

} // namespace

TEST(SphNeighbours, ListsEveryClosePairOnceAndNoOther)
{
    Cloud cloud(4000, 1, false);
    ASSERT_GT(all_close_pairs(cloud).size(), 20000u);
    expect_close_pairs(cloud);
}

/// Runs with more neighbours outside than 16 bits can number are cut in halves.
TEST(SphNeighbours, RunsAreCutUntilTheirHalosFit)
{
    Cloud cloud(4000, 1, false);
    const std::size_t whole = cloud.runs.size();
    cloud.build(250);
    EXPECT_GT(cloud.runs.size(), whole);
    for (const NeighbourRun& run : cloud.runs) EXPECT_LE(run.halo.size(), 250u);
    expect_close_pairs(cloud);
    EXPECT_THROW(cloud.build(10), RunError);
}

TEST(SphNeighbours, ImagesAndSleepersAreSeenButSeeNothing)
{
    Cloud cloud(3000, 2, true);
    expect_close_pairs(cloud);
}

/// Small particles crowd in the cells of a few that reach far: candidates are narrowed for groups of them.
TEST(SphNeighbours, ListsEveryClosePairOfParticlesOfManySizes)
{
    Cloud cloud(6000, 6, true);
    for (std::size_t i = 0; i < 6000; ++i) cloud.given_skin[i] = i % 50 == 0 ? 6.0f : -0.1f;
    cloud.sort(7.0);
    ASSERT_GT(all_close_pairs(cloud).size(), 100000u);
    expect_close_pairs(cloud);
}

TEST(SphNeighbours, GroupsSeeOnlyWhomTheyMay)
{
    Cloud cloud(3000, 3, true);
    cloud.sees = {0b011, 0b111, 0b110}; // groups 0 and 2 do not see each other
    cloud.build();
    expect_close_pairs(cloud);
}

TEST(SphNeighbours, TheOrderIsAFunctionOfThePositionsAlone)
{
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    const Cloud one(20000, 4, true);
    for (int threads : {2, 3, 7}) {
        omp_set_num_threads(threads);
        const Cloud many(20000, 4, true);
        ASSERT_EQ(many.cells.order(), one.cells.order());
        ASSERT_EQ(many.runs.size(), one.runs.size());
        for (std::size_t r = 0; r < one.runs.size(); ++r) {
            ASSERT_EQ(many.runs[r].inside, one.runs[r].inside);
            ASSERT_EQ(many.runs[r].outside, one.runs[r].outside);
            ASSERT_EQ(many.runs[r].halo, one.runs[r].halo);
        }
    }
    omp_set_num_threads(before);
}

TEST(SphNeighbours, CellsHoldEveryParticleAndImageOnce)
{
    const Cloud cloud(5000, 5, true);
    const auto fits = [&](Index begin, Index end) {
        Vec3 lower{INFINITY, INFINITY, INFINITY}, upper = -lower;
        for (Index p = begin; p < end; ++p) {
            const Vec3& x = cloud.position[p];
            lower = {std::min(lower.x, x.x), std::min(lower.y, x.y), std::min(lower.z, x.z)};
            upper = {std::max(upper.x, x.x), std::max(upper.y, x.y), std::max(upper.z, x.z)};
        }
        return begin == end || std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z}) < 1;
    };
    Index held = 0;
    for (Index cell = 0; cell < cloud.cells.cell_count(); ++cell) {
        const Index begin = cloud.cells.begin(cell), end = cloud.cells.end(cell);
        const Index copies = cloud.cells.first_copy(cell), copies_end = cloud.cells.first_copy(cell + 1);
        for (Index p = begin; p < end; ++p) EXPECT_EQ(cloud.cells.cell_of_place(p), cell);
        EXPECT_TRUE(fits(begin, end) && fits(copies, copies_end)) << "cell " << cell;
        held += end - begin + copies_end - copies;
    }
    EXPECT_EQ(held, 5000);
    const std::set<Index> given(cloud.cells.order().begin(), cloud.cells.order().end());
    EXPECT_EQ(given.size(), 5000u);
}

TEST(SphNeighbours, RadixSortIsStable)
{
    std::mt19937_64 random(7);
    std::vector<std::uint64_t> key(100000);
    std::vector<Index> value(key.size());
    for (std::size_t i = 0; i < key.size(); ++i) {
        key[i] = random() % 3000;
        value[i] = static_cast<Index>(i);
    }
    const std::vector<std::uint64_t> original = key;
    sort_by_key(key, value, 12);
    for (std::size_t i = 0; i < key.size(); ++i) {
        ASSERT_EQ(key[i], original[value[i]]);
        if (i == 0) continue;
        ASSERT_TRUE(key[i - 1] < key[i] || (key[i - 1] == key[i] && value[i - 1] < value[i]));
    }
}

} // namespace plash
