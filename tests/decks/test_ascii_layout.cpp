#include "output/ascii_text.h"
#include "tests/support/ascii_reader.h"
#include "tests/support/shared_files.h"

/// LS-DYNA's own files are read into plain numbers and printed again by our writers: every column must come
/// out where it was. Only the heading differs, which names the program.
namespace plash {

using testing::shared_file;
using testing::text_of;

namespace {

const char* const cantilever = "decks/targets/shell_cantilever_nip3/";
const char* const bolt = "decks/targets/bolt_preload_pull/";

std::string line_of(const std::string& text, std::size_t position)
{
    const std::size_t begin = text.rfind('\n', position) + 1;
    return text.substr(begin, text.find('\n', position) - begin);
}

/// Compares texts and shows the first line that differs.
void expect_same_text(const std::string& ours, const std::string& theirs)
{
    const auto [a, b] = std::mismatch(ours.begin(), ours.end(), theirs.begin(), theirs.end());
    if (a == ours.end() && b == theirs.end()) return;
    const std::size_t place = a - ours.begin();
    ADD_FAILURE() << "first difference at byte " << place << ":\nours:    " << line_of(ours, place)
                  << "\nLS-DYNA: " << line_of(theirs, place);
}

void expect_glstat_survives(const std::string& name, std::size_t states)
{
    const auto path = shared_file(name);
    PLASH_NEED_SHARED(path);
    const std::string theirs = text_of(path);
    const testing::GlstatFile file = testing::read_glstat(theirs);
    EXPECT_EQ(file.states.size(), states);
    std::string ours = file.heading;
    for (const GlobalStatistics& state : file.states) ours += format_glstat(state, file.with_hourglass);
    expect_same_text(ours, theirs);
}

void expect_nodout_survives(const std::string& name, std::size_t tables)
{
    const auto path = shared_file(name);
    PLASH_NEED_SHARED(path);
    const std::string theirs = text_of(path);
    const testing::NodoutFile file = testing::read_nodout(theirs);
    EXPECT_EQ(file.tables.size(), tables);
    std::string ours = file.heading + ascii_legend(file.legend);
    for (const auto& table : file.tables) {
        ours += table.motion.empty() ? format_nodout(table.cycle, table.time, table.rotation)
                                     : format_nodout(table.cycle, table.time, table.motion);
    }
    expect_same_text(ours, theirs);
}

} // namespace

// Counts of states from ../shared/decks/RESULTS.md: 101 and 1001 rows; nodout has a table of rotations each.
TEST(AsciiLayout, GlstatOfTheCantilever)
{
    expect_glstat_survives(std::string(cantilever) + "glstat", 101);
}

TEST(AsciiLayout, GlstatOfTheBolt)
{
    expect_glstat_survives(std::string(bolt) + "glstat", 1001);
}

TEST(AsciiLayout, NodoutOfTheCantilever)
{
    expect_nodout_survives(std::string(cantilever) + "nodout", 202);
}

TEST(AsciiLayout, NodoutOfTheBolt)
{
    expect_nodout_survives(std::string(bolt) + "nodout", 2002);
}

TEST(AsciiLayout, MatsumOfTheBolt)
{
    const auto path = shared_file(std::string(bolt) + "matsum");
    PLASH_NEED_SHARED(path);
    const std::string theirs = text_of(path);
    const testing::MatsumFile file = testing::read_matsum(theirs);
    EXPECT_EQ(file.states.size(), 1001u);
    std::string ours = file.heading + ascii_legend(file.legend);
    for (std::size_t i = 0; i < file.states.size(); ++i) ours += format_matsum(file.times[i], file.states[i]);
    expect_same_text(ours, theirs);
}

TEST(AsciiLayout, RcforcOfTheBolt)
{
    const auto path = shared_file(std::string(bolt) + "rcforc");
    PLASH_NEED_SHARED(path);
    const std::string theirs = text_of(path);
    const testing::ContactFile file = testing::read_rcforc(theirs);
    EXPECT_EQ(file.states.size(), 1001u);
    std::string ours = file.heading + ascii_legend(file.legend);
    for (const auto& state : file.states) ours += format_rcforc(state.time, state.contacts);
    expect_same_text(ours, theirs);
}

/// The totals are printed from sums that the file itself only has in four figures, so they are compared as
/// such.
TEST(AsciiLayout, SleoutOfTheBolt)
{
    const auto path = shared_file(std::string(bolt) + "sleout");
    PLASH_NEED_SHARED(path);
    const std::string theirs = text_of(path);
    const testing::ContactFile file = testing::read_sleout(theirs);
    EXPECT_EQ(file.states.size(), 1001u);
    std::string ours = file.heading + ascii_legend(file.legend);
    for (const auto& state : file.states) ours += format_sleout(state.time, state.cycle, state.contacts);
    const testing::ContactFile again = testing::read_sleout(ours);
    ASSERT_EQ(again.states.size(), file.states.size());
    for (std::size_t i = 0; i < file.states.size(); ++i) {
        for (int total = 0; total < 4; ++total) {
            // Of the summands one is at most 30, so rounded by 0.005 at most, the others by 0.0005.
            EXPECT_NEAR(again.states[i].total[total], file.states[i].total[total], 6e-3);
        }
    }
    // With the totals blanked, every byte is the same.
    const auto blanked = [](std::string text) {
        for (std::size_t at = 0; (at = text.find("=", at)) != std::string::npos; ++at) {
            const std::size_t end = text.find('\n', at);
            if (text.compare(at - 6, 6, "energy") == 0 || end - at == 15) text.erase(at + 1, end - at - 1);
        }
        return text;
    };
    expect_same_text(blanked(ours), blanked(theirs));
}

} // namespace plash
