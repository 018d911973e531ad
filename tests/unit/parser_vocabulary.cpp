// Families of keywords that must reach the Model as checked plain data, each with the smallest deck that
// shows it.

#include "tests/unit/parser_support.h"

#include <algorithm>

namespace plash {
namespace {

/// Four corners of a square and a second layer above, parts, section, materials and a coordinate system.
const std::string base =
    "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,1.,1.,0.\n4,0.,1.,0.\n5,0.,0.,1.\n6,1.,0.,1.\n7,1.,1.,1.\n"
    "8,0.,1.,1.\n*PART\nonly\n1,1,1\n*SECTION_SHELL\n1,2\n1.,1.,1.,1.\n*MAT_ELASTIC\n1,1.,1.\n"
    "*MAT_ELASTIC\n2,1.,1.\n*DEFINE_COORDINATE_SYSTEM\n5,0.,0.,0.,1.,0.,0.\n0.,1.,0.\n";

/// The first record of a keyword that has no place of its own in the Model.
const Record* other(const Model& model, std::string_view keyword)
{
    const auto found = std::find_if(model.others.begin(), model.others.end(),
                                    [&](const Record& record) { return record.keyword == keyword; });
    return found == model.others.end() ? nullptr : &*found;
}

} // namespace

TEST(Vocabulary, ShellsWithAnglesOffsetsAndSystems)
{
    const ReadResult result =
        read_text(base + "*ELEMENT_SHELL\n1,1,1,2,3,4\n"
                         "*ELEMENT_SHELL_BETA\n2,1,1,2,3,4\n.1,.2,.3,.4,30.\n"
                         "*ELEMENT_SHELL_OFFSET\n3,1,1,2,3,4\n-.5\n"
                         "*ELEMENT_SHELL_THICKNESS_OFFSET\n4,1,1,2,3,4\n.1,.1,.1,.1\n.25\n"
                         "*ELEMENT_SHELL_MCID\n5,1,1,2,3,4\n,,,,5\n"
                         "*ELEMENT_SHELL\n6,1,1,2,3,4\n");
    EXPECT_EQ(errors_of(result), "");
    const ShellElements& shells = result.model.shells;
    ASSERT_EQ(shells.size(), 6u);
    EXPECT_EQ(shells.thickness[0][0], 0);
    EXPECT_EQ(shells.thickness[1], (std::array<double, 4>{.1, .2, .3, .4}));
    EXPECT_EQ(shells.material_angle, (std::vector<double>{0, 30, 0, 0, 0, 0}));
    EXPECT_EQ(shells.offset, (std::vector<double>{0, 0, -.5, .25, 0, 0}));
    EXPECT_EQ(shells.material_system, (std::vector<Index>{none, none, none, none, 0, none}));
}

TEST(Vocabulary, ShellsAndThickShellsWithLayersOfTheirOwn)
{
    const ReadResult result = read_text(
        base + "*ELEMENT_SHELL_COMPOSITE\n1,1,1,2,3,4\n1,.1,45.,,2,.2,-45.\n1,.3,0.\n2,1,1,2,3,4\n2,.5,90.\n"
               "*ELEMENT_SHELL\n3,1,1,2,3,4\n"
               "*ELEMENT_TSHELL_COMPOSITE\n11,1,1,2,3,4,5,6,7,8\n2,.7,10.\n"
               "*ELEMENT_TSHELL_BETA\n12,1,1,2,3,4,5,6,7,8\n,,,,20.\n"
               "*ELEMENT_SHELL_COMPOSITE_LONG\n4,1,1,2,3,4\n2,.6,1.,,7\n");
    EXPECT_EQ(errors_of(result), "");
    const ShellElements& shells = result.model.shells;
    ASSERT_EQ(shells.layers.size(), 4u);
    ASSERT_EQ(shells.layers[0].size(), 3u);
    EXPECT_EQ(shells.layers[0][1].material, 1);
    EXPECT_EQ(shells.layers[0][1].thickness, .2);
    EXPECT_EQ(shells.layers[0][1].angle, -45);
    EXPECT_EQ(shells.layers[0][2].thickness, .3);
    ASSERT_EQ(shells.layers[1].size(), 1u);
    EXPECT_EQ(shells.layers[1][0].angle, 90);
    EXPECT_TRUE(shells.layers[2].empty());
    EXPECT_EQ(shells.layers[3].at(0).thickness, .6);
    const ThickShellElements& thick = result.model.thick_shells;
    ASSERT_EQ(thick.size(), 2u);
    EXPECT_EQ(thick.layers[0].at(0).thickness, .7);
    EXPECT_EQ(thick.material_angle, (std::vector<double>{0, 20}));
    EXPECT_EQ(result.report.elements.tshell, 2);
}

TEST(Vocabulary, LayersOfMissingMaterialsAreErrors)
{
    const ReadResult result = read_text(base + "*ELEMENT_SHELL_COMPOSITE\n1,1,1,2,3,4\n9,.1,45.\n");
    EXPECT_EQ(errors_of(result), "deck.k:25: *ELEMENT_SHELL_COMPOSITE, field MID1: there is no material 9\n");
}

TEST(Vocabulary, ElementsWithoutVolumeLengthOrSystemAreErrors)
{
    EXPECT_EQ(errors_of(read_text(base + "*ELEMENT_BEAM\n1,1,2,2,3\n")),
              "deck.k:11: *ELEMENT_BEAM: beam 1 (part 1 'only' first): both ends are one node\n");
    EXPECT_EQ(errors_of(read_text(base + "*ELEMENT_TSHELL\n1,1,1,2,3,4,1,2,3,4\n")),
              "deck.k:11: *ELEMENT_TSHELL: thick shell 1 (part 1 'only' first): no volume: corners coincide "
              "or lie in "
              "one plane\n");
    EXPECT_EQ(errors_of(read_text(base + "*ELEMENT_SHELL_MCID\n1,1,1,2,3,4\n,,,,7\n")),
              "deck.k:25: *ELEMENT_SHELL_MCID, field MCID: element 1 has coordinate system 7, which is not "
              "defined\n");
}

TEST(Vocabulary, BeamsKeepWhatTheyHaveBesidesTheirNodes)
{
    const ReadResult result = read_text(base + "*SECTION_BEAM\n2,1\n1.\n*PART\nbeams\n2,2,1\n"
                                               "*ELEMENT_BEAM\n1,2,1,2,3\n2,2,2,3,4,1,2,3,0,1\n"
                                               "*ELEMENT_BEAM_ORIENTATION\n3,2,1,2\n0.,0.,1.\n"
                                               "*ELEMENT_BEAM_THICKNESS\n4,2,1,2,3\n.1,.2,.3,.4\n");
    EXPECT_EQ(errors_of(result), "");
    const Model& model = result.model;
    ASSERT_EQ(model.beams.size(), 4u);
    ASSERT_EQ(model.beams.options.size(), 4u);
    EXPECT_EQ(model.beams.options[0], none);
    EXPECT_EQ(model.others.at(model.beams.options[1]).peek("RR1")->value, 2);
    EXPECT_EQ(model.beams.orientation.at(2).z, 1);
    EXPECT_EQ(model.others.at(model.beams.options[3]).keyword, "ELEMENT_BEAM_THICKNESS");
}

TEST(Vocabulary, SetsOfBeamsKnowTheirBeams)
{
    const ReadResult result = read_text(
        base + "*SECTION_BEAM\n2,1\n1.\n*PART\nbeams\n2,2,1\n*ELEMENT_BEAM\n1000,2,1,2,3\n2000,2,2,3,4\n"
               "*SET_BEAM\n1\n2000\n*SET_BEAM_GENERAL\n2\nPART,2\n*SET_BEAM_GENERATE\n3\n1,1500\n"
               "*SET_BEAM_ADD\n4\n1,3\n*SET_NODE_GENERAL\n5\nSET_BEAM,1\n");
    EXPECT_EQ(errors_of(result), "");
    const Model& model = result.model;
    EXPECT_EQ(model.beam_sets.at(0).elements, (std::vector<Index>{1}));
    EXPECT_EQ(model.beam_sets.at(1).elements, (std::vector<Index>{0, 1}));
    EXPECT_EQ(model.beam_sets.at(2).elements, (std::vector<Index>{0}));
    EXPECT_EQ(model.beam_sets.at(3).elements, (std::vector<Index>{0, 1}));
    EXPECT_EQ(ids(model, model.node_sets.at(0).nodes), (std::vector<Id>{2, 3, 4}));
}

TEST(Vocabulary, SetsOfSetsOfOtherTypesAndCommonSegments)
{
    const ReadResult result = read_text(
        base +
        "*ELEMENT_SHELL\n1,1,1,2,3,4\n2,1,5,6,7,8\n*SET_SHELL_LIST\n1\n2\n*SET_NODE_LIST\n1\n1\n"
        "*SET_NODE_ADD_ADVANCED\n9\n1,1,1,2\n"
        "*SET_SHELL_GENERAL\n3\nSET,1\n"
        "*SET_SEGMENT\n1\n1,2,3,4\n5,6,7,8\n*SET_SEGMENT\n2\n7,6,5,8\n*SET_SEGMENT_INTERSECT\n3\n1,2\n");
    EXPECT_EQ(errors_of(result), "");
    const Model& model = result.model;
    EXPECT_EQ(ids(model, model.node_sets.at(1).nodes), (std::vector<Id>{1, 5, 6, 7, 8}));
    EXPECT_EQ(model.shell_sets.at(1).elements, (std::vector<Index>{1}));
    ASSERT_EQ(model.segment_sets.at(2).segments.size(), 1u);
    EXPECT_EQ(model.segment_sets[2].segments[0], (std::array<Index, 4>{4, 5, 6, 7}));
}

TEST(Vocabulary, ParticlesByMassAndByVolume)
{
    const ReadResult result = read_text(base + "*ELEMENT_SPH\n1,1,2.5\n*ELEMENT_SPH_VOLUME\n2,1,.5,4\n");
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.particles.mass, (std::vector<double>{2.5, -.5, -.5, -.5}));
    EXPECT_EQ(result.report.elements.sph, 4);
}

