// Rigid bodies as decks write them, from text to motion.

#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/rigid_parts.h"
#include "solver/scene.h"
#include "tests/paths.h"
#include "tests/support/shared_files.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fstream>

namespace plash {

namespace {

/// Two unit cubes (parts 1 and 2) side by side along x with a gap, rigid, density 8: nodes of one eighth...
/// one mass unit a corner.
const std::string cubes = R"(*KEYWORD
*CONTROL_TERMINATION
1.0
*PART
first
1,1,1
*PART
second
2,1,2
*SECTION_SOLID
1,1
*MAT_RIGID
1,8.0,2.0e5,0.3
&CARD1
0
*MAT_RIGID
2,8.0,2.0e5,0.3
0,0,0
0
*NODE
1,0.0,0.0,0.0
2,1.0,0.0,0.0
3,1.0,1.0,0.0
4,0.0,1.0,0.0
5,0.0,0.0,1.0
6,1.0,0.0,1.0
7,1.0,1.0,1.0
8,0.0,1.0,1.0
11,3.0,0.0,0.0
12,4.0,0.0,0.0
13,4.0,1.0,0.0
14,3.0,1.0,0.0
15,3.0,0.0,1.0
16,4.0,0.0,1.0
17,4.0,1.0,1.0
18,3.0,1.0,1.0
*ELEMENT_SOLID
1,1,1,2,3,4,5,6,7,8
2,2,11,12,13,14,15,16,17,18
*DEFINE_CURVE
1
0.0,1.0
10.0,1.0
*DEFINE_COORDINATE_VECTOR
5,0.6,0.8,0.0,-0.8,0.6,0.0
)";

struct DeckRun {
    testing::TemporaryFolder folder;
    ReadResult read;
    std::unique_ptr<Scene> scene;
    Outcome outcome;
    std::string error;

    explicit DeckRun(const std::string& text, double end = 1.0)
    {
        const std::string path = folder / "deck.k";
        std::ofstream(path) << text;
        read = read_model(path);
        for (const Message& message : read.report.errors) error += to_text(message, read.model) + "\n";
        for (const Message& message : unsupported_keywords(read.report))
            error += to_text(message, read.model) + "\n";
        if (!error.empty()) return;
        try {
            scene = std::make_unique<Scene>(make_scene(read.model));
        } catch (const DeckError& fault) {
            error = fault.what();
            return;
        }
        Recorders none_;
        RunOptions options;
        options.end_time = end;
        outcome = run(*scene, none_, options);
    }
    const std::vector<RigidBody>& bodies() const
    {
        for (const auto& term : scene->terms)
            if (const auto* found = dynamic_cast<const RigidBodies*>(term.get())) return found->bodies();
        throw std::runtime_error("no rigid bodies");
    }
};

std::string with_card(std::string deck, const std::string& card)
{
    deck.replace(deck.find("&CARD1"), 6, card);
    return deck;
}

} // namespace

/// CMO = -1 holds the local y direction (-0.8, 0.6, 0): a unit force along x moves the body along (0.6, 0.8).
TEST(RigidDecks, LocalConstraintsAndLoads)
{
    DeckRun run(with_card(cubes, "-1,5,010111") + "*LOAD_RIGID_BODY\n1,1,1,8.0\n2,7,1,1.0,5\n*END\n");
    ASSERT_EQ(run.error, "");
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-9);
    const Vec3 v = run.bodies()[0].velocity; // force 8 on mass 8, its share along (0.6, 0.8) over one second
    EXPECT_NEAR(v.x / v.y, 0.75, 1e-12);
    EXPECT_NEAR(norm(v), 0.6, 1e-3);
    EXPECT_NEAR(run.bodies()[1].angular_velocity.z, 1.0 / (8.0 / 2), 1e-3); // corners: I = 8 (1/4 + 1/4)
}

