#include "parser/read_model.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fstream>

namespace plash {

namespace {

struct Keyword {
    const char* name;
    Contact::Kind kind;
    Tie::Method tie = Tie::Method::none;
    const char* card4 = ""; ///< the card that only this keyword has
};

ReadResult read(const Keyword& keyword, const std::string& suffix)
{
    const testing::TemporaryFolder folder;
    std::string deck =
        "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0,0.3\n"
        "*PART\na\n1,1,1\n*PART\nb\n2,1,1\n";
    deck += fmt::format("*{}{}\n", keyword.name, suffix);
    if (suffix.find("_ID") != std::string::npos || suffix.find("_TITLE") != std::string::npos)
        deck += "77,heading\n";
    if (suffix.find("_MPP") != std::string::npos) deck += "0,200\n";
    deck += "1,2,3,3\n0.2,0.1,0.0,0.0,20.0,0,0.0,1.0e20\n1.0,1.0,0.0,0.0,1.0,1.0,1.0,1.0\n";
    deck += keyword.card4;
    // Optional cards A to F.
    deck += "1,0.2,0,1.025,2.0,2,0,1\n0.0,0,0,0,0,0,0.0,0.0\n1,1\n0\n0\n0\n*END\n";
    std::ofstream(folder / "deck.k") << deck;
    return read_model(folder / "deck.k");
}

} // namespace

class ContactKeywords : public ::testing::TestWithParam<Keyword> {};

/// Every name runs, bare and with each suffix, and the cards behind its own are the optional ones.
TEST_P(ContactKeywords, RunWithAllSuffixes)
{
    for (const char* suffix : {"", "_ID", "_TITLE", "_MPP", "_MPP_ID"}) {
        const ReadResult result = read(GetParam(), suffix);
        ASSERT_TRUE(result.ok) << GetParam().name << suffix << ": "
                               << (result.report.errors.empty() ? "" : result.report.errors[0].text);
        for (const Message& message : unsupported_keywords(result.report))
            ADD_FAILURE() << message.text << suffix;
        ASSERT_EQ(result.model.contacts.size(), 1u);
        const Contact& contact = result.model.contacts[0];
        EXPECT_EQ(contact.kind, GetParam().kind) << suffix;
        EXPECT_EQ(contact.tie.method, GetParam().tie) << suffix;
        EXPECT_EQ(contact.soft, 1) << suffix;
        EXPECT_EQ(contact.soft_scale, 0.2);
        EXPECT_EQ(contact.slave.parts, std::vector<Index>{0});
        const bool numbered = std::string_view(suffix).find("ID") != std::string_view::npos ||
                              std::string_view(suffix).find("TITLE") != std::string_view::npos;
        if (numbered) {
            EXPECT_EQ(contact.id, 77) << suffix;
        }
    }
}

using K = Contact::Kind;
using M = Tie::Method;
INSTANTIATE_TEST_SUITE_P(
    Names, ContactKeywords,
    ::testing::Values(
        Keyword{"CONTACT_AUTOMATIC_SINGLE_SURFACE", K::single_surface},
        Keyword{"CONTACT_SINGLE_SURFACE", K::single_surface},
        Keyword{"CONTACT_AIRBAG_SINGLE_SURFACE", K::single_surface},
        Keyword{"CONTACT_AUTOMATIC_GENERAL", K::general},
        Keyword{"CONTACT_AUTOMATIC_GENERAL_INTERIOR", K::general},
        Keyword{"CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", K::two_way},
        Keyword{"CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE", K::one_way},
        Keyword{"CONTACT_AUTOMATIC_NODES_TO_SURFACE", K::one_way},
        Keyword{"CONTACT_AUTOMATIC_BEAMS_TO_SURFACE", K::one_way},
        Keyword{"CONTACT_SURFACE_TO_SURFACE", K::two_way},
        Keyword{"CONTACT_ONE_WAY_SURFACE_TO_SURFACE", K::one_way},
        Keyword{"CONTACT_NODES_TO_SURFACE", K::one_way},
        Keyword{"CONTACT_CONSTRAINT_NODES_TO_SURFACE", K::one_way, M::none, "0.0\n"},
        Keyword{"CONTACT_ERODING_SINGLE_SURFACE", K::single_surface, M::none, "0,1,1\n"},
        Keyword{"CONTACT_ERODING_NODES_TO_SURFACE", K::one_way, M::none, "0,1,1\n"},
        Keyword{"CONTACT_ERODING_SURFACE_TO_SURFACE", K::two_way, M::none, "0,1,1\n"},
        Keyword{"CONTACT_TIED_NODES_TO_SURFACE", K::tied, M::constrained},
        Keyword{"CONTACT_TIED_NODES_TO_SURFACE_OFFSET", K::tied, M::penalty},
        Keyword{"CONTACT_TIED_NODES_TO_SURFACE_CONSTRAINED_OFFSET", K::tied, M::constrained_offset},
        Keyword{"CONTACT_TIED_SURFACE_TO_SURFACE", K::tied, M::constrained},
        Keyword{"CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET", K::tied, M::penalty},
        Keyword{"CONTACT_TIED_SURFACE_TO_SURFACE_CONSTRAINED_OFFSET", K::tied, M::constrained_offset},
        Keyword{"CONTACT_TIED_SURFACE_TO_SURFACE_FAILURE", K::tied, M::penalty},
        Keyword{"CONTACT_TIED_SHELL_EDGE_TO_SURFACE", K::tied, M::constrained},
        Keyword{"CONTACT_TIED_SHELL_EDGE_TO_SURFACE_OFFSET", K::tied, M::penalty},
        Keyword{"CONTACT_TIED_SHELL_EDGE_TO_SURFACE_BEAM_OFFSET", K::tied, M::penalty},
        Keyword{"CONTACT_TIED_SHELL_EDGE_TO_SURFACE_CONSTRAINED_OFFSET", K::tied, M::constrained_offset},
        Keyword{"CONTACT_TIED_SHELL_EDGE_TO_SOLID", K::tied, M::constrained},
        Keyword{"CONTACT_SPOTWELD", K::tied, M::constrained},
        Keyword{"CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", K::two_way, M::penalty, "2,5.0,5.0\n"},
        Keyword{"CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE_TIEBREAK", K::one_way, M::penalty,
                "6,5.0,5.0,0.1\n"},
        Keyword{"CONTACT_TIEBREAK_NODES_TO_SURFACE", K::one_way, M::penalty, "5.0,5.0,2.0,2.0\n"},
        Keyword{"CONTACT_TIEBREAK_NODES_ONLY", K::tied, M::penalty, "5.0,5.0,2.0,2.0\n"},
        Keyword{"CONTACT_TIEBREAK_SURFACE_TO_SURFACE", K::two_way, M::penalty, "5.0,5.0\n"}),
    [](const auto& info) { return std::string(info.param.name).substr(8); });

/// An option of TIEBREAK that is not there is an error that names it.
TEST(ContactKeyword, TiebreakOptionThatIsNotThere)
{
    const ReadResult result =
        read({"CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", K::two_way, M::penalty, "9,5.0,5.0\n"}, "");
    ASSERT_EQ(result.report.errors.size(), 1u);
    EXPECT_EQ(result.report.errors[0].field, "OPTION");
    EXPECT_NE(result.report.errors[0].text.find("9 is not supported; 1, 2, 3, 4, 6 and 8 are"),
              std::string::npos);
}

/// SOFT = 2 looks at edges where DEPTH says so.
TEST(ContactKeywordsOfSegments, DepthAsksForEdges)
{
    const auto edges_of = [](const std::string& name, int soft, int depth) {
        const testing::TemporaryFolder folder;
        std::ofstream(folder / "deck.k")
            << "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0,0.3\n"
               "*PART\na\n1,1,1\n*PART\nb\n2,1,1\n"
            << fmt::format("*CONTACT_{}\n1,2,3,3\n0\n0\n{},,,,,{}\n*END\n", name, soft, depth);
        return read_model(folder / "deck.k").model.contacts.at(0).edges;
    };
    for (const int depth : {3, 5, 13, 25, 35}) {
        EXPECT_TRUE(edges_of("AUTOMATIC_SINGLE_SURFACE", 2, depth)) << depth;
        EXPECT_TRUE(edges_of("AUTOMATIC_SURFACE_TO_SURFACE", 2, depth)) << depth;
        EXPECT_FALSE(edges_of("AUTOMATIC_SINGLE_SURFACE", 1, depth)) << depth;
    }
    for (const int depth : {0, 2, 4}) EXPECT_FALSE(edges_of("AUTOMATIC_SINGLE_SURFACE", 2, depth)) << depth;
    EXPECT_TRUE(edges_of("AUTOMATIC_GENERAL", 0, 2));
}

/// Contacts without a number are counted as they stand in the deck; numbers that are given stay.
TEST(ContactNumbers, FollowTheDeck)
{
    const testing::TemporaryFolder folder;
    std::ofstream file(folder / "deck.k");
    file << "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0,0.3\n"
            "*PART\na\n1,1,1\n";
    const std::string bare = "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n",
                      numbered = bare.substr(0, bare.size() - 1);
    file << bare << "1,,3\n0\n0\n"
         << numbered << "_ID\n2,given\n1,,3\n0\n0\n"
         << bare << "1,,3\n0\n0\n"
         << bare << "1,,3\n0\n0\n*END\n";
    file.close();
    const ReadResult result = read_model(folder / "deck.k");
    std::vector<Id> ids;
    for (const Contact& contact : result.model.contacts) ids.push_back(contact.id);
    EXPECT_EQ(ids, (std::vector<Id>{1, 2, 3, 4}));
}

} // namespace plash
