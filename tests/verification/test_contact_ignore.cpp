#include "contact/move_penetrating.h"
#include "contact/surface_contact.h"
#include "tests/support/contact_model.h"
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

/// A node lies on a sheet, but for round-off, over another one whose thickness reaches beyond the first. As
/// it comes off the first it is found within the second: what it has there has been there before, and gives
/// no force. (It was taken for the same touch gone deeper at once, and shot.)
TEST(ContactIgnore, NodeThatComesOffASheetIsNotShotByTheOneBehind)
{
    testing::ContactModel mesh;
    const Index thin = mesh.add_part(1.0, 210, 0.1), thick = mesh.add_part(1.0, 210, 0.7),
                own = mesh.add_part(1.0, 210, 0.3);
    mesh.add_sheet(thin, 3, 3, [](double u, double v) { return Vec3{3 * u, 3 * v, 0}; });
    mesh.add_sheet(thick, 3, 3, [](double u, double v) { return Vec3{3 * u, 3 * v, -0.2}; });
    const Index first = mesh.add_sheet(own, 1, 1, [](double u, double v) {
        return Vec3{1.2 + 0.5 * u, 1.3 + 0.5 * v, 0.2 - 1e-12}; // 0.1 within the thick one
    });
    Contact contact;
    contact.kind = Contact::Kind::one_way;
    contact.slave.kind = contact.master.kind = ContactSide::Kind::parts;
    contact.slave.parts = {own};
    contact.master.parts = {thin, thick};
    contact.limit_thickness = false;
    mesh.model.contacts.push_back(contact);
    State state = mesh.state();
    SurfaceContact term(mesh.model.contacts[0], mesh.model, part_data(mesh.model));
    Clock clock;
    clock.step = clock.last_step = 0.01;
    const auto force_after = [&](double rise) {
        for (std::size_t i = first; i < state.size(); ++i) {
            state.velocity[i].z = rise / clock.step;
            state.position[i].z += rise;
        }
        clock.time += clock.step;
        state.clear_forces();
        term.add_forces(clock, state);
        return state.force[first].z;
    };
    clock.last_step = 0;
    EXPECT_EQ(force_after(0), 0);
    clock.last_step = clock.step;
    ASSERT_EQ(term.touches().size(), 4u);
    EXPECT_LT(term.touches().all[0].penetration, 1e-11) << "the thin sheet is closest";
    for (const double rise : {2e-12, 1e-12, 1e-6}) EXPECT_NEAR(force_after(rise), 0, 1e-9);
    ASSERT_EQ(term.touches().size(), 4u);
    EXPECT_NEAR(term.touches().all[0].penetration, 0.1, 1e-5) << "within the thick one";
    // What it is pressed in from here on gives force: 0.01 in some ten steps.
    double force = 0;
    for (int cycle = 0; cycle < 10; ++cycle) force = force_after(-1e-7);
    EXPECT_GT(force, 0);
    EXPECT_NEAR(term.touches().all[0].active_penetration(), 1e-6, 1e-7);
}

} // namespace plash
