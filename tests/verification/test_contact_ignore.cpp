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

/// What lies deeper than a quarter of the shortest edge (4) is moved along with its neighbours: a sheet is
/// lifted as a whole.
TEST(ContactIgnore, DeepPenetrationsAreMovedWithTheirNeighbours)
{
    Sheets sheets;
    for (const double thickness : {1.5, 1.7, 2.4}) { // by 0.9, 1.1, 1.8
        sheets.thickness = thickness;
        const std::vector<MovedNode> moved = moved_without_force(sheets, thickness, 0);
        ASSERT_EQ(moved.size(), 36u) << thickness;
        for (const MovedNode& one : moved) EXPECT_NEAR(one.depth, thickness - 0.6, 1e-12);
    }
}

/// Where the neighbours do not go along, it stays: a move would spoil the elements. A node that lies 1.2
/// deeper than the others of its sheet stays, 0.9 deeper it is moved with them; either way nothing presses.
TEST(ContactIgnore, WhatWouldSpoilElementsStays)
{
    for (const double deeper : {0.9, 1.2}) {
        Sheets sheets;
        sheets.thickness = 2;
        std::string text = sheets.text();
        DeckRun deck(text);
        ASSERT_TRUE(deck.scene);
        Model model = deck.read->model; // as moved: the upper sheet at 2
        const Index node = 14;          // inside of it
        for (Index upper = 0; upper < 36; ++upper)
            model.nodes.position[upper].z = upper == node ? 1.8 - deeper : 1.8;
        const std::vector<MovedNode> moved = move_penetrating_nodes(model);
        int of_upper = 0;
        for (const MovedNode& one : moved) of_upper += one.node < 36;
        EXPECT_EQ(of_upper, deeper < 1 ? 36 : 35);
        // Where the upper sheet stays, the lower one gives way: four nodes under the facets of the node.
        EXPECT_EQ(moved.size() - of_upper, deeper < 1 ? 0u : 4u);
        EXPECT_NEAR(model.nodes.position[node].z, deeper < 1 ? 2 : 1.8 - deeper, 1e-12);
        EXPECT_NEAR(model.nodes.position[node + 1].z, 2, 1e-12);
    }
}

} // namespace plash
