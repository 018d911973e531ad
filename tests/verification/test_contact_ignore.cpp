#include "contact/move_penetrating.h"
#include "contact/surface_contact.h"
#include "tests/support/deck_run.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

using testing::DeckRun;

/// Two sheets of shells of thickness 1 that lie over one another at a height of 0.6: by 0.4 too close. The
/// upper one has its own mesh, and is smaller.
struct Sheets {
    double thickness = 1;
    std::string upper_material = "*MAT_ELASTIC\n1,7.85e-9,2.1e5,0.3\n";
    std::string control, cards; ///< *CONTROL_CONTACT; optional cards A to C of the contact

    std::string text() const
    {
        testing::DeckText deck;
        deck.text += "*CONTROL_TERMINATION\n1.0,20\n" + control + upper_material +
                     "*MAT_ELASTIC\n2,7.85e-9,2.1e5,0.3\n" +
                     fmt::format("*SECTION_SHELL\n1,2\n{0},{0},{0},{0}\n", thickness);
        deck.part(1, 1, 1);
        deck.part(2, 1, 2);
        deck.sheet(1, {-10, -10, 0.6}, {20, 0, 0}, {0, 20, 0}, 5, 5);
        deck.sheet(2, {-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, 10, 10);
        return deck.text + "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n\n\n" + cards + "*END\n";
    }
};

constexpr Id first_of_lower = 37;

/// Reads, moves as a run does, and goes through 20 cycles: nothing may press, move or be strained.
std::vector<MovedNode> moved_without_force(const Sheets& sheets, double upper, double lower)
{
    DeckRun deck(sheets.text());
    EXPECT_TRUE(deck.scene);
    std::vector<MovedNode> moved = deck.moved;
    const Model& model = deck.read->model;
    for (std::size_t node = 0; node < model.nodes.size(); ++node)
        EXPECT_NEAR(model.nodes.position[node].z, model.nodes.id[node] < first_of_lower ? upper : lower,
                    1e-12);
    double force = 0;
    deck.watch([&](const Clock&, const State& state) {
        for (const Vec3& one : state.force) force = std::max(force, norm(one));
    });
    deck.go();
    EXPECT_LT(force, 1e-9) << "the contact's stiffness times the penetration would be 1e5";
    EXPECT_EQ(deck.scene->ledger.internal, 0);
    EXPECT_EQ(deck.scene->ledger.kinetic, 0);
    return moved;
}

} // namespace

/// IGNORE = 0, the default: the sheet of the first surface is lifted until it just touches.
TEST(ContactIgnore, NodesOfTheFirstSurfaceAreMovedToTheSurface)
{
    const std::vector<MovedNode> moved = moved_without_force({}, 1.0, 0);
    ASSERT_EQ(moved.size(), 36u);
    for (const MovedNode& one : moved) {
        EXPECT_NEAR(one.depth, 0.4, 1e-12);
        EXPECT_NEAR(one.from.z, 0.6, 1e-12);
    }
}

/// IGNORE = 1 or 2, by the contact or by *CONTROL_CONTACT, and SOFT = 2 leave the mesh alone.
TEST(ContactIgnore, OtherwisePenetrationsStayWithoutForce)
{
    Sheets sheets;
    sheets.cards = "0\n\n0,1\n";
    EXPECT_TRUE(moved_without_force(sheets, 0.6, 0).empty());
    sheets.cards = "0\n\n0,2\n";
    EXPECT_TRUE(moved_without_force(sheets, 0.6, 0).empty());
    sheets.cards = "2\n";
    EXPECT_TRUE(moved_without_force(sheets, 0.6, 0).empty());
    sheets.cards = "";
    sheets.control = "*CONTROL_CONTACT\n0.1\n\n\n1\n";
    EXPECT_TRUE(moved_without_force(sheets, 0.6, 0).empty());
}

/// A rigid sheet keeps its shape: the other one gives way where it lies under a facet of the rigid one.
TEST(ContactIgnore, RigidNodesStay)
{
    Sheets sheets;
    sheets.upper_material = "*MAT_RIGID\n1,7.85e-9,2.1e5,0.3\n";
    DeckRun deck(sheets.text());
    ASSERT_FALSE(deck.moved.empty());
    for (const MovedNode& one : deck.moved) {
        EXPECT_GE(deck.read->model.nodes.id[one.node], first_of_lower);
        EXPECT_NEAR(deck.read->model.nodes.position[one.node].z, -0.4, 1e-12);
    }
    EXPECT_EQ(deck.moved.size(), 25u) << "those under the rigid sheet, whose sides are at -10 and 10";
}

/// What lies deeper than a quarter of the shortest edge (4) stays: a move would spoil the elements.
TEST(ContactIgnore, DeepPenetrationsStay)
{
    Sheets sheets;
    sheets.thickness = 1.5; // by 0.9
    EXPECT_EQ(moved_without_force(sheets, 1.5, 0).size(), 36u);
    sheets.thickness = 1.7; // by 1.1
    EXPECT_TRUE(moved_without_force(sheets, 0.6, 0).empty());
}

} // namespace plash