TEST(RigidDecks, ExtraNodesMergesAndNodalBodies)
{
    DeckRun run(with_card(cubes, "1,0,0") +
                "*CONSTRAINED_RIGID_BODIES\n1,2\n*NODE\n21,2.0,0.5,0.5\n22,2.0,0.5,4.5\n"
                "*ELEMENT_MASS\n1,21,4.0\n2,22,1.0\n*CONSTRAINED_EXTRA_NODES_NODE\n1,21\n"
                "*NODE\n31,0.0,0.0,9.0\n32,0.0,2.0,9.0\n33,0.0,0.0,10.0\n*ELEMENT_MASS\n3,31,1.0\n4,32,1."
                "0\n5,33,2.0\n"
                "*SET_NODE_LIST\n4\n31,32,33\n*CONSTRAINED_NODAL_RIGID_BODY_SPC_TITLE\nthree\n9,0,4\n1,0,4\n"
                "*INITIAL_VELOCITY_RIGID_BODY\n9,1.0,0.0,0.0,0.0,0.0,0.5\n*END\n");
    ASSERT_EQ(run.error, "");
    ASSERT_EQ(run.bodies().size(), 2u);
    // Before the first cycle nodes show the velocity that their body has from the card: (1, 0, 0), and 0.5
    // about the axis along z through its center (0, 0.5, 9.5).
    const Scene start = make_scene(run.read.model);
    const auto& ids = start.model.nodes.id;
    const auto node = std::find(ids.begin(), ids.end(), 32) - ids.begin();
    EXPECT_NEAR(start.state.velocity[node].x, 1 - 0.5 * 1.5, 1e-12);
    EXPECT_NEAR(start.state.velocity[node].y, 0, 1e-12);
    const RigidBody& merged = run.bodies()[0];
    EXPECT_EQ(merged.nodes.size(), 17u);
    EXPECT_NEAR(merged.mass, 20, 1e-12);
    EXPECT_NEAR(merged.first_center.x, 2, 1e-12);
    // x: corners 16 of (1/4 + 1/4) and nothing else, as node 21 sits in the center.
    EXPECT_NEAR(merged.body_inertia.row[0].x, 8, 1e-12);
    EXPECT_NEAR(merged.body_inertia.row[1].y, 16 * 0.25 + 8 * (1.0 + 4.0), 1e-9);
    const RigidBody& nodal = run.bodies()[1];
    EXPECT_NEAR(nodal.mass, 4, 1e-12);
    EXPECT_NEAR(nodal.velocity.x, 1, 1e-12);
    EXPECT_NEAR(nodal.angular_velocity.z, 0.5, 1e-9); // CON2 = 4 holds x and y rotation
    EXPECT_EQ(run.read.model.body_id(nodal.number), 9);
    for (const IgnoredField& field : run.read.report.ignored)
        EXPECT_FALSE(field.keyword.starts_with("CONSTRAINED_")) << field.keyword << " " << field.field;
}

TEST(RigidDecks, PartInertiaReplacesMassPropertiesAndTakesGravity)
{
    std::string deck = with_card(cubes, "0,0,0");
    const std::string part = "*PART\nsecond\n2,1,2\n";
    deck.replace(deck.find(part), part.size(),
                 "*PART_INERTIA\nsecond\n2,1,2\n5.0,0.5,0.5,20.0,0\n1.0,0.0,0.0,2.0,0.0,3.0\n0.0,0.0,2.0,0.0,"
                 "0.0,1.0\n");
    DeckRun run(deck + "*LOAD_BODY_Z\n1,10.0\n*INITIAL_VELOCITY\n0\n7.0,0.0,0.0\n*END\n");
    ASSERT_EQ(run.error, "");
    const RigidBody& body = run.bodies()[1];
    EXPECT_EQ(body.mass, 20);
    EXPECT_EQ(body.first_center.x, 5);
    EXPECT_EQ(run.bodies()[0].velocity.x, 7);
    EXPECT_EQ(body.velocity.x, 0) << "the card's velocity goes before *INITIAL_VELOCITY";
    EXPECT_NEAR(body.velocity.z, 2 - 10, 0.02); // to half a step
    EXPECT_NEAR(body.angular_velocity.z, 1, 1e-12) << "gravity must not turn it";
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-9);
}

