// What definitions become in the Model: curves, sets, conditions, controls.

#include "parser/layout.h"
#include "tests/unit/parser_support.h"

#include <fmt/format.h>

namespace plash {
namespace {

/// Two bricks of two parts, one behind the other along x, nodes 1 to 12.
const std::string two_bricks =
    "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,1.,1.,0.\n4,0.,1.,0.\n5,0.,0.,1.\n6,1.,0.,1.\n7,1.,1.,1.\n8,0.,1.,1.\n"
    "9,2.,0.,0.\n10,2.,1.,0.\n11,2.,0.,1.\n12,2.,1.,1.\n"
    "*PART\nleft\n1,1,1\nright\n2,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.,1.\n"
    "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n2,2,2,9,10,3,6,11,12,7\n";

} // namespace

TEST(Curves, ScalesAndOffsetsAreApplied)
{
    const ReadResult result = read_text("*DEFINE_CURVE\n1,0,2.,3.,10.,100.\n0.,1.\n1.,2.\n");
    EXPECT_EQ(errors_of(result), "");
    // Abscissa SFA (A + OFFA), ordinate SFO (O + OFFO).
    EXPECT_EQ(result.model.curves[0].curve.abscissa, (std::vector<double>{20, 22}));
    EXPECT_EQ(result.model.curves[0].curve.ordinate, (std::vector<double>{303, 306}));
}

TEST(Curves, TablesTakeNumberedCurvesOrThoseBehindThem)
{
    const ReadResult numbered = read_text("*DEFINE_TABLE_2D\n9\n0.,2\n1.,1\n"
                                          "*DEFINE_CURVE\n1\n0.,1.\n1.,2.\n*DEFINE_CURVE\n2\n0.,3.\n1.,4.\n");
    EXPECT_EQ(errors_of(numbered), "");
    EXPECT_EQ(numbered.model.tables[0].curves, (std::vector<Index>{1, 0}));
    const ReadResult ordered = read_text("*DEFINE_CURVE\n7\n0.,1.\n1.,2.\n*DEFINE_TABLE\n9\n0.\n1.\n"
                                         "*DEFINE_CURVE\n1\n0.,1.\n1.,2.\n*DEFINE_CURVE\n2\n0.,3.\n1.,4.\n");
    EXPECT_EQ(errors_of(ordered), "");
    EXPECT_EQ(ordered.model.tables[0].curves, (std::vector<Index>{1, 2}));
}

TEST(Sets, OfEveryForm)
{
    const ReadResult result =
        read_text(two_bricks + "*SET_NODE_LIST\n1\n1,2,0,0,3\n"
                               "*SET_NODE_LIST_GENERATE\n2\n4,6,11,100\n"
                               "*SET_NODE_ADD\n3\n1,2\n"
                               "*SET_NODE_GENERAL\n4\nPART,2\nDNODE,9,10\n"
                               "*SET_NODE_INTERSECT\n5\n3,4\n"
                               "*SET_NODE_LIST_GENERATE_INCREMENT\n6\n1,12,5\n"
                               "*SET_NODE_GENERAL\n7\nBOX,1\n*DEFINE_BOX\n1,1.5,9.,-1.,.5,-1.,9.\n"
                               "*SET_NODE_COLUMN\n8\n5\n7\n"
                               "*SET_NODE_LIST_COLLECT\n9\n1,2\n*SET_NODE_LIST_COLLECT\n9\n3\n");
    EXPECT_EQ(errors_of(result), "");
    const Model& model = result.model;
    const auto set = [&](std::size_t index) { return ids(model, model.node_sets.at(index).nodes); };
    EXPECT_EQ(set(0), (std::vector<Id>{1, 2, 3}));
    EXPECT_EQ(set(1), (std::vector<Id>{4, 5, 6, 11, 12}));
    EXPECT_EQ(set(2), (std::vector<Id>{1, 2, 3, 4, 5, 6, 11, 12}));
    EXPECT_EQ(set(3), (std::vector<Id>{2, 3, 6, 7, 11, 12}));
    EXPECT_EQ(set(4), (std::vector<Id>{2, 3, 6, 11, 12}));
    EXPECT_EQ(set(5), (std::vector<Id>{1, 6, 11}));
    EXPECT_EQ(set(6), (std::vector<Id>{9, 11}));
    EXPECT_EQ(set(7), (std::vector<Id>{5, 7}));
    ASSERT_EQ(model.node_sets.size(), 9u);
    EXPECT_EQ(set(8), (std::vector<Id>{1, 2, 3}));
}

TEST(Sets, OfElementsAndParts)
{
    const ReadResult result =
        read_text(two_bricks + "*SET_SOLID\n1\n2\n*SET_SOLID_GENERATE\n2\n1,9\n"
                               "*SET_SOLID_GENERAL\n3\nPART,1\n*SET_PART_LIST_GENERATE\n4\n1,2\n"
                               "*SET_PART_GENERAL\n5\nALL\nDPART,1\n*SET_NODE_GENERAL\n6\nSOLID,2\n"
                               "*SET_NODE_GENERAL\n7\nSET_SOLID,3\n");
    EXPECT_EQ(errors_of(result), "");
    const Model& model = result.model;
    EXPECT_EQ(model.solid_sets.at(0).elements, (std::vector<Index>{1}));
    EXPECT_EQ(model.solid_sets.at(1).elements, (std::vector<Index>{0, 1}));
    EXPECT_EQ(model.solid_sets.at(2).elements, (std::vector<Index>{0}));
    EXPECT_EQ(model.part_sets.at(0).parts, (std::vector<Index>{0, 1}));
    EXPECT_EQ(model.part_sets.at(1).parts, (std::vector<Index>{1}));
    EXPECT_EQ(ids(model, model.node_sets.at(0).nodes), (std::vector<Id>{2, 3, 6, 7, 9, 10, 11, 12}));
    EXPECT_EQ(ids(model, model.node_sets.at(1).nodes), (std::vector<Id>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Sets, SegmentsOfPartsAreTheirOutside)
{
    const ReadResult result =
        read_text(two_bricks + "*SET_SEGMENT_GENERAL\n1\nALL\n*SET_SEGMENT_GENERAL\n2\nPART,1\n"
                               "*SET_SEGMENT\n3\n1,2,3,4\n5,6,7\n*SET_SEGMENT_ADD\n4\n2,3\n");
    EXPECT_EQ(errors_of(result), "");
    const auto& sets = result.model.segment_sets;
    EXPECT_EQ(sets.at(0).segments.size(), 10u); // the common face of the two bricks is inside
    EXPECT_EQ(sets.at(1).segments.size(), 6u);
    EXPECT_EQ(sets.at(2).segments[1], (std::array<Index, 4>{4, 5, 6, 6}));
    EXPECT_EQ(sets.at(3).segments.size(), 8u);
    // All normals point outwards: the divergence theorem gives the volume of the two unit bricks.
    double volume = 0;
    const auto& at = result.model.nodes.position;
    for (const auto& s : sets[0].segments)
        volume += (dot(at[s[0]], cross(at[s[1]], at[s[2]])) + dot(at[s[0]], cross(at[s[2]], at[s[3]]))) / 6;
    EXPECT_NEAR(volume, 2, 1e-14);
}

TEST(Sets, ThatHoldThemselvesAreErrors)
{
    const ReadResult result = read_text("*SET_NODE_ADD\n1\n2\n*SET_NODE_ADD\n2\n1\n");
    EXPECT_EQ(errors_of(result),
              "deck.k:2: *SET_NODE_ADD, field SID: set 1 contains itself by way of other sets\n");
}

TEST(InitialVelocities, OfPartsSetsAndEverything)
{
    const ReadResult result =
        read_text(two_bricks + "*SET_PART_LIST\n5\n2\n"
                               "*INITIAL_VELOCITY_GENERATION\n5,1,0.,1.,2.,3.\n\n"
                               "*INITIAL_VELOCITY_GENERATION\n1,2,10.\n0.,0.,0.,0.,0.,2.\n"
                               "*INITIAL_VELOCITY\n0\n4.,5.,6.\n"
                               "*INITIAL_VELOCITY_NODE\n7,1.\n");
    EXPECT_EQ(errors_of(result), "");
    const auto& velocities = result.model.initial_velocities;
    ASSERT_EQ(velocities.size(), 4u);
    EXPECT_EQ(ids(result.model, velocities[0].nodes), (std::vector<Id>{2, 3, 6, 7, 9, 10, 11, 12}));
    EXPECT_EQ(velocities[0].translation.z, 3);
    EXPECT_EQ(velocities[1].nodes.size(), 8u);
    EXPECT_EQ(velocities[1].spin, 10);
    EXPECT_EQ(velocities[1].axis.z, 1);
    EXPECT_EQ(velocities[2].nodes.size(), 12u);
    EXPECT_EQ(velocities[3].translation.x, 1);
}

TEST(PrescribedMotions, AlongAxesAndVectors)
{
    const ReadResult result =
        read_text(two_bricks + "*DEFINE_CURVE\n1\n0.,0.\n1.,1.\n*DEFINE_VECTOR\n1,0.,0.,0.,3.,0.,4.\n"
                               "*SET_NODE_LIST\n1\n1,2\n"
                               "*BOUNDARY_PRESCRIBED_MOTION_SET\n1,2,2,1,-2.\n"
                               "*BOUNDARY_PRESCRIBED_MOTION_NODE\n3,-4,0,1,1.,1,5.,1.\n");
    EXPECT_EQ(errors_of(result), "");
    const auto& motions = result.model.prescribed_motions;
    ASSERT_EQ(motions.size(), 2u);
    EXPECT_EQ(motions[0].kind, PrescribedMotion::Kind::displacement);
    EXPECT_EQ(motions[0].direction.y, 1);
    EXPECT_EQ(motions[0].scale, -2);
    EXPECT_EQ(motions[0].death, forever);
    EXPECT_NEAR(motions[1].direction.x, 0.6, 1e-15);
    EXPECT_NEAR(motions[1].direction.z, 0.8, 1e-15);
    EXPECT_FALSE(motions[1].only_component);
    EXPECT_EQ(motions[1].birth, 1);
    EXPECT_EQ(motions[1].death, 5);
}

TEST(Controls, ZeroMeansTheDefault)
{
    const ReadResult result =
        read_text("*CONTROL_TIMESTEP\n0.,0.\n*CONTROL_HOURGLASS\n0,0.\n"
                  "*CONTROL_BULK_VISCOSITY\n0.,0.,0\n*CONTROL_SHELL\n0.,0,0,0,0,0,0,0\n");
    EXPECT_EQ(errors_of(result), "");
    const Controls& controls = result.model.controls;
    EXPECT_EQ(controls.time.step_scale, 0.9);
    EXPECT_EQ(controls.elements.hourglass_coefficient, 0.1);
    EXPECT_EQ(controls.elements.quadratic_viscosity, 1.5);
    EXPECT_EQ(controls.elements.linear_viscosity, 0.06);
    EXPECT_EQ(controls.elements.bulk_viscosity_type, 1);
    EXPECT_EQ(controls.elements.shell_warp_angle, 20);
    EXPECT_EQ(controls.elements.shell_theory, 2);
    EXPECT_EQ(controls.elements.warping, 2);
    EXPECT_EQ(controls.elements.plane_stress_plasticity, 1);
    EXPECT_EQ(controls.elements.normal_update, -1);
}

TEST(Contacts, SidesTiesAndDefaults)
{
    const ReadResult result =
        read_text(two_bricks + "*SET_PART_LIST\n9\n1\n*DEFINE_CURVE\n1\n0.,0.\n1.,1.\n"
                               "*CONTROL_CONTACT\n0.2,0.,2\n\n\n1\n"
                               "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID_MPP\n         7two bricks, free\n"
                               "0,100\n&,1\n1,2,3,3\n0.3,0.2,0.,0.,20.,0,1.,2.\n2.,0.,0.1\n2,0.5\n"
                               "*CONTACT_TIED_SHELL_EDGE_TO_SURFACE_BEAM_OFFSET\n1,9,3,2\n\n\n"
                               "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n\n\n\n"
                               "*CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE_TIEBREAK\n"
                               "9,2,6,3\n\n\n6,1.,2.,.1\n");
    EXPECT_EQ(errors_of(result), "");
    const auto& contacts = result.model.contacts;
    ASSERT_EQ(contacts.size(), 4u);
    EXPECT_EQ(contacts[0].id, 7);
    EXPECT_EQ(contacts[0].title, "two bricks, free");
    EXPECT_EQ(contacts[0].kind, Contact::Kind::two_way);
    EXPECT_EQ(contacts[0].slave.parts, (std::vector<Index>{0}));
    EXPECT_EQ(contacts[0].master.parts, (std::vector<Index>{1}));
    EXPECT_EQ(contacts[0].damping, 20);
    EXPECT_EQ(contacts[0].death, 2);
    EXPECT_EQ(contacts[0].slave.stiffness_scale, 2);
    EXPECT_EQ(contacts[0].master.stiffness_scale, 1);
    EXPECT_EQ(contacts[0].slave.thickness, 0.1);
    EXPECT_EQ(contacts[0].soft, 2);
    EXPECT_EQ(contacts[0].soft_scale, 0.5);
    EXPECT_EQ(contacts[0].penalty_scale, 0.2);
    EXPECT_EQ(contacts[0].initial_penetration, 1);
    EXPECT_EQ(contacts[1].kind, Contact::Kind::tied);
    EXPECT_EQ(contacts[1].tie.method, Tie::Method::penalty);
    EXPECT_TRUE(contacts[1].tie.rotations && contacts[1].tie.moment_offset);
    EXPECT_EQ(contacts[2].slave.kind, ContactSide::Kind::all);
    EXPECT_EQ(contacts[2].death, forever);
    EXPECT_EQ(contacts[3].kind, Contact::Kind::one_way);
    EXPECT_EQ(contacts[3].slave.parts, (std::vector<Index>{1})); // everything but the set
    EXPECT_EQ(contacts[3].tie.failure, 6);
    EXPECT_EQ(contacts[3].tie.shear_strength, 2);
}

TEST(Checks, NameElementsWithoutVolumeOrArea)
{
    const std::string bad = "*ELEMENT_SOLID\n7,1,1,4,3,2,5,8,7,6\n8,1,1,2,3,4,1,2,3,4\n"
                            "*ELEMENT_SHELL\n3,1,1,2,9,9\n4,1,1,2,1,3\n";
    EXPECT_EQ(
        errors_of(read_text(two_bricks + bad)),
        "deck.k:15: *ELEMENT_SOLID: solid 8 (part 1 'left' first): no volume: corners coincide or lie in one "
        "plane\n"
        "deck.k:15: *ELEMENT_SOLID: solid 7 (part 1 'left' first): negative volume: the corners are numbered "
        "inside out\n"
        "deck.k:15: *ELEMENT_SHELL: shell 3 (part 1 'left' first): no area: corners coincide or lie on one "
        "line\n"
        "deck.k:15: *ELEMENT_SHELL: shell 4 (part 1 'left' first): opposite corners are one node\n");
}

TEST(Checks, UnitsThatDoNotFitAreDoubted)
{
    const auto warnings = [](const char* density, const char* modulus) {
        return read_text(std::string("*MAT_ELASTIC\n1,") + density + "," + modulus + ",.3\n")
            .report.warnings.size();
    };
    EXPECT_EQ(warnings("7850.", "210.e9"), 0u);   // kg, m, s
    EXPECT_EQ(warnings("7.85e-9", "210.e3"), 0u); // t, mm, s
    EXPECT_EQ(warnings("7.85e-6", "210."), 0u);   // kg, mm, ms
    EXPECT_EQ(warnings("7.85", "2.1"), 0u);       // g, cm, us
    EXPECT_EQ(warnings("7850.", "210."), 1u);     // density in kg/m3, modulus in GPa
    EXPECT_EQ(warnings("7.85e-9", "2.1e11"), 1u); // density in t/mm3, modulus in Pa
}

TEST(Fates, UnusedFieldsAreListedWithTheirReason)
{
    ReadResult result =
        read_text("*DEFINE_CURVE\n1,,,,,,2\n0.,0.\n1.,1.\n*CONTROL_TIMESTEP\n0.,.9,0,,,,,1\n");
    list_unread_fields(result.model, result.report);
    ASSERT_EQ(result.report.ignored.size(), 2u);
    EXPECT_EQ(result.report.ignored[0].field, "DATTYP");
    EXPECT_EQ(result.report.ignored[0].value, "2");
    EXPECT_NE(result.report.ignored[0].reason.find("discretises"), std::string::npos);
    EXPECT_EQ(result.report.ignored[1].field, "MS1ST");
}

/// Every field of these keywords acts or says why not.
TEST(Fates, TimeControlsLeaveNoFieldWithoutAnAnswer)
{
    ReadResult result =
        read_text("*CONTROL_TIMESTEP\n1.,.9,1,1e-6,-1.,,1,1\n.5,3,1,,,2,1.,1\n3,1,2,1\n"
                  "*CONTROL_TERMINATION\n1.,9,1.,1.,1.,1\n*CONTROL_ENERGY\n2,1,2,2,1,2,2,2\n");
    EXPECT_TRUE(result.ok);
    list_unread_fields(result.model, result.report);
    std::string fields;
    for (const auto& field : result.report.ignored) {
        fields += field.field + ' ';
        EXPECT_NE(field.reason, "") << field.field;
    }
    EXPECT_EQ(fields, "MS1ST DT2MSLC RMSCL EMSCL IHDO RMAVG IGADO DTUSR DTDYNV "
                      "HGEN RWEN SLNTEN RYLEN IRGEN MATEN DRLEN DISEN ");
}

/// Coefficients of hourglass control that are far too large, or negative, are named where they stand; those
/// of types 6 and 7 may be large.
TEST(Fates, HourglassCoefficientsBeyondTheUsualAreNamed)
{
    const auto warnings = [](const std::string& text) {
        const ReadResult result = read_text(text);
        EXPECT_TRUE(result.ok) << text;
        std::string all;
        for (const Message& message : result.report.warnings)
            all += fmt::format("{} {} {}: {}\n", message.keyword, message.field, message.where.line,
                               message.text);
        return all;
    };
    const std::string large = warnings("*HOURGLASS\n1,2,1.5,0,1.5,.06,.1,.2\n");
    EXPECT_NE(large.find("HOURGLASS QM 2: 1.5 is above 0.15"), std::string::npos) << large;
    EXPECT_NE(large.find("HOURGLASS QW 2: 0.2 is above 0.15"), std::string::npos) << large;
    EXPECT_EQ(large.find("QB/VDC"), std::string::npos) << large;
    EXPECT_NE(warnings("*CONTROL_HOURGLASS\n4,.5\n").find("CONTROL_HOURGLASS QH 2: 0.5 is above"),
              std::string::npos);
    EXPECT_NE(warnings("*HOURGLASS\n1,6,-.1\n").find("QM 2: -0.1 is negative"), std::string::npos);
    for (const char* usual : {"*HOURGLASS\n1,2,.15\n", "*HOURGLASS\n1,6,1.0\n", "*HOURGLASS\n1,7,1.0\n",
                              "*CONTROL_HOURGLASS\n4,.1\n"})
        EXPECT_EQ(warnings(usual).find("Q"), std::string::npos) << usual;
}

/// IMSCL, ERODE and NOSOL as the Model has them; what they cannot be is said.
TEST(Fates, TimeControlsSayWhatTheyCannotBe)
{
    const auto first_error = [](const std::string& text) {
        const ReadResult result = read_text(text);
        return result.report.errors.empty() ? std::string() : result.report.errors.front().text;
    };
    EXPECT_EQ(first_error("*CONTROL_TIMESTEP\n,.9,,,-1.\n,,-7\n"), "there is no set of parts 7");
    EXPECT_NE(first_error("*CONTROL_TIMESTEP\n,.9,,,-1.\n,,2\n").find("2 is neither 1"), std::string::npos);
    EXPECT_NE(first_error("*CONTROL_TIMESTEP\n,.9,,,,,12\n").find("12 is no sum"), std::string::npos);
    EXPECT_NE(first_error("*CONTROL_TERMINATION\n1.,,,,,2\n").find("2 is neither 0"), std::string::npos);
    const TimeControls beams = read_text("*CONTROL_TIMESTEP\n,.9,,,,,101\n").model.controls.time;
    EXPECT_TRUE(beams.erode_small_beams && beams.erode_small_step && !beams.erode_small_shells);
}

/// A keyword with a slip of the pen is told what it may be.
TEST(Fates, UnknownKeywordsAreComparedWithKnownOnes)
{
    EXPECT_EQ(layout_table().closest("CONTROL_TERMINATON"), "CONTROL_TERMINATION");
    EXPECT_EQ(layout_table().closest("initial-velocty"), "INITIAL_VELOCITY");
    EXPECT_EQ(layout_table().closest("FROBNICATE"), "");
    const ReadResult result = read_text("*CONTROL_TIMSTEP\n0.0,0.5\n");
    const auto messages = unsupported_keywords(result.report);
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_EQ(messages[0].text, "unknown keyword, perhaps *CONTROL_TIMESTEP");
}

/// Values between commas behind those of the last field are not lost without a word; commas alone are
/// nothing.
TEST(Fates, ValuesBehindTheLastFieldAreNamed)
{
    const auto warnings = [](const std::string& text) {
        const ReadResult result = read_text(text);
        EXPECT_TRUE(result.ok) << text;
        std::string all;
        for (const Message& message : result.report.warnings) all += message.text;
        return all;
    };
    const std::string wanted =
        "there are more values than the card has fields: those behind the last field are not read";
    EXPECT_NE(warnings("*CONTROL_TERMINATION\n1.,9,,,,,,5\n").find(wanted), std::string::npos);
    EXPECT_NE(warnings("*NODE\n1,0.,0.,0.,0,0,7\n").find(wanted), std::string::npos);
    EXPECT_EQ(warnings("*CONTROL_TERMINATION\n1.,9,,,,,,\n").find(wanted), std::string::npos);
}

} // namespace plash
