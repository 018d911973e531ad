// What the keywords of loads, walls, damping, terminations and cross sections become in the Model.

#include "tests/unit/parser_support.h"

#include <fmt/format.h>

#include <numbers>

namespace plash {

namespace {

/// Two bricks in a row along x, each its own part, a part set 1 of both, a node set 5 of the nodes at x = 0,
/// a segment set 6 of the face there, and a curve 1.
std::string two_bricks_with(const std::string& more)
{
    std::string deck =
        "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,2.0,1.0,0.0\n"
        "*PART\nfirst\n1,1,1\n*PART\nsecond\n2,1,1\n*SET_PART_LIST\n1\n1,2\n*NODE\n";
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 3; ++i)
                deck += fmt::format("{},{},{},{}\n", 1 + i + 3 * (j + 2 * k), i, j, k);
    deck += "*ELEMENT_SOLID\n1,1,1,2,5,4,7,8,11,10\n2,2,2,3,6,5,8,9,12,11\n"
            "*SET_NODE_LIST\n5\n1,4,7,10\n*SET_SEGMENT\n6\n1,7,10,4\n*DEFINE_CURVE\n1\n0.0,1.0\n1.0,3.0\n";
    return deck + more + "*END\n";
}

/// The Model of a deck without errors.
Model model_of(const std::string& more)
{
    ReadResult result = read_text(two_bricks_with(more));
    EXPECT_EQ(errors_of(result), "");
    for (const Message& message : unsupported_keywords(result.report)) ADD_FAILURE() << message.text;
    return std::move(result.model);
}

} // namespace

TEST(ReadLoads, PressureOnSegmentsAndSets)
{
    const Model model = model_of("*LOAD_SEGMENT\n1,2.0,0.25,1,7,10,4\n*LOAD_SEGMENT_SET\n6,1,3.0\n");
    ASSERT_EQ(model.pressure_loads.size(), 2u);
    EXPECT_EQ(model.pressure_loads[0].segments.size(), 1u);
    EXPECT_DOUBLE_EQ(model.pressure_loads[0].scale, 2);
    EXPECT_DOUBLE_EQ(model.pressure_loads[0].arrival, 0.25);
    EXPECT_EQ(model.pressure_loads[1].segments, model.pressure_loads[0].segments);
}

TEST(ReadLoads, BodyLoadsOfAllKinds)
{
    const Model model =
        model_of("*LOAD_BODY_RZ\n1,2.0,0,1.0,2.0,3.0\n*LOAD_BODY_VECTOR\n1,1.0\n3.0,0.0,4.0\n"
                 "*LOAD_BODY_GENERALIZED\n2,4,1,0,0.0,0.0,0.0\n0.0,0.0,0.0,0.0,0.0,5.0,0,CORI\n"
                 "*LOAD_GRAVITY_PART\n2,3,1,9.81\n*LOAD_BODY_PARTS\n1\n");
    ASSERT_EQ(model.body_loads.size(), 4u);
    EXPECT_EQ(model.body_loads[0].kind, BodyLoad::Kind::centrifugal);
    EXPECT_DOUBLE_EQ(model.body_loads[0].center.y, 2);
    EXPECT_EQ(model.body_loads[0].parts.size(), 2u); // of *LOAD_BODY_PARTS
    EXPECT_DOUBLE_EQ(model.body_loads[1].direction.z, 0.8);
    EXPECT_EQ(model.body_loads[2].kind, BodyLoad::Kind::coriolis);
    EXPECT_EQ(model.body_loads[2].nodes.size(), 3u);
    EXPECT_TRUE(model.body_loads[2].parts.empty());
    EXPECT_EQ(model.body_loads[3].parts, std::vector<Index>{1});
    EXPECT_DOUBLE_EQ(model.body_loads[3].scale, 9.81);
}

TEST(ReadLoads, ALoadThatFollowsAPlaneOfNodes)
{
    const Model model = model_of("*LOAD_NODE_POINT\n3,4,1,2.0,0,1,2,4\n");
    ASSERT_EQ(model.nodal_loads.size(), 1u);
    EXPECT_EQ(model.nodal_loads[0].follows[2], 3);
}

TEST(ReadDamping, RatesAndScales)
{
    const Model model = model_of("*DAMPING_GLOBAL\n0,7.0,1.0\n*DAMPING_PART_MASS\n1,1,2.0,0\n"
                                 "*DAMPING_RELATIVE\n0.05,10.0,2,1\n");
    ASSERT_EQ(model.dampings.size(), 3u);
    EXPECT_DOUBLE_EQ(model.dampings[0].rate, 7);
    EXPECT_DOUBLE_EQ(model.dampings[0].scale[0], 1);
    EXPECT_DOUBLE_EQ(model.dampings[0].scale[1], 0);
    EXPECT_EQ(model.dampings[1].parts, std::vector<Index>{0});
    EXPECT_EQ(model.dampings[1].scale[5], 1);
    EXPECT_NEAR(model.dampings[2].rate, 4 * std::numbers::pi * 0.05 * 10, 1e-12);
    EXPECT_EQ(model.dampings[2].reference_nodes.size(), 8u);
}