TEST(Vocabulary, PartsWithInertiaContactAndLayers)
{
    const ReadResult result =
        read_text(base + "*PART_INERTIA\nheavy\n2,1,1\n1.,2.,3.,40.\n4.,0.,0.,5.,0.,6.\n7.,8.,9.\n"
                         "*PART_CONTACT\nrough\n3,1,1\n.3,.2\n"
                         "*PART_COMPOSITE\nlaminate\n4,2\n1,.1,0.,,2,.2,90.\n");
    EXPECT_EQ(errors_of(result), "");
    const Model& model = result.model;
    EXPECT_EQ(model.part_inertias.at(1).mass, 40);
    EXPECT_EQ(model.part_inertias.at(1).yy, 5);
    EXPECT_EQ(model.part_inertias.at(1).velocity.z, 9);
    EXPECT_EQ(model.part_contacts.at(2).dynamic_friction, .2);
    ASSERT_EQ(model.parts.at(3).layers.size(), 2u);
    EXPECT_EQ(model.parts[3].layers[1].material, 1);
    EXPECT_EQ(model.parts[3].layers[1].angle, 90);
}

TEST(Vocabulary, OthersAreRecordsWithTheirNames)
{
    const ReadResult result =
        read_text(base + "*ELEMENT_INERTIA\n1,2\n1.,0.,0.,2.,0.,3.\n*ELEMENT_SEATBELT\n1,1,1,2,0,.5\n"
                         "*DEFINE_FRICTION\n8,.1,.2\n*DEFINE_FUNCTION\n3,f\n2*time\n");
    EXPECT_EQ(errors_of(result), "");
    for (const char* keyword : {"ELEMENT_INERTIA", "ELEMENT_SEATBELT", "DEFINE_FRICTION", "DEFINE_FUNCTION"})
        EXPECT_NE(other(result.model, keyword), nullptr) << keyword;
    if (const Record* friction = other(result.model, "DEFINE_FRICTION")) {
        EXPECT_EQ(friction->id, 8);
        EXPECT_EQ(friction->peek("FD_D")->value, .2);
    }
}