/// All nodes of a body hold y, z and the rotations: it moves along x and keeps its place otherwise.
TEST(RigidDecks, SupportsOnNodesHoldTheBody)
{
    DeckRun run(with_card(cubes, "0,0,0") +
                "*SET_NODE_GENERAL\n8\nPART,1\n*BOUNDARY_SPC_SET\n8,0,0,1,1,1,1,1\n"
                "*LOAD_NODE_POINT\n1,1,1,8.0\n1,2,1,3.0\n*END\n");
    ASSERT_EQ(run.error, "");
    const RigidBody& body = run.bodies()[0];
    EXPECT_NEAR(body.velocity.x, 1, 1e-3);
    EXPECT_NEAR(body.center.y, 0.5, 1e-12);
    EXPECT_NEAR(body.orientation.row[0].x, 1, 1e-12);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-9);
}

/// A rigid cube dropped flat on a wall comes back with its speed (the wall's springs store the impact), one
/// dropped on an edge keeps its energy too; no node sinks deeper than a few steps' travel.
TEST(RigidDecks, BodiesBounceFromWalls)
{
    for (const double height : {0.0, 0.4}) {
        std::string deck = with_card(cubes, "0,0,0");
        if (height > 0) { // tilts the first cube
            for (const auto& [from, to] : {std::pair{"2,1.0,0.0,0.0", "2,0.9165,0.0,0.4"},
                                           std::pair{"3,1.0,1.0,0.0", "3,0.9165,1.0,0.4"},
                                           std::pair{"5,0.0,0.0,1.0", "5,-0.4,0.0,0.9165"},
                                           std::pair{"6,1.0,0.0,1.0", "6,0.5165,0.0,1.3165"},
                                           std::pair{"7,1.0,1.0,1.0", "7,0.5165,1.0,1.3165"},
                                           std::pair{"8,0.0,1.0,1.0", "8,-0.4,1.0,0.9165"}})
                deck.replace(deck.find(from), std::string(from).size(), to);
        }
        DeckRun run(deck + "*INITIAL_VELOCITY\n0\n0.0,0.0,-2.0\n*RIGIDWALL_PLANAR\n0\n"
                           "0.0,0.0,-0.5,0.0,0.0,1.0,0.0\n*END\n");
        ASSERT_EQ(run.error, "");
        const RigidBody& body = run.bodies()[0];
        if (height == 0) {
            EXPECT_NEAR(body.velocity.z, 2, 0.02);
        }
        EXPECT_GT(body.velocity.z, 0);
        EXPECT_GT(body.center.z, 0);
        EXPECT_LT(run.scene->ledger.balance_error(), 0.01);
    }
}

/// *BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL: the driven direction turns with the body.
TEST(RigidDecks, LocalDriveTurnsWithTheBody)
{
    DeckRun run(with_card(cubes, "0,0,0") + "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,7,0,1,1.5707963\n"
                                            "*BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL\n1,1,0,1,2.0\n"
                                            "1,2,0,1,0.0\n*END\n");
    ASSERT_EQ(run.error, "");
    // A quarter circle: radius v / omega.
    const double radius = 2.0 / 1.5707963;
    EXPECT_NEAR(run.bodies()[0].center.x - 0.5, radius, 1e-3 * radius);
    EXPECT_NEAR(run.bodies()[0].center.y - 0.5, radius, 2e-3 * radius);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-4);
}

TEST(RigidDecks, JointFromDeckHoldsTwoCubesTogether)
{
    const std::string nodes = "*NODE\n41,2.0,0.5,0.5\n42,2.0,0.5,0.5\n43,2.0,1.5,0.5\n44,2.0,1.5,0.5\n"
                              "*CONSTRAINED_EXTRA_NODES_NODE\n1,41\n1,43\n2,42\n2,44\n";
    DeckRun run(with_card(cubes, "0,0,0") + nodes +
                "*CONSTRAINED_JOINT_REVOLUTE_ID\n        77hinge\n41,42,43,44\n*LOAD_NODE_POINT\n17,3,1,4.0\n"
                "*END\n");
    ASSERT_EQ(run.error, "");
    const auto& [a, b] = std::tie(run.bodies()[0], run.bodies()[1]);
    const Vec3 on_a = a.center + a.orientation * Vec3{1.5, 0, 0};
    const Vec3 on_b = b.center + b.orientation * Vec3{-1.5, 0, 0};
    EXPECT_LT(norm(on_a - on_b), 1e-12);
    EXPECT_GT(std::abs(a.orientation.row[0].z), 1e-3);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-6);
}

