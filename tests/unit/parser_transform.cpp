// *INCLUDE_TRANSFORM and *DEFINE_TRANSFORMATION: rule 31 of the format.

#include "parser/transformation.h"
#include "tests/unit/parser_support.h"

#include <cmath>

namespace plash {
namespace {

// Products of a few rotations: round-off of some 1e-16 on lengths of order one.
constexpr double tight = 1e-14;

void expect_near(const Vec3& found, const Vec3& wanted)
{
    EXPECT_NEAR(found.x, wanted.x, tight);
    EXPECT_NEAR(found.y, wanted.y, tight);
    EXPECT_NEAR(found.z, wanted.z, tight);
}

/// Position of the one node at (1, 0, 0) of an include that is moved by the lines of a transformation.
Vec3 moved_node(const std::string& lines)
{
    const DeckFolder folder;
    folder.write("mesh.k", "*NODE\n1,1.,0.,0.\n");
    const ReadResult result =
        read_model(folder.write("deck.k", "*INCLUDE_TRANSFORM\nmesh.k\n0\n0\n1.,1.,1.\n7\n"
                                          "*DEFINE_TRANSFORMATION\n7\n" +
                                              lines));
    EXPECT_EQ(errors_of(result), "");
    return result.model.nodes.position.at(0);
}

} // namespace

TEST(Transformation, EveryOptionMovesAsItSays)
{
    expect_near(moved_node("TRANSL,1.,2.,3.\n"), {2, 2, 3});
    expect_near(moved_node("SCALE,2.,1.,1.\n"), {2, 0, 0});
    expect_near(moved_node("ROTATE,0.,0.,1.,0.,0.,0.,90.\n"), {0, 1, 0});
    expect_near(moved_node("ROTATE,0.,0.,1.,0.,1.,0.,90.\n"), {1, 2, 0}); // about an axis through (0, 1, 0)
    expect_near(moved_node("POINT,1,0.,0.,0.\nPOINT,2,0.,0.,5.\nROTATE,1,2,90.\n"), {0, 1, 0});
    expect_near(moved_node("MIRROR,3.,0.,0.,4.,0.,0.\n"), {5, 0, 0});
    expect_near(moved_node("POINT,1,0.,0.,0.\nPOINT,2,1.,0.,0.\nPOINT,3,0.,1.,0.\n"
                           "POINT,4,5.,0.,0.\nPOINT,5,5.,0.,9.\nPOINT,6,5.,1.,0.\nPOS6P,1,2,3,4,5,6\n"),
                {5, 0, 1});
}

TEST(Transformation, LinesActInTheirOrder)
{
    expect_near(moved_node("TRANSL,1.,0.,0.\nROTATE,0.,0.,1.,0.,0.,0.,90.\n"), {0, 2, 0});
    expect_near(moved_node("ROTATE,0.,0.,1.,0.,0.,0.,90.\nTRANSL,1.,0.,0.\n"), {1, 1, 0});
}

TEST(Transformation, OfAnIncludeInsideAnIncludeActsFirst)
{
    const DeckFolder folder;
    folder.write("inner.k", "*NODE\n1,1.,0.,0.\n");
    folder.write("outer.k", "*INCLUDE_TRANSFORM\ninner.k\n100\n0\n0.\n1\n*NODE\n2,1.,0.,0.\n");
    const ReadResult result = read_model(
        folder.write("deck.k", "*DEFINE_TRANSFORMATION\n1\nTRANSL,1.,0.,0.\n*DEFINE_"
                               "TRANSFORMATION\n2\nROTATE,0.,0.,1.,0.,0.,0.,90.\n"
                               "*INCLUDE_TRANSFORM\nouter.k\n1000\n0\n0.\n2\n*NODE\n3,1.,0.,0.\n"));
    EXPECT_EQ(errors_of(result), "");
    const Nodes& nodes = result.model.nodes;
    EXPECT_EQ(nodes.id, (std::vector<Id>{1101, 1002, 3}));
    expect_near(nodes.position[0], {0, 2, 0});
    expect_near(nodes.position[1], {0, 1, 0});
    expect_near(nodes.position[2], {1, 0, 0});
}

TEST(Transformation, OffsetsReachEveryKindOfNumber)
{
    const DeckFolder folder;
    folder.write("block.k", "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,1.,1.,0.\n4,0.,1.,0.\n"
                            "*PART\nsheet\n1,1,1,0,1\n*SECTION_SHELL\n1,2\n1.\n*HOURGLASS\n1,4\n"
                            "*MAT_PIECEWISE_LINEAR_PLASTICITY\n1,1.,1.,.3\n0.,0.,1\n"
                            "*DEFINE_CURVE\n1\n0.,1.\n1.,2.\n*ELEMENT_SHELL\n1,1,1,2,3,4\n"
                            "*SET_NODE_LIST\n1\n1,2\n*SET_NODE_GENERAL\n2\nPART,1\n*BOUNDARY_SPC_SET\n1,0,1\n"
                            "*INITIAL_VELOCITY_GENERATION\n1,2,0.,1.\n\n*DATABASE_HISTORY_SHELL\n1\n"
                            "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n1,0,3\n\n\n");
    // Node, element, part, material, set, curve, define, other.
    const ReadResult result = read_model(folder.write(
        "deck.k", "*INCLUDE\nblock.k\n*INCLUDE_TRANSFORM\nblock.k\n10,20,30,40,50,60,70\n80\n\n0\n"));
    EXPECT_EQ(errors_of(result), "");
    const Model& model = result.model;
    EXPECT_EQ(model.nodes.id, (std::vector<Id>{1, 2, 3, 4, 11, 12, 13, 14}));
    EXPECT_EQ(model.shells.id, (std::vector<Id>{1, 21}));
    EXPECT_EQ(model.shells.nodes[1], (std::array<Index, 4>{4, 5, 6, 7}));
    EXPECT_EQ(model.parts.at(1).id, 31);
    EXPECT_EQ(model.parts[1].material, 1);
    EXPECT_EQ(model.parts[1].section, 1);
    EXPECT_EQ(model.parts[1].hourglass, 1);
    EXPECT_EQ(model.materials[1].id, 41);
    EXPECT_EQ(model.materials[1].integer("LCSS"), 61);
    EXPECT_EQ(model.sections[1].id, 81);
    EXPECT_EQ(model.curves[1].id, 61);
    EXPECT_EQ(model.node_sets.at(2).id, 51);
    EXPECT_EQ(model.node_sets[2].nodes, (std::vector<Index>{4, 5}));
    EXPECT_EQ(model.node_sets.at(3).nodes, (std::vector<Index>{4, 5, 6, 7}));
    EXPECT_EQ(model.fixed_nodes.at(1).nodes, (std::vector<Index>{4, 5}));
    EXPECT_EQ(model.initial_velocities.at(1).nodes, (std::vector<Index>{4, 5, 6, 7}));
    EXPECT_EQ(model.controls.output.history_shells, (std::vector<Index>{0, 1}));
    EXPECT_EQ(model.contacts.at(1).slave.parts, (std::vector<Index>{1}));
}

TEST(Transformation, AutoOffsetAvoidsTheNumbersReadBefore)
{
    const DeckFolder folder;
    folder.write("block.k", "*NODE\n1,0.,0.,0.\n5,1.,0.,0.\n");
    const ReadResult result = read_model(folder.write(
        "deck.k",
        "*INCLUDE\nblock.k\n*INCLUDE_AUTO_OFFSET\nblock.k\n*INCLUDE_AUTO_OFFSET_USER\nblock.k\n100,200\n"));
    EXPECT_EQ(errors_of(result), "");
    EXPECT_EQ(result.model.nodes.id, (std::vector<Id>{1, 5, 6, 10, 101, 105}));
}

TEST(Transformation, BoxesMoveUnlessTheyWouldLieAskew)
{
    const auto read = [](const std::string& lines) {
        const DeckFolder folder;
        folder.write("box.k", "*DEFINE_BOX\n1,0.,1.,0.,2.,0.,3.\n");
        return read_model(folder.write("deck.k", "*INCLUDE_TRANSFORM\nbox.k\n0\n0\n1.,1.,1.\n7\n"
                                                 "*DEFINE_TRANSFORMATION\n7\n" +
                                                     lines));
    };
    const ReadResult moved = read("ROTATE,0.,0.,1.,0.,0.,0.,90.\nTRANSL,10.,0.,0.\n");
    EXPECT_EQ(errors_of(moved), "");
    expect_near(moved.model.boxes.at(0).box.low, {8, 0, 0});
    expect_near(moved.model.boxes.at(0).box.high, {10, 1, 3});
    EXPECT_EQ(
        errors_of(read("ROTATE,0.,0.,1.,0.,0.,0.,45.\n")),
        "box.k:2: *DEFINE_BOX, field BOXID: the include is turned, and a box has its sides along the axes\n");
}

TEST(Transformation, UnitsOfAnIncludeBecomeThoseOfTheDeck)
{
    // kg, m, s in the include; t, mm, s in the deck: masses by 1e-3, lengths by 1e3.
    const DeckFolder folder;
    folder.write("part.k", "*NODE\n1,1.,2.,3.\n2,1.,0.,0.\n3,1.,1.,0.\n*PART\np\n1,1,1\n"
                           "*SECTION_SHELL\n1,2,.8333\n.002,.002,.002,.002\n"
                           "*MAT_PIECEWISE_LINEAR_PLASTICITY\n1,7800.,2.1e11,.3,3e8,0.,.25\n40.,5.,7\n"
                           "*ELEMENT_SHELL_THICKNESS\n1,1,1,2,3,3\n.001,.001,.001,.001\n"
                           "*DEFINE_CURVE\n7\n0.,3e8\n1.,4e8\n*DEFINE_CURVE\n8\n0.,0.\n.5,10.\n"
                           "*ELEMENT_SPH\n1,1,5.\n2,1,-2.\n*INITIAL_VELOCITY_NODE\n1,3.\n"
                           "*ELEMENT_MASS\n1,1,4.\n");
    const ReadResult result = read_model(
        folder.write("deck.k", "*INCLUDE_TRANSFORM\npart.k\n0\n0\n.001,1.,1000.\n*LOAD_NODE_POINT\n1,1,8,1.\n"
                               "*LOAD_NODE_POINT\n1,2,8,1.\n"));
    EXPECT_EQ(errors_of(result), "");
    const Model& model = result.model;
    expect_near(model.nodes.position[0], {1000, 2000, 3000});
    EXPECT_DOUBLE_EQ(model.sections[0].real("T1"), 2);
    EXPECT_DOUBLE_EQ(model.sections[0].real("SHRF"), .8333);
    EXPECT_DOUBLE_EQ(model.shells.thickness[0][0], 1);
    const Record& steel = model.materials[0];
    EXPECT_DOUBLE_EQ(steel.real("RO"), 7.8e-9);
    EXPECT_DOUBLE_EQ(steel.real("E"), 2.1e5);
    EXPECT_DOUBLE_EQ(steel.real("SIGY"), 300);
    EXPECT_DOUBLE_EQ(steel.real("PR"), .3);
    EXPECT_DOUBLE_EQ(steel.real("C"), 40);
    EXPECT_EQ(model.curves[0].curve.abscissa, (std::vector<double>{0, 1}));
    EXPECT_DOUBLE_EQ(model.curves[0].curve.ordinate[1], 400);
    // 10 N are 10 t mm / s^2.
    EXPECT_DOUBLE_EQ(model.curves[1].curve.ordinate[1], 10);
    EXPECT_DOUBLE_EQ(model.curves[1].curve.abscissa[1], .5);
    EXPECT_DOUBLE_EQ(model.particles.mass[0], .005);
    EXPECT_DOUBLE_EQ(model.particles.mass[1], -2e9);
    EXPECT_DOUBLE_EQ(model.initial_velocities.at(0).translation.x, 3000);
    EXPECT_DOUBLE_EQ(model.masses.mass.at(0), .004);
}

TEST(Transformation, UnitsThatPlashCannotConvertAreErrors)
{
    const DeckFolder folder;
    folder.write("part.k", "*MAT_WOOD\n1,600.\n1.\n*DEFINE_CURVE\n7\n0.,1.\n1.,4.\n");
    const ReadResult result = read_model(
        folder.write("deck.k", "*INCLUDE_TRANSFORM\npart.k\n0\n0\n1.,.001,1.\n*LOAD_NODE_POINT\n1,1,7,1.\n"
                               "*LOAD_SEGMENT\n7,1.,0.,1,1,1,1\n*NODE\n1,0.,0.,0.\n"));
    EXPECT_FALSE(result.ok);
    const std::string errors = errors_of(result);
    EXPECT_NE(
        errors.find("part.k:5: *DEFINE_CURVE: 7 is used by *LOAD_NODE_POINT LCID and *LOAD_SEGMENT LCID in "
                    "different units: *INCLUDE_TRANSFORM cannot convert it"),
        std::string::npos)
        << errors;
    EXPECT_NE(errors.find("Plash does not know the unit of this field"), std::string::npos) << errors;
}

TEST(Transformation, RotationsKeepLengthsAndMirrorsAreTheirOwnInverse)
{
    const Vec3 point{1, -2, 3};
    const Affine turn = rotation({1, 2, 2}, {4, 5, 6}, 0.7);
    EXPECT_NEAR(norm(turn.direction(point)), norm(point), tight);
    expect_near(turn.point({4, 5, 6}), {4, 5, 6});
    const Affine reflection = mirror({1, 1, 1}, {1, 2, 3});
    expect_near(then(reflection, reflection).point(point), point);
}

/// Nodes of a set, moved after all nodes are known; the others stay.
TEST(Transformation, MovesTheNodesOfASet)
{
    const ReadResult result =
        read_text("*NODE_TRANSFORM\n3,1\n*DEFINE_TRANSFORMATION\n3\nTRANSL,1.,2.,3.\nSCALE,2.,2.,2.\n"
                  "*SET_NODE_LIST\n1\n2\n*NODE\n1,1.,0.,0.\n2,1.,0.,0.\n");
    EXPECT_EQ(errors_of(result), "");
    const auto& position = result.model.nodes.position;
    EXPECT_EQ(position[0].x, 1);
    EXPECT_EQ(position[1].x, 4); // shifted, then scaled
    EXPECT_EQ(position[1].y, 4);
    EXPECT_EQ(position[1].z, 6);
    EXPECT_EQ(errors_of(read_text("*NODE\n1,0.,0.,0.\n*SET_NODE_LIST\n1\n1\n*NODE_TRANSFORM\n9,1\n")),
              "deck.k:7: *NODE_TRANSFORM, field TRSID: there is no transformation 9\n");
}

} // namespace plash