TEST(Vocabulary, WhatNothingUsesIsCounted)
{
    const ReadResult result =
        read_text(base + "*ELEMENT_SHELL\n1,1,1,2,3,4\n*DEFINE_CURVE\n11\n0.,0.\n1.,1.\n"
                         "*DEFINE_CURVE\n12\n0.,0.\n1.,1.\n*SET_NODE_LIST\n7\n1\n"
                         "*SET_NODE_LIST\n8\n2\n*BOUNDARY_SPC_SET\n8,,1\n"
                         "*LOAD_NODE_SET\n8,3,12\n");
    EXPECT_EQ(errors_of(result), "");
    std::string text;
    for (const Unused& unused : result.report.unused)
        text +=
            std::to_string(unused.count) + " " + unused.what + " from " + std::to_string(unused.first) + "\n";
    EXPECT_EQ(text, "4 nodes without elements from 5\n1 materials from 2\n1 curves from 11\n"
                    "1 coordinate systems from 5\n1 node sets from 7\n");
}

TEST(Vocabulary, EveryKeywordLineIsCounted)
{
    const DeckFolder folder;
    folder.write("mesh.k", "*KEYWORD\n*NODE\n1,0.,0.,0.\n*END\n");
    const ReadResult result = read_model(folder.write(
        "deck.k", "*KEYWORD\n*TITLE\nt\n*PARAMETER\nRa,1.\n*INCLUDE\nmesh.k\n*NODE\n2,0.,0.,0.\n*END\n"));
    long blocks = 0;
    for (const auto& [name, use] : result.report.keywords) blocks += use.blocks;
    EXPECT_EQ(blocks, 9); // as many as there are lines that start with a star
    EXPECT_EQ(result.report.keywords.at("NODE").blocks, 2);
    EXPECT_EQ(result.report.keywords.at("INCLUDE").status, KeywordStatus::run);
}

} // namespace plash
