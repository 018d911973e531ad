#include "tests/support/joined_deck.h"

#include "tests/support/deck_text.h"

namespace plash::testing {

namespace {

constexpr const char* joined_controls = R"(*CONTROL_TERMINATION
0.6
*CONTROL_ENERGY
2,2,2
*DATABASE_BINARY_D3PLOT
0.05
*DATABASE_BINARY_D3DUMP
400
*DATABASE_BINARY_RUNRSF
40,2
*DATABASE_GLSTAT
0.005
*DATABASE_MATSUM
0.005
*DATABASE_NODOUT
0.01
*DATABASE_ELOUT
0.02
*DATABASE_RCFORC
0.01
*DATABASE_SLEOUT
0.02
*DATABASE_RBDOUT
0.01
*DATABASE_JNTFORC
0.01
*DATABASE_BNDOUT
0.01
*DATABASE_SPCFORC
0.01
*DATABASE_DEFORC
0.01,3
*DATABASE_DISBOUT
0.01,3
*DATABASE_NODFOR
0.01,3
*DATABASE_ABSTAT
0.01,3
*DEFINE_CURVE
5
0.0,0.01
10.0,0.02
*DEFINE_CURVE
1
0.0,1.0
10.0,1.0
*DEFINE_CURVE
2
0.0,0.0
0.1,2.0
0.3,2.0
0.4,0.0
*DEFINE_CURVE
3
-10.0,-1.0
10.0,1.0
)";

constexpr const char* joined_materials = R"(*MAT_PIECEWISE_LINEAR_PLASTICITY
1,7.8e-6,210.0,0.3,0.25,1.0
,
,
,
*MAT_ELASTIC
2,7.8e-6,70.0,0.3
*MAT_SPOTWELD
3,7.8e-6,210.0,0.3,0.4,1.0
,1.5
*MAT_SPRING_ELASTIC
4,0.05
*MAT_SPRING_ELASTOPLASTIC
5,0.5,0.05,0.1
*MAT_SPRING_MAXWELL
6,0.5,0.1,5.0
*MAT_DAMPER_VISCOUS
7,0.01
*MAT_RIGID
8,7.8e-6,210.0,0.3
,
,
*MAT_ELASTIC
9,1.0e-6,1.0e-3,0.0
*MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM
10,1.0,0.05,0.05,0.05,0.1,0.1,0.1
0.001,0.001,0.001
5,5,5
*MAT_CABLE_DISCRETE_BEAM
11,1.0e-6,0.05,0,0.01,0.2,0.1
*SECTION_SHELL
1,2,0.833,3
1.0,1.0,1.0,1.0
*SECTION_SOLID
2,1
*SECTION_BEAM
3,1,0.833,2,1
1.0,1.0,0.0,0.0
*SECTION_BEAM
4,9,0.833,2,1
2.0,2.0,0.0,0.0
*SECTION_BEAM
6,6,1.0,0,0,3
1.0e-4,1.0e-3
*SECTION_BEAM
7,6
,,,1.0
*SECTION_DISCRETE
5
,
)";

} // namespace