/// Two cubes that a locking joint holds together, a corner of the second pulled along x by 4 t and lifted by
/// t: they move as one body of both.
TEST(RigidDecks, LockingJointMakesOneBodyOfTwo)
{
    const std::string loads =
        "*DEFINE_CURVE\n2\n0.0,0.0\n10.0,10.0\n*LOAD_NODE_POINT\n17,1,2,4.0\n17,3,2,1.0\n";
    const std::string joint =
        "*NODE\n41,2.0,0.5,0.5\n42,2.0,0.5,0.5\n*CONSTRAINED_EXTRA_NODES_NODE\n1,41\n2,42\n"
        "*CONSTRAINED_JOINT_LOCKING\n41,42,41,42,41,42\n";
    DeckRun locked(with_card(cubes, "0,0,0") + loads + joint + "*END\n");
    DeckRun merged(with_card(cubes, "0,0,0") + loads + "*CONSTRAINED_RIGID_BODIES\n1,2\n*END\n");
    ASSERT_EQ(locked.error, "");
    ASSERT_EQ(merged.error, "");
    const Index count = merged.read.model.nodes.size();
    for (Index node = 0; node < count; ++node) {
        EXPECT_LT(norm(locked.scene->state.position[node] - merged.scene->state.position[node]), 1e-6)
            << node;
    }
    EXPECT_GT(merged.bodies()[0].angular_velocity.y, -1);
    EXPECT_GT(norm(merged.bodies()[0].angular_velocity), 1e-3);
    EXPECT_LT(locked.scene->ledger.balance_error(), 1e-6);
}

/// Two cubes of 8 on a spherical joint, the second pulled along the line of their centers by 4 t: the joint
/// carries 2 t.
TEST(RigidDecks, JointsFailAtTheirStrength)
{
    const auto speeds = [](const std::string& failure) {
        DeckRun run(with_card(cubes, "0,0,0") +
                    "*DEFINE_CURVE\n2\n0.0,0.0\n10.0,40.0\n*LOAD_RIGID_BODY\n2,1,2,1.0\n"
                    "*NODE\n41,2.0,0.5,0.5\n42,2.0,0.5,0.5\n*CONSTRAINED_EXTRA_NODES_NODE\n1,41\n2,42\n"
                    "*CONSTRAINED_JOINT_SPHERICAL_FAILURE\n41,42\n" +
                    failure + "*END\n");
        EXPECT_EQ(run.error, "");
        EXPECT_LT(run.scene->ledger.balance_error(), 1e-6);
        return std::array{run.bodies()[0].velocity.x, run.bodies()[1].velocity.x};
    };
    // Together until it fails at t: momentum 2 t^2 on mass 16; then the second alone.
    const auto expect_failure_at = [&](const std::string& failure, double t) {
        const auto [first, second] = speeds(failure);
        EXPECT_NEAR(first, 2 * t * t / 16, 1e-3) << failure;
        EXPECT_NEAR(second, 2 * t * t / 16 + 2 * (1 - t * t) / 8, 2e-3) << failure;
    };
    expect_failure_at("0,0.0,0.0\n1.2,0.0,0.0\n", 0.6);
    expect_failure_at("0,0.0,1.0\n1.2,0.0,0.0\n", 0.6);
    expect_failure_at("0,0.4,0.0\n1.2,0.0,0.0\n", 0.4);
    expect_failure_at("0,0.0,0.0\n0.0,0.1,0.1,0.1,0.1,0.1\n", 1);
    expect_failure_at("5,0.0,0.0\n0.9,1.2,0.0\n", std::sqrt(0.5) * 0.75); // 0.6, 0.8 of it over 0.9, 1.2
}

/// Rigid elements cost nothing: their parts make no element term at all.
TEST(RigidDecks, RigidPartsHaveNoElementTerms)
{
    DeckRun run(with_card(cubes, "0,0,0") + "*END\n");
    ASSERT_EQ(run.error, "");
    ASSERT_EQ(run.scene->terms.size(), 1u);
    EXPECT_EQ(run.scene->terms[0]->name(), "rigid bodies");
    EXPECT_EQ(run.scene->terms[0]->items(), 2u);
}