TEST(ReadWalls, ShapesAndMotions)
{
    const Model model = model_of(
        "*RIGIDWALL_PLANAR_FINITE_ID\n4,step\n0\n0.0,0.0,0.0,0.0,0.0,2.0,0.3\n1.0,0.0,5.0,4.0,3.0\n"
        "*RIGIDWALL_PLANAR_MOVING\n0\n0.0,0.0,0.0,0.0,0.0,1.0\n8.0,-2.0\n"
        "*RIGIDWALL_PLANAR_ORTHO\n0\n0.0,0.0,0.0,0.0,0.0,1.0\n0.1,0.2,0.3,0.4,5.0,6.0\n0,0,1.0,0.0,0.0\n"
        "*RIGIDWALL_GEOMETRIC_SPHERE_MOTION\n5\n1.0,2.0,3.0\n2.5\n1,1,0.0,0.0,-2.0\n"
        "*RIGIDWALL_GEOMETRIC_CYLINDER\n0\n0.0,0.0,0.0,1.0,0.0,0.0\n1.5,4.0\n"
        "*RIGIDWALL_GEOMETRIC_PRISM_DISPLAY\n0\n0.0,0.0,0.0,0.0,0.0,1.0\n0.0,1.0,0.0,1.0,2.0,3.0\n0\n"
        "*RIGIDWALL_PLANAR_MOVING_FORCES\n0\n0.0,0.0,0.0,0.0,0.0,1.0\n9.0,-3.0\n0,0,1,2,3,4\n");
    ASSERT_EQ(model.rigid_walls.size(), 7u);
    EXPECT_DOUBLE_EQ(model.rigid_walls[6].mass, 9);
    EXPECT_DOUBLE_EQ(model.rigid_walls[6].start_velocity, -3);
    const RigidWall& finite = model.rigid_walls[0];
    EXPECT_EQ(finite.id, 4);
    EXPECT_EQ(finite.shape, RigidWall::Shape::finite_plane);
    EXPECT_NEAR(finite.edge.x, 1, 1e-15); // made normal to the normal
    EXPECT_DOUBLE_EQ(finite.length[1], 3);
    EXPECT_DOUBLE_EQ(model.rigid_walls[1].mass, 8);
    EXPECT_DOUBLE_EQ(model.rigid_walls[1].start_velocity, -2);
    EXPECT_TRUE(model.rigid_walls[2].orthotropic);
    EXPECT_DOUBLE_EQ(model.rigid_walls[2].dynamic_friction[1], 0.4);
    const RigidWall& sphere = model.rigid_walls[3];
    EXPECT_DOUBLE_EQ(sphere.radius, 2.5);
    EXPECT_TRUE(sphere.motion_is_displacement);
    EXPECT_NEAR(sphere.motion_direction.z, -1, 1e-15);
    EXPECT_EQ(sphere.nodes.size(), 4u);
    EXPECT_DOUBLE_EQ(model.rigid_walls[4].length[0], 4);
    EXPECT_EQ(model.rigid_walls[5].shape, RigidWall::Shape::prism);
    EXPECT_DOUBLE_EQ(model.rigid_walls[5].length[2], 3);
}

TEST(ReadBoundaries, PlanesLocalAxesAndWavesThatLeave)
{
    const Model model = model_of(
        "*BOUNDARY_SLIDING_PLANE\n5,0.0,3.0,0.0\n*BOUNDARY_SPC_SYMMETRY_PLANE\n1,1,0.0,0.0,0.0,0.0,0.0,1."
        "0\n1e-6\n"
        "*BOUNDARY_NON_REFLECTING\n6,0.0,1.0\n*DEFINE_COORDINATE_NODES\n3,1,2,4,1\n"
        "*BOUNDARY_SPC_SET\n5,3,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n5,-9,0,1,1.0,0,0.0,0.5\n0.25,0.75\n");
    ASSERT_EQ(model.fixed_nodes.size(), 3u);
    EXPECT_EQ(model.fixed_nodes[0].freedoms, 1u);
    EXPECT_NEAR(model.fixed_nodes[0].axes[0].y, 1, 1e-15);
    EXPECT_EQ(model.fixed_nodes[1].nodes.size(), 4u); // of the first part at z = 0
    EXPECT_EQ(model.fixed_nodes[2].system, 0);
    EXPECT_EQ(model.coordinate_systems[0].nodes[2], 3);
    ASSERT_EQ(model.non_reflecting_boundaries.size(), 1u);
    EXPECT_FALSE(model.non_reflecting_boundaries[0].shear);
    ASSERT_EQ(model.prescribed_motions.size(), 1u);
    const PrescribedMotion& motion = model.prescribed_motions[0];
    EXPECT_TRUE(motion.orbit);
    EXPECT_FALSE(motion.only_component);
    EXPECT_DOUBLE_EQ(motion.center.y, 0.25);
    EXPECT_DOUBLE_EQ(motion.center.z, 0.75);
}