std::string joined_deck()
{
    DeckText deck;
    deck.text += "*TITLE\neverything that joins\n";
    deck.text += joined_controls;
    deck.text += joined_materials;
    // Four blocks on top of one another: tied, tied at a distance, glued.
    deck.part(1, 2, 1);
    deck.part(2, 2, 2);
    deck.part(3, 2, 2);
    deck.text += "*HOURGLASS\n1,7,0.1\n*PART\np4\n4,2,2,0,1\n"; // keeps the shape of the start in its history
    const int low = deck.block(1, {0, 0, 0}, {12, 12, 8}, 3, 3, 2);
    deck.block(2, {1, 1, 8}, {11, 11, 12}, 5, 5, 2);
    deck.block(3, {2, 2, 12.3}, {10, 10, 16}, 2, 2, 2);
    deck.block(4, {2.5, 2.5, 16}, {9, 9, 20}, 3, 3, 2);
    deck.text += "*CONTACT_TIED_SURFACE_TO_SURFACE_ID\n1,tied\n2,1,3,3\n,\n,\n"
                 "*CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET_ID\n2,held by springs\n3,2,3,3\n,\n0,0,-0.4,-0.4\n"
                 "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK_ID\n3,glued\n4,3,3,3\n0.1,0.1\n,\n"
                 "6,0.02,0.02,0.05\n"
                 "*INITIAL_VELOCITY_GENERATION\n4,2,0.0,2.0,1.0,6.0\n1,2,0.0,0.0,0.0,-5.0\n";
    // Two sheets, the upper one on welds that fail, with a beam that fails and one that is tightened.
    deck.part(5, 1, 1);
    deck.part(6, 1, 1);
    const int sheet = deck.sheet(5, {30, 0, 0}, {20, 0, 0}, {0, 20, 0}, 4, 4);
    const int cover = deck.sheet(6, {30, 0, 4}, {20, 0, 0}, {0, 20, 0}, 4, 4);
    const auto held = [&](int i) { return sheet + i; };
    const auto over = [&](int i) { return cover + i; };
    deck.text += fmt::format("*CONSTRAINED_SPOTWELD\n{},{},0.2,0.2\n*CONSTRAINED_SPOTWELD\n{},{},9.0,9.0\n",
                             held(0), over(0), held(4), over(4));
    deck.part(7, 4, 3);
    deck.part(8, 4, 3);
    deck.text += fmt::format("*ELEMENT_BEAM\n1,7,{},{}\n2,8,{},{}\n", held(20), over(20), held(12), over(12));
    deck.text += "*SET_BEAM\n1\n2\n*INITIAL_AXIAL_FORCE_BEAM\n1,2,1.0\n"
                 "*INITIAL_VELOCITY_GENERATION\n6,2,0.0,0.0,0.0,8.0\n";
    deck.text += fmt::format("*SET_NODE_LIST\n1\n{},{},{}\n*BOUNDARY_SPC_SET\n1,0,1,1,1,1,1,1\n", held(1),
                             held(10), held(22));
    deck.text += fmt::format("*CONSTRAINED_LINEAR_GLOBAL\n1\n{},3,1.0\n{},3,-2.0\n{},3,1.0\n"
                             "*SET_NODE_LIST\n2\n{},{},{}\n*CONSTRAINED_NODE_SET\n2,1\n",
                             over(14), over(13), over(18), over(5), over(10), over(15));
    deck.text += fmt::format("*NODE\n{},40.0,10.0,9.0\n*CONSTRAINED_INTERPOLATION\n1,{},123,0\n{},123,1.0\n"
                             "{},123,1.0\n{},123,1.0\n",
                             deck.nodes + 1, deck.nodes + 1, over(6), over(8), over(17));
    const int hung = ++deck.nodes;
    deck.text += fmt::format("*ELEMENT_MASS\n1,{},1.0e-4\n", hung);
    // Struts that cross and touch while they bend.
    deck.part(9, 3, 1);
    const int struts = deck.nodes + 1;
    deck.text += "*NODE\n";
    for (int i = 0; i < 5; ++i) deck.text += fmt::format("{},{},40.0,0.0\n", ++deck.nodes, 5.0 * i);
    for (int i = 0; i < 5; ++i) deck.text += fmt::format("{},{},{},1.5\n", ++deck.nodes, 7.5, 30.0 + 5.0 * i);
    const int aside = ++deck.nodes;
    deck.text += fmt::format("{},100.0,100.0,100.0\n*ELEMENT_BEAM\n", aside);
    for (int i = 0; i < 4; ++i) {
        deck.text += fmt::format("{},9,{},{},{}\n{},9,{},{},{}\n", 11 + i, struts + i, struts + i + 1, aside,
                                 21 + i, struts + 5 + i, struts + 6 + i, aside);
    }
    deck.text += fmt::format("*SET_NODE_LIST\n3\n{},{},{}\n*BOUNDARY_SPC_SET\n3,0,1,1,1,1,1,1\n"
                             "*INITIAL_VELOCITY\n4\n0.0,0.0,-20.0\n*SET_NODE_LIST\n4\n{},{},{}\n",
                             struts, struts + 4, aside, struts + 6, struts + 7, struts + 8);
    deck.text += "*CONTACT_AUTOMATIC_GENERAL_ID\n4,struts\n9,,3\n0.1,0.1\n,\n";
    // Springs between the lowest block, one another and the ground.
    for (int kind = 0; kind < 4; ++kind) {
        deck.part(10 + kind, 5, 4 + kind);
        deck.text +=
            fmt::format("*ELEMENT_DISCRETE\n{},{},{},{}\n", 1 + kind, 10 + kind, low + kind, struts + 4);
    }
    // A discrete beam that yields, a cable that is tightened, damping by stiffness.
    deck.part(23, 6, 10);
    deck.part(24, 7, 11);
    deck.text +=
        fmt::format("*ELEMENT_BEAM\n31,23,{},{}\n32,24,{},{}\n*DAMPING_PART_STIFFNESS\n3,0.1\n6,-1.0e-4\n"
                    "*DATABASE_NODAL_FORCE_GROUP\n1\n",
                    struts + 4, low + 5, struts + 4, low + 6);
    // Two rigid blocks on a hinge.
    deck.part(20, 2, 8);
    deck.part(21, 2, 8);
    const int left = deck.block(20, {60, 0, 0}, {64, 4, 4}, 1, 1, 1);
    const int right = deck.block(21, {64, 0, 0}, {68, 4, 4}, 1, 1, 1);
    deck.text +=
        fmt::format("*CONSTRAINED_JOINT_REVOLUTE\n{},{},{},{}\n", left + 1, right, left + 5, right + 4);
    deck.text += "*DEFINE_COORDINATE_SYSTEM\n1,0,0,0,1,0\n0,1,0\n"
                 "*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED\n1,20,21,1,1\n,,3,,,\n,,,,0.5,0.01\n,\n"
                 "*INITIAL_VELOCITY_GENERATION\n21,2,0.0,0.0,5.0,0.5\n";
    // A soft block that is flattened.
    deck.part(22, 2, 9);
    const int soft = deck.block(22, {80, 0, 0}, {82, 2, 2}, 1, 1, 1);
    deck.text += fmt::format("*SET_PART_LIST\n1,1.0,0.0,300.0\n22\n*CONTACT_INTERIOR\n1\n"
                             "*SET_NODE_LIST\n5\n{},{},{},{}\n*BOUNDARY_SPC_SET\n5,0,1,1,1\n"
                             "*SET_NODE_LIST\n6\n{},{},{},{}\n*DEFINE_CURVE\n4\n0.0,0.0\n0.4,-1.9\n0.6,-1.0\n"
                             "*BOUNDARY_PRESCRIBED_MOTION_SET\n6,3,2,4\n",
                             soft, soft + 1, soft + 2, soft + 3, soft + 4, soft + 5, soft + 6, soft + 7);
    // Gas inside of it that flows in and out.
    deck.text += "*SET_SEGMENT\n1\n";
    for (const auto& face : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                             std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
        deck.text +=
            fmt::format("{},{},{},{}\n", soft + face[0], soft + face[1], soft + face[2], soft + face[3]);
    deck.text += "*AIRBAG_WANG_NEFSKE_ID\n7,bag\n1,0\n0.7,1.0,300.0,0,5\n0.8,,0.05\n"
                 "1.0e-4,1.2e-6,,,,1.0e-5,0\n,\n";
    // A gram of TNT explodes beside it.
    deck.text += "*LOAD_BLAST_ENHANCED\n3,0.001,81.0,-200.0,1.0,0.0,6,2\n0,0,0,0,0,0,0\n"
                 "*LOAD_BLAST_SEGMENT_SET\n3,1\n";
    // A block that turns, and is rigid for a while.
    deck.part(25, 2, 2);
    deck.block(25, {100, 0, 0}, {104, 4, 4}, 2, 2, 2);
    deck.text += "*INITIAL_VELOCITY_GENERATION\n25,2,0.5,0.0,1.0,0.5\n102,2,2,0,0,1\n"
                 "*DEFORMABLE_TO_RIGID_AUTOMATIC\n1,0,0.2\n0,0,0,0,1\n25\n"
                 "*DEFORMABLE_TO_RIGID_AUTOMATIC\n2,0,0.4\n0,0,0,0,0,1\n25\n";
    deck.text += fmt::format("*DATABASE_HISTORY_NODE\n{},{},{}\n*DATABASE_HISTORY_BEAM\n1,2,13\n*END\n", low,
                             over(12), hung);
    return deck.text;
}

} // namespace plash::testing