/// Two beams of 3 and 4 units at a right angle, area 0.5, density 8, and a discrete one with a volume of
/// 0.25: 12, 16 and 2 units of mass, half of each at its ends.
TEST(RigidDecks, PartsOfBeamsHaveTheirMasses)
{
    DeckRun run(with_card(cubes, "0,0,0") +
                "*PART\nframe\n3,3,2\n*SECTION_BEAM\n3,2\n0.5,0.1,0.1,0.2\n*PART\nconnector\n4,4,2\n"
                "*SECTION_BEAM\n4,6\n0.25,0.01\n*CONSTRAINED_RIGID_BODIES\n3,4\n"
                "*NODE\n21,0.0,0.0,9.0\n22,3.0,0.0,9.0\n23,3.0,4.0,9.0\n24,0.0,4.0,9.0\n"
                "*ELEMENT_BEAM\n1,3,21,22,24\n2,3,22,23,24\n3,4,23,24,21\n*END\n");
    ASSERT_EQ(run.error, "");
    ASSERT_EQ(run.bodies().size(), 3u);
    const RigidBody& frame = run.bodies()[2];
    EXPECT_NEAR(frame.mass, 30, 1e-12);
    EXPECT_NEAR(frame.first_center.x, (14 * 3 + 9 * 3) / 30.0, 1e-12);
    EXPECT_NEAR(frame.first_center.y, (9 * 4 + 1 * 4) / 30.0, 1e-12);
}

/// *DEFORMABLE_TO_RIGID: an elastic part that is rigid from the start, without element term; merged to a
/// lead.
TEST(RigidDecks, DeformableToRigid)
{
    std::string deck = with_card(cubes, "0,0,0");
    const std::string law = "*MAT_RIGID\n2,8.0,2.0e5,0.3\n0,0,0\n0\n";
    deck.replace(deck.find(law), law.size(), "*MAT_ELASTIC\n2,8.0,2.0e5,0.3\n");
    DeckRun run(deck + "*DEFORMABLE_TO_RIGID\n2,1\n*END\n");
    ASSERT_EQ(run.error, "");
    ASSERT_EQ(run.bodies().size(), 1u);
    EXPECT_NEAR(run.bodies()[0].mass, 16, 1e-12);
    EXPECT_EQ(run.scene->terms.size(), 1u);
}

/// Masses in a row on a weld, the last one, of one unit, pulled away by a force that grows as 4 t: the weld
/// carries the share of the others of it and breaks when that reaches SN, at t = 0.75. Then the last one
/// flies on alone.
void expect_weld_to_break(const std::string& cards, int masses, double mass)
{
    DeckRun run(with_card(cubes, "0,0,0") + cards +
                fmt::format("*DEFINE_CURVE\n2\n0.0,0.0\n10.0,40.0\n*LOAD_NODE_POINT\n{},1,2,1.0\n*END\n",
                            50 + masses));
    ASSERT_EQ(run.error, "");
    const Index last = run.read.model.nodes.size() - 1;
    const State& state = run.scene->state;
    // Together until 0.75: momentum 2 t^2. Then the last one alone: + 2 (1 - 0.75^2) on mass 1.
    const double together = 2 * 0.5625 / mass;
    for (Index node = last - masses + 1; node < last; ++node)
        EXPECT_NEAR(state.velocity[node].x, together, 4e-3);
    EXPECT_NEAR(state.velocity[last].x, together + 2 * (1 - 0.5625), 8e-3);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-6);
}

TEST(RigidDecks, SpotweldFailsAtItsStrength)
{
    expect_weld_to_break("*NODE\n51,0.0,9.0,0.0\n52,2.0,9.0,0.0\n*ELEMENT_MASS\n1,51,2.0\n2,52,1.0\n"
                         "*CONSTRAINED_SPOTWELD\n51,52,2.0,0.0,1.0,1.0\n",
                         2, 3);
}

