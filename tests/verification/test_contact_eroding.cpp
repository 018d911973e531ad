#include "contact/interior_contact.h"
#include "contact/surface_contact.h"
#include "tests/support/deck_run.h"

namespace plash {

namespace {

using testing::DeckRun;
using testing::DeckText;

/// A hard cube strikes a block of four layers that fail at a plastic strain of 0.2 (t, mm, s).
std::string shot(const std::string& contact)
{
    DeckText deck;
    deck.text += "*CONTROL_TERMINATION\n6.0e-5\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.6e-8,6.0e5,0.2\n"
                 "*MAT_PLASTIC_KINEMATIC\n2,2.7e-9,7.0e4,0.3,200.0,100.0,0.0\n0.0,0.0,0.2\n";
    deck.part(1, 1, 1);
    deck.part(2, 1, 2);
    deck.block(2, {-10, -10, 0}, {10, 10, 8}, 10, 10, 4);
    deck.block(1, {-3, -3, 8.01}, {3, 3, 14.01}, 3, 3, 3);
    deck.text += contact + "*INITIAL_VELOCITY_GENERATION\n1,2,0.0,0.0,0.0,-3.0e5\n0,0,0,0,0,0\n";
    return deck.text;
}

} // namespace

/// The cube digs into the block: faces that erosion lays open take part, so that it goes on losing momentum
/// after the first layer has gone, and never gets ahead of living material.
TEST(ErodingContact, LaysOpenFacesBehindTheEroded)
{
    for (const char* contact : {"*CONTACT_ERODING_SURFACE_TO_SURFACE\n1,2,3,3\n\n\n0,1\n",
                                "*CONTACT_ERODING_SINGLE_SURFACE_ID\n4,all\n0\n\n\n0,1\n"}) {
        DeckRun run(shot(contact));
        ASSERT_TRUE(run.scene);
        const auto* term = run.find<SurfaceContact>();
        ASSERT_NE(term, nullptr);
        std::size_t on_inner = 0;
        long deleted = 0;
        run.watch([&](const Clock&, const State& state) {
            deleted = state.deletions;
            term->touches().for_each([&](const Touch& touch) {
                on_inner += term->mesh().segments[touch.facet].covered_by != none && touch.force.z != 0;
            });
        });
        run.go();
        EXPECT_GT(deleted, 8) << contact;
        EXPECT_GT(on_inner, 50u) << "faces between solids have carried load: " << contact;
        EXPECT_LT(run.scene->ledger.balance_error(), 0.02) << contact;
    }
}

/// A rigid ball of 6 mm radius goes through a plate of 1 mm steel that fails at a plastic strain of 0.3. It
/// must lose speed to the plug in its way (Recht and Ipson 1963: without any work of shear v M / (M + m) is
/// left) and to the plate's plastic work, and the balance must account for all of it.
TEST(ErodingContact, BallGoesThroughAPlate)
{
    DeckText deck;
    deck.text +=
        "*CONTROL_TERMINATION\n1.2e-4\n*SECTION_SOLID\n1,1\n*SECTION_SHELL\n2,2,0.833,3\n1.0,1.0,1.0,1.0\n"
        "*MAT_RIGID\n1,7.85e-9,2.1e5,0.3\n\n\n"
        "*MAT_PIECEWISE_LINEAR_PLASTICITY\n2,7.85e-9,2.1e5,0.3,400.0,500.0,0.3\n";
    deck.part(1, 1, 1);
    deck.part(2, 2, 2);
    deck.sheet(2, {-30, -30, 0}, {60, 0, 0}, {0, 60, 0}, 30, 30);
    std::string edge = "*SET_NODE_LIST\n1\n";
    int count = 0;
    for (int i = 0; i < 31 * 31; ++i) {
        const int column = i % 31, row = i / 31;
        if (column > 0 && column < 30 && row > 0 && row < 30) continue;
        edge += fmt::format("{}{}", i + 1, ++count % 8 == 0 ? "\n" : ",");
    }
    edge += count % 8 == 0 ? "" : "\n";
    const int first = deck.ball(1, {0.3, 0.2, 7}, 6, 4);
    deck.text += edge + "*BOUNDARY_SPC_SET\n1,0,1,1,1,1,1,1\n"
                        "*CONTACT_ERODING_NODES_TO_SURFACE\n2,1,3,3\n\n\n0,1\n1\n"
                        "*INITIAL_VELOCITY_GENERATION\n1,2,0.0,0.0,0.0,-3.0e5\n0,0,0,0,0,0\n";
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    run.go();
    const State& state = run.scene->state;
    const Index center = run.node(first + 62);
    EXPECT_GT(state.deletions, 10);
    EXPECT_LT(state.position[center].z, -12) << "it has gone through";
    // The plug of 6 mm radius has 0.9 g of 7.1 g: 13 % at most go to it, the rest of the loss is plastic
    // work.
    EXPECT_LT(state.velocity[center].z, -1.5e5);
    EXPECT_GT(state.velocity[center].z, -2.97e5);
    EXPECT_LT(run.scene->ledger.balance_error(), 0.02);
}

/// A cube strikes the middle of one wide solid, whose nodes are far from it. Its own nodes are those of the
/// second surface: with NSEROD = 0 they act as well and the cube turns back, with 1 it goes through.
TEST(ErodingContact, NodesToSurfaceActsBothWaysUnlessNserodSaysOneWay)
{
    for (const int one_way : {0, 1}) {
        DeckText deck;
        deck.text += fmt::format("*CONTROL_CONTACT\n0.1\n\n\n\n0,{}\n", one_way);
        deck.text += "*CONTROL_TERMINATION\n4.0e-4\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,7.85e-9,2.1e5,0.3\n";
        deck.part(1, 1, 1);
        deck.part(2, 1, 1);
        deck.block(1, {-10, -10, 0}, {10, 10, 10}, 1, 1, 1);
        const int cube = deck.block(2, {-2, -2, 10.5}, {2, 2, 14.5}, 1, 1, 1);
        deck.text += "*CONTACT_ERODING_NODES_TO_SURFACE\n1,2,3,3\n\n\n0,1\n"
                     "*INITIAL_VELOCITY_GENERATION\n2,2,0.0,0.0,0.0,-5.0e3\n0,0,0,0,0,0\n";
        DeckRun run(deck.text);
        ASSERT_TRUE(run.scene);
        run.go();
        double speed = 0;
        for (int i = 0; i < 8; ++i) speed += run.scene->state.velocity[run.node(cube + i)].z / 8;
        if (one_way != 0) {
            EXPECT_NEAR(speed, -5e3, 1e-6) << "no node of the wide solid meets a face of the cube";
        } else {
            EXPECT_GT(speed, 1e3) << "it has bounced off";
        }
        EXPECT_LT(run.scene->ledger.balance_error(), 0.02);
    }
}

/// A soft brick is squeezed by a driven face to a twentieth of its height and let go: *CONTACT_INTERIOR
/// resists below a tenth with E A / h SLSFAC PSF and gives its energy back.
TEST(InteriorContact, ResistsBelowATenthOfTheHeight)
{
    DeckText deck;
    deck.text += "*CONTROL_TERMINATION\n1.0\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0e-3,0.0\n"
                 "*DEFINE_CURVE\n1\n0.0,0.0\n0.5,-1.9\n1.0,0.0\n*SET_PART_LIST\n9,2.0,0.0,300.0\n1\n*CONTACT_"
                 "INTERIOR\n9\n"
                 "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,2\n*DEFINE_CURVE\n2\n0.0,0.001\n9.0,0.001\n";
    deck.part(1, 1, 1);
    deck.block(1, {0, 0, 0}, {1, 1, 2}, 1, 1, 1);
    deck.text += "*SET_NODE_LIST\n1\n1,2,3,4\n*BOUNDARY_SPC_SET\n1,0,1,1,1\n"
                 "*SET_NODE_LIST\n2\n5,6,7,8\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,3,2,1\n";
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    const auto* term = run.find<InteriorContact>();
    ASSERT_NE(term, nullptr);
    EXPECT_EQ(term->items(), 3u);
    double peak = 0;
    run.watch([&](const Clock&, const State&) { peak = std::max(peak, term->energy()); });
    run.go();
    // k = 2 x 0.1 x 300 x 1 / 2 = 30; from 0.2 to 0.1 it takes k 0.1^2 / 2.
    EXPECT_NEAR(peak, 0.5 * 30 * 0.01, 0.02 * 0.15);
    EXPECT_NEAR(term->energy(), 0, 0.01 * peak);
}

} // namespace plash
