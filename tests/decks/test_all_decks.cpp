// Every deck of other people: no fault of the reader, no false error, the counts of their index, and nearly
// every keyword known. bench/check_decks.py writes the same as a page.

#include "parser/read_model.h"
#include "tests/decks/shared_decks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace plash {
namespace {

/// A row of the index: which deck, whether it looks complete, and its counts.
struct Indexed {
    std::string deck;
    bool complete = false;
    long nodes = 0, shells = 0, solids = 0, beams = 0, particles = 0;
};

std::vector<Indexed> index_of(const std::string& folder)
{
    std::vector<Indexed> rows;
    std::ifstream file(folder + "/INDEX.md");
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("| targets/") && !line.starts_with("| corpus/")) continue;
        std::vector<std::string> cells;
        std::stringstream stream(line.substr(2));
        for (std::string cell; std::getline(stream, cell, '|');) {
            const auto end = cell.find_last_not_of(' ');
            cells.push_back(cell.substr(0, end == std::string::npos ? 0 : end + 1));
        }
        const auto number = [&](std::size_t column) { return std::stol(cells.at(column)); };
        rows.push_back({cells.at(0), number(1) == 1, number(3), number(4), number(5), number(6), number(7)});
    }
    return rows;
}

/// Decks whose counts differ from the index for a good reason; bench/check_decks.py tells which.
constexpr std::string_view counted_otherwise[] = {
    "EXP_SC_JOINT_SCREW.key", "full_files/sample.k",   "test_node_param.k",    "test_param_format_error.k",
    "eccentric/eccentric",    "TMP/keyfile.key",       "50F-pedestrian_TB024", "PIPER_run_vivaplus.key",
    "mlp6+fem/examples/",     "batmac_cylinder/main.k"};

/// Decks that look complete and are wrong, with a part of what is wrong.
constexpr std::pair<std::string_view, std::string_view> broken[] = {
    {"0/0/open_airbag_v9.k", "part 1 has no section"},
    {"airfilled.sphere.reduced_mesh.k", "has node 6, which is not defined"},
    {"mat_fn_rubber.element.reduced_mesh.k", "has node 5, which is not defined"},
    {"plate-shatter.reduced_mesh.k", "has node 22, which is not defined"},
    {"full_files/thick.k", "has node 10, which is not defined"},
    {"keywords/test_node_sets.k", "names node 12011, which is not defined"},
    {"pythonScripts/verification/", "is of part 3, which is not defined"},
    {"rod_coarse_numExS05.k", "there is no material 4"},
    {"umat41/concentric/concentric.k", "there is no parameter 'loadm'"},
    {"umat41/eccentric/eccentric", "there is no parameter 'rampLen'"},
};

/// Keywords of physics that Plash does not aim at.
bool elsewhere(std::string_view name)
{
    constexpr std::string_view words[] = {
        "IMPLICIT",      "THERMAL",         "ICFD_",         "CESE",
        "BATTERY",       "USER_DEFINED",    "BOUNDARY_HEAT", "BOUNDARY_RADIATION",
        "TEMPERATURE",   "FREQUENCY",       "EIGENVALUE",    "BOUNDARY_CONVECTION",
        "BOUNDARY_FLUX", "USER_SUBROUTINE", "MESH_"};
    return name.starts_with("EM_") ||
           std::any_of(std::begin(words), std::end(words),
                       [&](std::string_view word) { return name.find(word) != std::string_view::npos; });
}

class AllDecks : public ::testing::Test {
protected:
    void SetUp() override
    {
        if (shared_decks().empty()) GTEST_SKIP() << "no decks of other people at hand: set PLASH_SHARED";
    }
};

} // namespace

TEST_F(AllDecks, AreReadWithoutAFalseErrorAndCountedAsTheIndexSays)
{
    const std::vector<Indexed> index = index_of(shared_decks());
    ASSERT_GE(index.size(), 300u);
    long known = 0, blocks = 0;
    for (const Indexed& row : index) {
        const ReadResult result = read_model(shared_decks() + "/" + row.deck);
        const Report& report = result.report;
        const bool other_count =
            std::any_of(std::begin(counted_otherwise), std::end(counted_otherwise),
                        [&](std::string_view part) { return row.deck.find(part) != std::string::npos; });
        if (!other_count) {
            EXPECT_EQ(static_cast<long>(result.model.nodes.size()), row.nodes) << row.deck;
            EXPECT_EQ(report.elements.shell, row.shells) << row.deck;
            EXPECT_EQ(report.elements.solid, row.solids) << row.deck;
            EXPECT_EQ(report.elements.beam, row.beams) << row.deck;
            EXPECT_EQ(report.elements.sph, row.particles) << row.deck;
        }
        std::string_view expected;
        for (const auto& [part, message] : broken)
            if (row.deck.find(part) != std::string::npos) expected = message;
        std::string faults;
        for (const Message& message : report.errors)
            if (message.text.find("not supported") == std::string::npos)
                faults += to_text(message, result.model) + "\n";
        if (row.complete && expected.empty()) {
            EXPECT_EQ(faults, "") << row.deck;
        }
        if (!expected.empty()) {
            EXPECT_NE(faults.find(expected), std::string::npos) << row.deck << "\n" << faults;
        }
        for (const auto& [name, use] : report.keywords) {
            if (elsewhere(name)) continue;
            blocks += use.blocks;
            if (use.status != KeywordStatus::unknown) known += use.blocks;
        }
    }
    EXPECT_GT(blocks, 19'000);
    EXPECT_GE(static_cast<double>(known), 0.97 * static_cast<double>(blocks)); // the share that is asked for
}

} // namespace plash