TEST(RigidDecks, GeneralizedWeldFailsAtItsStrength)
{
    expect_weld_to_break("*NODE\n51,0.0,9.0,0.0\n52,1.0,9.0,0.0\n53,2.0,9.0,0.0\n"
                         "*ELEMENT_MASS\n1,51,2.0\n2,52,1.0\n3,53,1.0\n*SET_NODE_LIST\n5\n51,52,53\n"
                         "*CONSTRAINED_GENERALIZED_WELD_SPOT\n5\n0.0,0.0,2.25,0.0,1.0,1.0\n",
                         3, 4);
}

/// Masses 2 and 1 in a row and one more card, that of a weld with the axes 7: global ones (local y along z
/// when the normal of a butt weld stands across the pull).
std::string two_masses(bool pulled_across, const std::string& weld)
{
    return "*NODE\n51,0.0,9.0,0.0\n52,2.0,9.0,0.0\n*ELEMENT_MASS\n1,51,2.0\n2,52,1.0\n*SET_NODE_LIST\n5\n51,"
           "52\n"
           "*DEFINE_COORDINATE_SYSTEM\n" +
           std::string(pulled_across ? "7,0.0,0.0,0.0,0.0,1.0,0.0\n0.0,0.0,1.0\n"
                                     : "7,0.0,0.0,0.0,1.0,0.0,0.0\n0.0,1.0,0.0\n") +
           "*CONSTRAINED_GENERALIZED_WELD_" + weld;
}

/// The area is 1 (2.0 times 0.5), so stresses are the force of 2 at which the weld has to break.
TEST(RigidDecks, ButtWeldFailsByTheStressInItsPlane)
{
    // Pulled open: BETA times 2.
    expect_weld_to_break(two_masses(false, "BUTT\n5,7\n0.0,0.0,3.0,1.5,2.0,0.5\n"), 2, 3);
    // Sheared: the square root of 3 times 2.
    expect_weld_to_break(two_masses(true, "BUTT\n5,7\n0.0,0.0,3.4641016,1.0,2.0,0.5\n"), 2, 3);
}

/// A throat turned by 30 degrees: sigma_n = 2 sin 30, tau_n = 2 cos 30, together the square root of 10.
TEST(RigidDecks, FilletWeldFailsByTheStressInItsThroat)
{
    expect_weld_to_break(two_masses(false, "FILLET\n5,7\n0.0,0.0,3.1622777,1.0,2.0,9.0,0.5,30.0\n"), 2, 3);
}

TEST(RigidDecks, ButtWeldHoldsUnderPressure)
{
    DeckRun run(with_card(cubes, "0,0,0") + two_masses(false, "BUTT\n5,7\n0.0,0.0,3.0,1.5,2.0,0.5\n") +
                "*DEFINE_CURVE\n2\n0.0,0.0\n10.0,40.0\n*LOAD_NODE_POINT\n52,1,2,-1.0\n*END\n");
    ASSERT_EQ(run.error, "");
    const State& state = run.scene->state;
    const Index last = run.read.model.nodes.size() - 1;
    EXPECT_NEAR(state.velocity[last].x, -2.0 / 3, 1e-2) << "momentum 2 t^2 of both at t = 1";
    EXPECT_NEAR(state.velocity[last - 1].x, state.velocity[last].x, 1e-12);
}

TEST(RigidDecks, WeldsInAPlaneNeedItsAxesAndItsArea)
{
    const auto error = [](const std::string& weld) {
        return DeckRun(with_card(cubes, "0,0,0") + two_masses(false, weld) + "*END\n").error;
    };
    EXPECT_NE(error("BUTT\n5,0\n0.0,0.0,3.0,1.5,2.0,0.5\n").find("field CID"), std::string::npos);
    EXPECT_NE(error("FILLET\n5,7\n0.0,0.0,3.0,1.5,2.0,0.5\n").find("width A = 0"), std::string::npos);
}