TEST(ReadTerminations, OfAllKinds)
{
    const Model model =
        model_of("*TERMINATION_NODE\n3,1,2.5\n*TERMINATION_BODY\n2,4,0.7\n*TERMINATION_CURVE\n1,0.5\n"
                 "*TERMINATION_DELETED_SOLIDS\n1,3\n");
    ASSERT_EQ(model.terminations.size(), 4u);
    EXPECT_DOUBLE_EQ(model.terminations[0].largest, 2.5);
    EXPECT_DOUBLE_EQ(model.terminations[0].smallest, -forever);
    EXPECT_EQ(model.terminations[1].axis, 3);
    EXPECT_EQ(model.terminations[2].kind, Termination::Kind::curve);
    EXPECT_EQ(model.terminations[3].count, 3);
}

TEST(ReadCrossSections, APlaneFindsItsElementsNodesAndArea)
{
    const Model model = model_of("*DATABASE_CROSS_SECTION_PLANE_ID\n7,middle\n0,1.4,0.5,0.5,2.4,0.5,0.5\n,\n"
                                 "*SET_SOLID\n3\n1\n*DATABASE_CROSS_SECTION_SET\n5,3\n");
    ASSERT_EQ(model.cross_sections.size(), 2u);
    const CrossSection& plane = model.cross_sections[0];
    EXPECT_EQ(plane.id, 7);
    EXPECT_EQ(plane.solids, std::vector<Index>{1});
    EXPECT_EQ(plane.nodes, (std::vector<Index>{1, 4, 7, 10})); // behind it, at x = 1
    EXPECT_NEAR(plane.area, 1, 1e-12);
    EXPECT_EQ(model.cross_sections[1].solids, std::vector<Index>{0});
    EXPECT_EQ(model.cross_sections[1].nodes.size(), 4u);
}

/// Every ASCII result file that Plash can write is made when the deck asks for it.
TEST(Database, EveryResultFileCanBeAskedFor)
{
    for (const char* name :
         {"GLSTAT", "MATSUM", "NODOUT", "ELOUT", "SWFORC", "RWFORC", "SPCFORC", "SPHOUT", "ABSTAT", "BNDOUT",
          "RBDOUT", "JNTFORC", "SECFORC", "RCFORC", "SLEOUT", "NCFORC"}) {
        const ReadResult result = read_text(fmt::format("*DATABASE_{}\n0.25\n", name));
        EXPECT_EQ(errors_of(result), "");
        std::string file = name;
        for (char& letter : file) letter = static_cast<char>(std::tolower(letter));
        const auto& asked = result.model.controls.output.ascii;
        ASSERT_TRUE(asked.contains(file)) << name;
        EXPECT_EQ(asked.at(file).interval, 0.25);
    }
}

/// The manual's words: equally distributed to the nodes of the set.
TEST(NodalMasses, OfASetAreSharedOut)
{
    const Model model = read_text(two_bricks_with("*ELEMENT_MASS_NODE_SET\n7,5,2.0\n")).model;
    ASSERT_EQ(model.masses.mass.size(), 4u);
    for (double mass : model.masses.mass) EXPECT_DOUBLE_EQ(mass, 0.5);
}

// Two bags of four triangles each: the fabric's own FLC FAC, and that of *MAT_ADD_AIRBAG_POROSITY_LEAKAGE.
TEST(ReadAirbags, FabricsLeakByTheirMaterial)
{
    const std::string deck =
        "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*SECTION_SHELL\n1,9\n0.1,0.1,0.1,0.1\n"
        "*MAT_FABRIC\n1,2.0,1.0,,,0.1\n,,,1.0\n,0.5,0.3\n*MAT_FABRIC\n2,2.0,1.0,,,0.1\n,,,1.0\n,0.5,0.3\n"
        "*MAT_ADD_AIRBAG_POROSITY_LEAKAGE\n2,0.25,0.8\n"
        "*PART\nfirst\n1,1,1\n*PART\nsecond\n2,1,2\n*SET_PART_LIST\n1\n1\n*SET_PART_LIST\n2\n2\n"
        "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n"
        "*ELEMENT_SHELL\n1,1,1,3,2,2\n2,1,1,2,4,4\n3,1,1,4,3,3\n4,1,2,3,4,4\n"
        "5,2,1,3,2,2\n6,2,1,2,4,4\n7,2,1,4,3,3\n8,2,2,3,4,4\n"
        "*AIRBAG_WANG_NEFSKE\n1,1\n700,1000,300\n\n1e5,1.2,,,,,1\n\n"
        "*AIRBAG_WANG_NEFSKE\n2,1\n700,1000,300\n\n1e5,1.2,,,,,1\n\n*END\n";
    const ReadResult result = read_text(deck);
    EXPECT_EQ(errors_of(result), "");
    ASSERT_EQ(result.model.airbags.size(), 2u);
    EXPECT_EQ(std::get<VentedGas>(result.model.airbags[0].content).leak_share, std::vector<double>(4, 0.15));
    EXPECT_EQ(std::get<VentedGas>(result.model.airbags[1].content).leak_share, std::vector<double>(4, 0.2));
}

} // namespace plash
