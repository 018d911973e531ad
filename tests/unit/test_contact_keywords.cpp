#include "contact/part_data.h"
#include "parser/layout.h"
#include "parser/read_model.h"
#include "solver/scene.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
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

ReadResult read_text(const std::string& cards)
{
    return read_model_text("deck.k",
                           "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n"
                           "1,1.0,1.0,0.3\n*PART\na\n1,1,1\n*PART\nb\n2,1,1\n" +
                               cards + "*END\n");
}

void expect_no_silent_field(const char* keyword)
{
    const KeywordLayout* layout = layout_table().find(keyword);
    ASSERT_TRUE(layout) << keyword;
    const auto expect = [&](const CardLayout& card, const auto& again) -> void {
        for (const FieldLayout& field : card.fields) {
            const auto& known = layout->ignored_fields;
            const bool explained = std::any_of(known.begin(), known.end(),
                                               [&](const auto& one) { return one.first == field.name; });
            const bool text = field.name == "HEADING" || field.name == "MPP2"; // titles, marks of a line
            EXPECT_TRUE(text || field.name.empty() || layout->honours(field.name) || explained)
                << keyword << " " << field.name;
        }
        for (const CardLayout& inner : card.group) again(inner, again);
    };
    for (const CardLayout& card : layout->cards) expect(card, expect);
    for (const OptionLayout& option : layout->options)
        for (const CardLayout& card : option.cards) expect(card, expect);
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

/// Each field is honoured or says why it has no effect.
TEST_P(ContactKeywords, EveryFieldMeansSomethingOrSaysSo)
{
    expect_no_silent_field(GetParam().name);
}

TEST(ContactControl, EveryFieldMeansSomethingOrSaysSo)
{
    expect_no_silent_field("CONTROL_CONTACT");
}

/// *CONTROL_CONTACT gives parts the values that *PART_CONTACT leaves out; a contact without friction of its
/// own stays without.
TEST(ContactControl, DefaultsOfParts)
{
    const ReadResult result = read_text("*CONTROL_CONTACT\n0.1\n\n0.3,0.2,4.0,50.0,0.7,0.8,2.0\n\n1\n0,1\n"
                                        "*PART_CONTACT\nc\n3,1,1\n0.5,0.4,0.0,0.0,0.9,0.6,3.0\n"
                                        "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n0\n1\n");
    ASSERT_TRUE(result.ok);
    const Model& model = result.model;
    for (Index part = 0; part < 2; ++part) {
        const PartContact& own = model.part_contacts.at(part);
        EXPECT_EQ(own, (PartContact{0.3, 0.2, 4.0, 50.0, 0.7, 0.8, 2.0})) << part;
    }
    EXPECT_EQ(model.part_contacts.at(2), (PartContact{0.5, 0.4, 4.0, 50.0, 0.9, 0.6, 3.0}));
    const Contact& contact = model.contacts.at(0);
    EXPECT_EQ(contact.static_friction, 0);
    EXPECT_TRUE(contact.drop_symmetry_faces);
    EXPECT_TRUE(contact.stiffness_of_nodes);
    EXPECT_FALSE(contact.friction_energy);
    for (const IgnoredField& one : result.report.ignored)
        EXPECT_EQ(one.keyword.find("CONT"), std::string::npos) << one.keyword << " " << one.field;
}

TEST(ContactControl, OptionalCards)
{
    const std::string head = "*CONTROL_CONTACT\n\n\n\n0,1\n*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n"
                             "0.2,0.1,0,10.0\n1,1,0,0,1,1,1,0.5\n";
    const std::string tail = "0,0,0,0,1,0,0.3,77.0\n1,0,0.01,0,2.0\n0\n0,0,0,0,1.5\n1,0,0,0,0,1\n";
    const ReadResult two = read_text(head + "2,0.1,0,1.025,2,5\n" + tail);
    ASSERT_TRUE(two.ok);
    const Contact& contact = two.model.contacts.at(0);
    EXPECT_EQ(contact.friction_stress, 5.0) << "VC VSF";
    EXPECT_EQ(contact.solid_thickness, 0.3);
    EXPECT_EQ(contact.solid_modulus, 0) << "of SOFT = 0 and 1";
    EXPECT_EQ(contact.baseline_decay, 0.01);
    EXPECT_EQ(contact.edge_stiffness_scale, 2.0);
    EXPECT_EQ(contact.friction_stiffness_scale, 1.5);
    EXPECT_TRUE(contact.stiffness_of_nodes && contact.larger_part_scale);
    EXPECT_TRUE(contact.drop_symmetry_faces && contact.friction_energy);
    ASSERT_EQ(two.report.ignored.size(), 1u);
    EXPECT_EQ(two.report.ignored[0].field, "SLDSTF");
    EXPECT_NE(two.report.ignored[0].reason.find("SOFT = 2"), std::string::npos);
    // What belongs to segments on segments is listed with its reason where nodes press.
    const ReadResult nodes = read_text(head + "0,0.1,0,1.025,2,5\n" + tail);
    ASSERT_TRUE(nodes.ok);
    EXPECT_EQ(nodes.model.contacts.at(0).solid_modulus, 77.0);
    std::vector<std::string> fields;
    for (const IgnoredField& one : nodes.report.ignored) {
        fields.push_back(one.field);
        EXPECT_EQ(one.reason.find("Plash does not use it"), std::string::npos) << one.field;
    }
    EXPECT_EQ(fields, (std::vector<std::string>{"DEPTH", "DPRFAC", "EDGEK", "FRICSF", "PSTIFF", "SSFTYP"}));
    // A curve of DPRFAC and a set of symmetry planes are errors with their field.
    const ReadResult wrong = read_text(head + "2\n0,0,0,0,-3\n1,0,-7.0\n");
    ASSERT_EQ(wrong.report.errors.size(), 2u);
    EXPECT_EQ(wrong.report.errors[0].field, "ISYM");
    EXPECT_EQ(wrong.report.errors[1].field, "DPRFAC");
}

/// The stiffness of *MAT_NULL is that of its contacts: 200 / (3 (1 - 0.6)). Without one it is listed, with
/// its reason.
TEST(ContactMaterials, StiffnessOfNullMaterialIsForContactsAlone)
{
    const std::string deck = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n*ELEMENT_SHELL\n1,3,1,2,3,4\n"
                             "*SECTION_SHELL\n3,2\n.1,.1,.1,.1\n*PART\n\n3,3,3\n"
                             "*MAT_NULL\n3,1.0,0,0,0,0,200.0,0.3\n";
    for (const bool contact : {true, false}) {
        ReadResult read = read_text(deck + (contact ? "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n0\n1\n" : ""));
        ASSERT_TRUE(read.ok);
        const Scene scene = make_scene(read.model);
        list_unread_fields(read.model, read.report);
        std::string fields;
        for (const IgnoredField& one : read.report.ignored) {
            fields += one.field + ' ';
            EXPECT_NE(one.reason.find("contacts"), std::string::npos) << one.reason;
        }
        EXPECT_EQ(fields, contact ? "" : "YM PR ");
        EXPECT_NEAR(bulk_modulus_of(read.model, read.model.parts[2]), 200 / 1.2, 1e-12 * 200);
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
        Keyword{"CONTACT_ERODING_NODES_TO_SURFACE", K::two_way, M::none, "0,1,1\n"},
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

/// NSEROD = 0: the eroding contact of nodes with a surface acts both ways where the nodes are those of a
/// surface; 1: nodes on segments alone.
TEST(ContactControl, ErodingNodesActBothWays)
{
    const std::string eroding = "*CONTACT_ERODING_NODES_TO_SURFACE\n1,2,3,3\n0\n0\n0,1,1\n";
    EXPECT_EQ(read_text(eroding).model.contacts.at(0).kind, Contact::Kind::two_way);
    const std::string control = "*CONTROL_CONTACT\n0.1\n\n\n\n0,1\n";
    const ReadResult one_way = read_text(control + eroding);
    EXPECT_EQ(one_way.model.contacts.at(0).kind, Contact::Kind::one_way);
    for (const IgnoredField& one : one_way.report.ignored) EXPECT_NE(one.field, "NSEROD");
    const std::string nodes =
        "*SET_NODE_LIST\n5\n1\n*CONTACT_ERODING_NODES_TO_SURFACE\n5,2,4,3\n0\n0\n0,1,1\n";
    EXPECT_EQ(read_text(nodes).model.contacts.at(0).kind, Contact::Kind::one_way);
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