/// _INERTIA and _SPC together, in either order: mass, center and inertia of the card, held along x and about
/// z.
TEST(RigidDecks, NodalBodiesWithInertiaAndSupports)
{
    for (const char* suffix : {"_INERTIA_SPC", "_SPC_INERTIA"}) {
        DeckRun run(with_card(cubes, "0,0,0") +
                    "*NODE\n31,0.0,0.0,9.0\n32,0.0,2.0,9.0\n33,0.0,0.0,10.0\n*SET_NODE_LIST\n4\n31,32,33\n"
                    "*CONSTRAINED_NODAL_RIGID_BODY" +
                    suffix +
                    "\n9,0,4\n1,1,6\n0.0,1.0,9.0,5.0\n2.0,0.0,0.0,3.0,0.0,4.0\n1.0,2.0,0.0,0.5,0.0,0.0\n"
                    "*END\n");
        ASSERT_EQ(run.error, "") << suffix;
        const RigidBody& body = run.bodies()[2];
        EXPECT_EQ(body.mass, 5) << suffix;
        EXPECT_EQ(body.first_center.y, 1) << suffix;
        EXPECT_EQ(body.body_inertia.row[2].z, 4) << suffix;
        EXPECT_EQ(body.velocity.x, 0) << suffix << ": CON1 = 1 holds x";
        EXPECT_EQ(body.velocity.y, 2) << suffix;
        EXPECT_EQ(body.angular_velocity.z, 0) << suffix << ": CON2 = 6 holds z and x";
    }
}

TEST(RigidDecks, FaultsNameTheirField)
{
    const auto error = [](const std::string& card, const std::string& more) {
        return DeckRun(with_card(cubes, card) + more + "*END\n").error;
    };
    EXPECT_NE(error("1,9,0", "").find("CON1: 9 is not a constraint code from 0 to 7"), std::string::npos);
    EXPECT_NE(error("-1,5,020000", "").find("figures that are not 0 or 1"), std::string::npos);
    EXPECT_NE(error("0,0,0", "*CONSTRAINED_JOINT_SPHERICAL\n1,2\n").find("belong to one rigid body"),
              std::string::npos);
    EXPECT_NE(error("0,0,0", "*NODE\n21,9.0,0.0,0.0\n*CONSTRAINED_JOINT_SPHERICAL\n1,21\n")
                  .find("node 21 belongs to no rigid body"),
              std::string::npos);
    EXPECT_NE(
        error("0,0,0", "*CONSTRAINED_EXTRA_NODES_NODE\n1,11\n").find("node 11 belongs to the rigid bodies"),
        std::string::npos);
}

/// examples/slider_crank: the slider stands where kinematics says, and the motor's work is the kinetic
/// energy.
TEST(RigidDecks, SliderCrankExample)
{
    const ReadResult read =
        read_model(std::string(PLASH_SOURCE_DIR) + "/examples/slider_crank/slider_crank.k");
    ASSERT_TRUE(read.ok);
    EXPECT_TRUE(unsupported_keywords(read.report).empty());
    Scene scene = make_scene(read.model);
    Recorders none_;
    const Outcome outcome = run(scene, none_);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    const RigidBodies* term = nullptr;
    for (const auto& candidate : scene.terms)
        if (const auto* found = dynamic_cast<const RigidBodies*>(candidate.get())) term = found;
    ASSERT_NE(term, nullptr);
    const double angle = 10 * (outcome.clock.time + outcome.clock.step); // bodies stand at n + 1
    const double place = std::cos(angle) + std::sqrt(2.5 * 2.5 - std::sin(angle) * std::sin(angle));
    EXPECT_NEAR(term->bodies()[3].center.x, place, 1e-9);
    // 1,000 steps a turn: (omega dt)^2 = 4e-5.
    EXPECT_LT(scene.ledger.balance_error(), 1e-4);
}

