#include "tests/paths.h"
#include "tests/support/ascii_reader.h"
#include "tests/support/shared_files.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>

#include <algorithm>

/// Two plates clamped by a preloaded bolt and pulled apart, beside LS-DYNA's own files (R13.1, SMP, double
/// precision). docs/results/bolt.md says what differs and why.
namespace plash {

using testing::shared_file;
using testing::text_of;

namespace {

const std::string bolt_folder = "decks/targets/bolt_preload_pull/";
constexpr Id head = 1200000, nut = 1100002;

/// Runs the deck to a time, into `results`.
bool run_bolt(double until, const testing::TemporaryFolder& results)
{
    const std::string command =
        fmt::format("'{}' run '{}' -j 1 -o '{}' --until {} > /dev/null", PLASH_PROGRAM,
                    shared_file(bolt_folder + "mainboltbexpl.k").string(), results.path().string(), until);
    return std::system(command.c_str()) == 0;
}

/// Tables of displacements; those of rotations stand between them.
std::vector<testing::NodoutFile::Table> motion_in(const std::filesystem::path& path)
{
    auto tables = testing::read_nodout(text_of(path)).tables;
    std::erase_if(tables, [](const auto& table) { return table.motion.empty(); });
    return tables;
}

/// The state nearest to a time.
template <class States>
const auto& at(const States& states, double time)
{
    return *std::min_element(states.begin(), states.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.time - time) < std::abs(b.time - time);
    });
}

/// Displacement along y and its speed; states a step apart are brought to the same time.
std::pair<double, double> along_y(const testing::NodoutFile::Table& table, Id node, double time)
{
    for (const auto& row : table.motion) {
        if (row.id != node) continue;
        return {row.displacement.y + (time - table.time) * row.velocity.y, row.velocity.y};
    }
    return {};
}

} // namespace

/// The first step to its last printed digit, the free flight of head and nut under the growing force, and
/// where both touch: the nut 1.0 mm on, the head 1.16 (shells thinned by their short sides).
TEST(BoltPreload, StartsAsLsDynaDoes)
{
    PLASH_NEED_SHARED(shared_file(bolt_folder + "mainboltbexpl.k"));
    const testing::TemporaryFolder results;
    ASSERT_TRUE(run_bolt(0.171, results));
    EXPECT_NEAR(testing::read_glstat(text_of(results / "glstat")).states.front().step, 2.11870e-4, 1e-9);
    const auto ours = motion_in(results / "nodout");
    const auto theirs = motion_in(shared_file(bolt_folder + "nodout"));
    for (const double time : {0.0498, 0.0998, 0.1498, 0.1648, 0.1699}) {
        const auto& reference = at(theirs, time);
        for (const Id node : {head, nut}) {
            if (node == nut && time > 0.16) continue; // touches already
            const auto [way, speed] = along_y(at(ours, reference.time), node, reference.time);
            const auto [their_way, their_speed] = along_y(reference, node, reference.time);
            EXPECT_NEAR(way / their_way, 1, 3e-3) << node << " at " << time;
            EXPECT_NEAR(speed / their_speed, 1, 5e-3) << node << " at " << time;
        }
    }
}

// Wanted within 3 % (sliding 10 %), measured: internal energy at the four times -16, -16, -15, -15 %, sliding
// +35, +27, +14, +16 %, work +6, +11 %, bolt force at the end +7 %, force transducer +10 %, node 1200000 +7 %
// (40 s).
TEST(BoltPreload, DISABLED_EndsAsLsDynaDoes)
{
    PLASH_NEED_SHARED(shared_file(bolt_folder + "mainboltbexpl.k"));
    const testing::TemporaryFolder results;
    ASSERT_TRUE(run_bolt(5.1, results));
    const auto ours = testing::read_glstat(text_of(results / "glstat")).states;
    const auto theirs = testing::read_glstat(text_of(shared_file(bolt_folder + "glstat"))).states;
    for (const double time : {0.49996, 0.999901, 2.99985, 4.99989}) {
        const auto &mine = at(ours, time), &reference = at(theirs, time);
        EXPECT_NEAR(mine.step / reference.step, 1, 0.01) << time;
        EXPECT_NEAR(mine.internal / reference.internal, 1, 0.03) << time;
        EXPECT_NEAR(mine.sliding / reference.sliding, 1, 0.1) << time;
        if (time < 1) continue;
        EXPECT_NEAR(mine.external_work / reference.external_work, 1, 0.03) << time;
    }
    const auto nodes = motion_in(results / "nodout");
    EXPECT_NEAR(along_y(nodes.back(), head, nodes.back().time).first, -6.13961, 0.03 * 6.13961);
}

} // namespace plash
