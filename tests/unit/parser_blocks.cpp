// Keyword lines, blocks, options and includes: rules 1 to 4, 14 and 21 to 31 of the format.

#include "parser/layout.h"
#include "parser/text_file.h"
#include "tests/unit/parser_support.h"

namespace plash {
namespace {

const std::string tetrahedron_nodes =
    "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,0.,1.,0.\n4,0.,0.,1.\n"
    "5,1.,0.,1.\n6,1.,1.,1.\n7,0.,1.,1.\n8,1.,1.,0.\n9,2.,2.,2.\n10,3.,3.,3.\n";
const std::string one_part = "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.,1.\n";

} // namespace

TEST(KeywordNames, AnySpellingFindsTheKeyword)
{
    const LayoutTable& table = layout_table();
    const auto name = [&](const char* written) { return table.resolve(written).name; };
    EXPECT_EQ(name("mat_elastic"), "MAT_ELASTIC");
    EXPECT_EQ(name("MAT_1"), "MAT_ELASTIC");
    EXPECT_EQ(name("MAT_001"), "MAT_ELASTIC");
    EXPECT_EQ(name("MAT_24"), "MAT_PIECEWISE_LINEAR_PLASTICITY");
    EXPECT_EQ(name("EOS_4"), "EOS_GRUNEISEN");
    EXPECT_EQ(name("MAT_MOONEY_RIVLIN_RUBBER"), "MAT_MOONEY-RIVLIN_RUBBER");
    EXPECT_EQ(name("SET_NODE"), "SET_NODE_LIST");
    EXPECT_EQ(name("ALE_MULTI_MATERIAL_GROUP"), "ALE_MULTI-MATERIAL_GROUP");
    EXPECT_EQ(table.resolve("MAT_NO_SUCH_LAW").layout, nullptr);
}

TEST(KeywordNames, OptionsComeInAnyOrder)
{
    const LayoutTable& table = layout_table();
    const KeywordName a = table.resolve("CONTACT_AUTOMATIC_SINGLE_SURFACE_ID_MPP");
    const KeywordName b = table.resolve("CONTACT_AUTOMATIC_SINGLE_SURFACE_MPP_ID");
    EXPECT_EQ(a.name, "CONTACT_AUTOMATIC_SINGLE_SURFACE");
    EXPECT_EQ(a.layout, b.layout);
    EXPECT_EQ(a.options, (std::vector<std::string>{"ID", "MPP"}));
    EXPECT_EQ(b.options, (std::vector<std::string>{"MPP", "ID"}));
    const KeywordName c = table.resolve("CONTACT_TIED_SHELL_EDGE_TO_SURFACE_ID_BEAM_OFFSET");
    EXPECT_EQ(c.name, "CONTACT_TIED_SHELL_EDGE_TO_SURFACE_BEAM_OFFSET");
    EXPECT_EQ(c.options, (std::vector<std::string>{"ID"}));
}

TEST(Blocks, KeywordsAreCaseInsensitiveAndEndIsTheEnd)
{
    const ReadResult result =
        read_text("*keyword\n*Control_Termination\n       2.0\n*END\n*CONTROL_TERMINATION\n       3.0\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.controls.time.end_time, 2);
}

TEST(Blocks, OneBlockHoldsSeveralDefinitionsWithTheirTitles)
{
    const ReadResult result = read_text("*SECTION_SHELL_TITLE\nfirst\n1,2\n1.0\nsecond\n2,2,,5\n2.0\n\n");
    EXPECT_EQ(errors_of(result), "");
    ASSERT_EQ(result.model.sections.size(), 2u);
    EXPECT_EQ(result.model.sections[0].title, "first");
    EXPECT_EQ(result.model.sections[1].title, "second");
    EXPECT_EQ(result.model.sections[1].integer("NIP"), 5);
    EXPECT_EQ(result.model.sections[1].real("T1"), 2);
}

TEST(Blocks, BlocksOfOneKeywordAddUpAndTheLastControlWins)
{
    const ReadResult result = read_text("*NODE\n1,0.,0.,0.\n*CONTROL_TERMINATION\n1.0\n*NODE\n2,0.,0.,1.\n"
                                        "*CONTROL_TERMINATION\n4.0\n");
    EXPECT_EQ(result.model.nodes.size(), 2u);
    EXPECT_EQ(result.model.controls.time.end_time, 4);
}

TEST(Blocks, OptionalCardsMayBeMissingOrThere)
{
    const ReadResult result =
        read_text("*DATABASE_EXTENT_BINARY\n1,2\n*DATABASE_EXTENT_BINARY\n1,2,4,11\n0,1,0,3\n8\n");
    EXPECT_EQ(errors_of(result), "");
    const auto& extent = result.model.controls.output.extent;
    EXPECT_EQ(extent.at("MAXINT"), 4);
    EXPECT_EQ(extent.at("IEVERP"), 1);
    EXPECT_EQ(extent.at("NEIPH"), 1);
    EXPECT_EQ(extent.at("NEIPS"), 2);
    EXPECT_TRUE(result.model.controls.output.strains());
    const auto& ignored = result.report.ignored; // nobody reads the other fields
    const auto is_ignored = [&](const char* field, const char* value) {
        return std::any_of(ignored.begin(), ignored.end(),
                           [&](const IgnoredField& f) { return f.field == field && f.value == value; });
    };
    EXPECT_TRUE(is_ignored("DCOMP", "3"));
    EXPECT_TRUE(is_ignored("NINTSLD", "8"));
}

TEST(Blocks, ConditionalCardsFollowEarlierFields)
{
    const ReadResult result = read_text("*SECTION_SHELL\n1,2,,3,,,1\n1.0\n10.,20.,30.\n2,2,,4\n1.0\n");
    EXPECT_EQ(errors_of(result), "");
    ASSERT_EQ(result.model.sections.size(), 2u);
    const Table* angles = result.model.sections[0].table("ANGLE");
    ASSERT_NE(angles, nullptr);
    EXPECT_EQ(angles->values, (std::vector<double>{10, 20, 30}));
    EXPECT_EQ(result.model.sections[1].integer("NIP"), 4);
}

TEST(Blocks, UnknownKeywordsAreSkippedAndReported)
{
    const ReadResult result = read_text("*FROBNICATE\n1,2,3\n*CONTROL_TERMINATION\n4.0\n");
    EXPECT_TRUE(result.ok);
    EXPECT_EQ(result.model.controls.time.end_time, 4);
    EXPECT_EQ(result.report.keywords.at("FROBNICATE").status, KeywordStatus::unknown);
    ASSERT_EQ(unsupported_keywords(result.report).size(), 1u);
    EXPECT_EQ(unsupported_keywords(result.report)[0].where.line, 1);
}

TEST(Elements, SolidsOnOneLineOrTwo)
{
    const ReadResult result =
        read_text(tetrahedron_nodes + one_part +
                  "*ELEMENT_SOLID\n"
                  "       1       1       1       2       8       3       4       5       6       7\n"
                  "       2       1\n"
                  "       1       2       8       3       4       5       6       7       0       0\n"
                  "       3       1       0       0       0       0       0       0       0       0\n"
                  "       1       2       3       4       4       4       4       4\n"
                  "4,1\n"
                  "1,2,3,4,5,6,7,8,9,10\n"
                  "5,1,1,2,3,4\n");
    EXPECT_EQ(errors_of(result), "");
    const SolidElements& solids = result.model.solids;
    ASSERT_EQ(solids.size(), 5u);
    EXPECT_EQ(solids.nodes[0], solids.nodes[1]);
    EXPECT_EQ(solids.nodes[2], (std::array<Index, 8>{0, 1, 2, 3, 3, 3, 3, 3}));
    EXPECT_EQ(solids.nodes[4], solids.nodes[2]); // missing corners repeat the last one
    EXPECT_EQ(solids.nodes[3], solids.nodes[2]); // the corners of a ten-node tetrahedron
    EXPECT_EQ(solids.ten_nodes, (std::vector<Index>{none, none, none, 0, none}));
    ASSERT_NE(ten_nodes(result.model, 3), nullptr);
    EXPECT_EQ(ten_nodes(result.model, 4), nullptr);
    ASSERT_EQ(result.model.tetrahedra.size(), 1u);
    EXPECT_EQ(result.model.tetrahedra.nodes[0][9], 9);
}

TEST(Elements, ShellsWithThicknessAndTriangles)
{
    const ReadResult result = read_text(tetrahedron_nodes + one_part +
                                        "*ELEMENT_SHELL\n"
                                        "       1       1       1       2       3       0\n"
                                        "*ELEMENT_SHELL_THICKNESS\n"
                                        "       2       1       1       2       8       3\n"
                                        "             1.0             1.1             1.2             1.3\n");
    EXPECT_EQ(errors_of(result), "");
    const ShellElements& shells = result.model.shells;
    ASSERT_EQ(shells.size(), 2u);
    EXPECT_EQ(shells.nodes[0], (std::array<Index, 4>{0, 1, 2, 2}));
    ASSERT_EQ(shells.thickness.size(), 2u);
    EXPECT_EQ(shells.thickness[0][0], 0); // as its section says
    EXPECT_EQ(shells.thickness[1], (std::array<double, 4>{1.0, 1.1, 1.2, 1.3}));
}

TEST(Includes, AreReadWhereTheyStandAndSearchedInPaths)
{
    const DeckFolder folder;
    folder.write("mesh/nodes.k", "*KEYWORD\n*NODE\n1,0.,0.,0.\n*END\nrubbish\n");
    folder.write("library/steel.k", "*MAT_ELASTIC\n3,1.,2.\n");
    folder.write("very long name of a file.k", "*NODE\n2,0.,0.,1.\n");
    const std::string deck =
        folder.write("deck.k", "*KEYWORD\n*INCLUDE\nmesh\\nodes.k\nvery long +\n name of a file.k\n"
                               "*INCLUDE_PATH_RELATIVE\nlibrary\n*INCLUDE\nsteel.k\n"
                               "*CONTROL_TERMINATION\n1.0\n*END\n");
    const ReadResult result = read_model(deck);
    EXPECT_EQ(errors_of(result),
              "deck.k:4: *INCLUDE, field FILENAME: there is no file 'very longname of a file.k' "
              "(looked beside the deck)\n");
    EXPECT_EQ(result.model.nodes.size(), 1u);
    EXPECT_EQ(result.model.materials.size(), 1u);
    EXPECT_EQ(result.model.controls.time.end_time, 1);
    EXPECT_EQ(result.model.files.size(), 3u);
}

TEST(Includes, NamesMayHoldParameters)
{
    const DeckFolder folder;
    folder.write("mesh_2.k", "*NODE\n1,0.,0.,0.\n");
    folder.write("mesh_4.k", "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n");
    folder.write("soft.k", "*MAT_ELASTIC\n3,1.,2.\n");
    folder.write("a&b.k", "*MAT_ELASTIC\n4,1.,2.\n"); // no parameter of that name: the file's own
    const std::string deck =
        folder.write("deck.k", "*KEYWORD\n*PARAMETER\nI MESH,2\nC   law,soft\n*INCLUDE\nmesh_&MESH.k\n"
                               "&law.k\na&b.k\n*INCLUDE_TRANSFORM\nmesh_&mesh.k\n10\n*END\n");
    const ReadResult coarse = read_model(deck);
    EXPECT_EQ(errors_of(coarse), "");
    EXPECT_EQ(coarse.model.nodes.size(), 2u);
    EXPECT_EQ(coarse.model.materials.size(), 2u);
    EXPECT_EQ(read_model(deck, {{{"MESH", "4"}}}).model.nodes.size(), 4u);
}

TEST(Includes, GuardAgainstThemselves)
{
    const DeckFolder folder;
    folder.write("a.k", "*INCLUDE\nb.k\n");
    folder.write("b.k", "*INCLUDE\na.k\n");
    const ReadResult result = read_model(folder.write("deck.k", "*KEYWORD\n*INCLUDE\na.k\n"));
    EXPECT_EQ(errors_of(result), "b.k:2: *INCLUDE, field FILENAME: 'a.k' includes itself\n");
}

TEST(Includes, HaveTheFormatOfTheMasterDeck)
{
    const DeckFolder folder;
    folder.write("mesh.k", "*KEYWORD LONG=S\n*NODE\n                   1                 1.5\n");
    folder.write("small.k", "*NODE\n       2             2.5\n");
    const ReadResult result =
        read_model(folder.write("deck.k", "*KEYWORD LONG=Y\n*INCLUDE\nmesh.k\n*INCLUDE -\nsmall.k\n"));
    EXPECT_EQ(errors_of(result), "");
    ASSERT_EQ(result.model.nodes.size(), 2u);
    EXPECT_EQ(result.model.nodes.position[0].x, 1.5);
    EXPECT_EQ(result.model.nodes.position[1].x, 2.5);
}

TEST(Duplicates, IdenticalNodesWarnDifferentOnesAreErrors)
{
    const ReadResult same = read_text("*NODE\n1,1.,2.,3.\n2,0.,0.,0.,7\n1,1.,2.,3.\n");
    EXPECT_TRUE(same.ok);
    EXPECT_EQ(same.report.warnings.size(), 1u);
    EXPECT_EQ(same.model.nodes.size(), 2u);
    EXPECT_EQ(same.model.fixed_nodes.at(0).nodes, (std::vector<Index>{1}));
    const ReadResult other = read_text("*NODE\n1,1.,2.,3.\n1,1.,2.,4.\n");
    EXPECT_FALSE(other.ok);
}

TEST(Lines, AreCountedAndFoundAnywhere)
{
    std::string text;
    for (int line = 0; line < 1000; ++line) text += std::string(line % 90, 'x') + "\n";
    text += "a*\n*KEY";
    EXPECT_EQ(count_lines(text), 1001);
    EXPECT_EQ(count_lines({}), 0);
    EXPECT_EQ(find_line(text, "*", text.data()) - text.data(), static_cast<std::ptrdiff_t>(text.size()) - 4);
    const std::string_view inside = "a*b\n c*\n*A";
    EXPECT_EQ(find_line(inside, "*", inside.data()) - inside.data(), 8);
    EXPECT_EQ(find_line(inside.substr(1, 6), "*", inside.data()),
              nullptr); // a part that starts inside a line
    const std::string_view lines = "1\n$\n2 \n\n$ x\n  \n";
    EXPECT_EQ(end_of_data(lines) - lines.data(), 6); // behind "2 "
    const std::string_view blank = "\n$\n";
    EXPECT_EQ(end_of_data(blank), blank.data());
}

TEST(Checks, TheVolumeOfAWarpedBrickIsTheMeanOfBothTriangulationsOfItsFaces)
{
    // A unit brick with one corner at height h has the volume (3 + h) / 4: each corner carries a quarter.
    const auto errors = [](const std::string& height) {
        return errors_of(read_text(
            "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,1.,1.,0.\n4,0.,1.,0.\n5,0.,0.,1.\n6,1.,0.,1.\n7,1.,1.," +
            height +
            "\n8,0.,1.,1.\n*PART\np\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.,1.\n"
            "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n"));
    };
    EXPECT_EQ(errors("-2.9"), "");
    EXPECT_NE(errors("-3.1"), "");
}

} // namespace plash