/// The show case of a screw joint (DYNAmore): body 10000046 is turned by a curve; the screw's pitch is 25 mm
/// per radian. Both bodies slide freely along x, so the relative travel must be 25 times the prescribed
/// angle.
TEST(RigidDecks, JointScrewFollowsItsPitch)
{
    const auto deck = testing::shared_file("decks/targets/joint_screw/EXP_SC_JOINT_SCREW.key");
    PLASH_NEED_SHARED(deck);
    const ReadResult read = read_model(deck.string());
    ASSERT_TRUE(read.ok);
    ASSERT_EQ(read.model.joints.size(), 1u);
    Scene scene = make_scene(read.model);
    Recorders none_;
    RunOptions options;
    options.end_time = 1.0;
    const Outcome outcome = run(scene, none_, options);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    const RigidBodies* term = nullptr;
    for (const auto& candidate : scene.terms)
        if (const auto* found = dynamic_cast<const RigidBodies*>(candidate.get())) term = found;
    ASSERT_NE(term, nullptr);
    const auto& bodies = term->bodies();
    ASSERT_EQ(bodies.size(), 2u);
    const double apart =
        (bodies[1].center.x - bodies[1].first_center.x) - (bodies[0].center.x - bodies[0].first_center.x);
    const double turned = std::atan2(bodies[1].orientation.row[2].y, bodies[1].orientation.row[1].y);
    EXPECT_NEAR(turned, (outcome.clock.time + outcome.clock.step) / 6, 1e-9); // the curve: 1 rad in 6 ms
    EXPECT_NEAR(apart, 25 * turned, 1e-9);
    EXPECT_LT(scene.ledger.balance_error(), 0.02);
}

namespace {

/// The second cube (center at (3.5, 0.5, 0.5), the first one's at (0.5, 0.5, 0.5)) displaced from the first
/// by 0.5 t + t^2 / 2, the first driven about z and along y.
std::string relative_motion(const std::string& card)
{
    return with_card(cubes, "0,0,0") +
           "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,7,0,1,0.4\n1,2,0,1,2.0\n2,0,4,3,2.0\n" + card +
           "\n*DEFINE_CURVE\n3\n0.0,0.0\n0.25,0.078125\n0.5,0.1875\n1.0,0.5\n*END\n";
}

} // namespace

/// VAD = 4 along the line between the mass centers: their distance is the first one and twice the curve, to
/// round-off, wherever the lead body goes; the lead body is not pushed, and all work comes from outside.
TEST(RigidDecks, KeepsADistanceFromAnotherBody)
{
    DeckRun run(relative_motion("0.0,0.0,1"));
    ASSERT_EQ(run.error, "");
    ASSERT_EQ(run.outcome.termination, Outcome::Termination::normal) << run.outcome.message;
    const auto& bodies = run.bodies();
    // After the last step bodies stand at n+1 already: the curve goes on with its last value.
    EXPECT_NEAR(norm(bodies[1].center - bodies[0].center), 3 + 2 * 0.5, 1e-12);
    EXPECT_NEAR(bodies[0].center.y, 0.5 + 2.0 * (run.outcome.clock.time + run.outcome.clock.step), 1e-9);
    EXPECT_NEAR(bodies[0].velocity.x, 0, 1e-12);
    EXPECT_NEAR(bodies[0].angular_velocity.z, 0.4, 1e-12);
    EXPECT_EQ(norm(bodies[1].angular_velocity), 0); // pushed at its center
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
}

/// Along two nodes of the lead body, which turn with it: the other freedoms of the driven body are free.
TEST(RigidDecks, IsDisplacedAlongTwoNodesOfAnotherBody)
{
    DeckRun run(relative_motion("0.0,0.0,1,1,4")); // y of the first cube
    ASSERT_EQ(run.error, "");
    ASSERT_EQ(run.outcome.termination, Outcome::Termination::normal) << run.outcome.message;
    const auto& bodies = run.bodies();
    const Vec3 along = bodies[0].orientation * Vec3{0, 1, 0};
    EXPECT_NEAR(dot(bodies[1].center - bodies[0].center, along), 2 * 0.5, 1e-12);
    EXPECT_NEAR(bodies[0].angular_velocity.z, 0.4, 1e-12);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
}

TEST(RigidDecks, RefusesARelativeMotionWithoutAWayToGo)
{
    const auto message = [](const std::string& card, const std::string& cards) {
        std::string deck = relative_motion(card);
        if (!cards.empty()) deck.replace(deck.find("2,0,4,3,2.0"), 11, cards);
        return DeckRun(deck).error;
    };
    EXPECT_NE(message("0.0,0.0,2", "").find("LRB: 2 is the driven body itself"), std::string::npos)
        << message("0.0,0.0,2", "");
    EXPECT_NE(message("0.0,0.0,1,5,5", "").find("needs two different nodes"), std::string::npos);
}

} // namespace plash
