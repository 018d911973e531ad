#include "contact/surface_contact.h"
#include "tests/support/deck_run.h"

namespace plash {

namespace {

using testing::DeckRun;
using testing::DeckText;

/// Steel in t, mm, s: part 1 and 2 of shells `thickness` thick, or of solids where that is 0.
DeckText two_parts(double end, double thickness_1, double thickness_2)
{
    DeckText deck;
    deck.text += fmt::format("*CONTROL_TERMINATION\n{}\n", end);
    const double thickness[2] = {thickness_1, thickness_2};
    for (int i = 0; i < 2; ++i) {
        deck.text += thickness[i] > 0 ? fmt::format("*SECTION_SHELL\n{},2,0.833,3\n{},{},{},{}\n", i + 1,
                                                    thickness[i], thickness[i], thickness[i], thickness[i])
                                      : fmt::format("*SECTION_SOLID\n{},1\n", i + 1);
        deck.text += fmt::format("*MAT_ELASTIC\n{},7.85e-9,2.1e5,0.3\n", i + 1);
        deck.part(i + 1, i + 1, i + 1);
    }
    return deck;
}

std::string velocity_of_part(int part, const Vec3& v)
{
    return fmt::format("*INITIAL_VELOCITY_GENERATION\n{},2,0.0,{},{},{}\n0,0,0,0,0,0\n", part, v.x, v.y, v.z);
}

/// Which contact acts: its family, where it is not the plain automatic one, and SOFT (penalty, soft
/// constraint, segments on segments).
struct Variant {
    enum Family { plain, general, eroding, one_for_all };
    Family family = plain;
    int soft = 0;
};

std::string name_of(const Variant& variant)
{
    constexpr const char* families[] = {"", "General", "Eroding", "OneForAll"};
    return fmt::format("{}{}", families[variant.family], variant.soft);
}

std::string single_surface(const Variant& variant, const std::string& friction = "")
{
    switch (variant.family) {
    case Variant::general:
        return fmt::format("*CONTACT_AUTOMATIC_GENERAL_ID\n1,all\n0\n{}\n\n{}\n", friction, variant.soft);
    case Variant::eroding:
        return fmt::format("*CONTACT_ERODING_SINGLE_SURFACE_ID\n1,all\n0\n{}\n\n0,1,1\n{}\n", friction,
                           variant.soft);
    default:
        return fmt::format("*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID\n1,all\n0\n{}\n\n{}\n", friction,
                           variant.soft);
    }
}

/// Of the families that know one surface only: that of all parts.
std::string two_surfaces(const Variant& variant, int slave = 1, int master = 2,
                         const std::string& friction = "")
{
    switch (variant.family) {
    case Variant::general:
    case Variant::one_for_all:
        return single_surface(variant, friction);
    case Variant::eroding:
        return fmt::format("*CONTACT_ERODING_SURFACE_TO_SURFACE\n{},{},3,3\n{}\n\n0,1,1\n{}\n", slave, master,
                           friction, variant.soft);
    default:
        return fmt::format("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n{},{},3,3\n{}\n\n{}\n", slave, master,
                           friction, variant.soft);
    }
}

class ContactStability : public ::testing::TestWithParam<Variant> {};

/// The run ends in balance and nothing flies off faster than `fastest`.
void expect_calm(DeckRun& run, double fastest, double balance = 0.02)
{
    ASSERT_TRUE(run.scene);
    double speed = 0;
    run.watch([&](const Clock&, const State& state) {
        for (const Vec3& v : state.velocity) speed = std::max(speed, norm(v));
    });
    run.go();
    EXPECT_LT(speed, fastest);
    EXPECT_LT(run.scene->ledger.balance_error(), balance);
}

/// Runs a deck at whose end `count` nodes from `first` on still have their mean speed along x and their mean
/// height.
void expect_smooth_sliding(const std::string& deck, int first, int count, double speed, double height)
{
    DeckRun run(deck);
    expect_calm(run, 5e4, 0.005);
    double mean_speed = 0, rise = 0;
    for (int i = 0; i < count; ++i) {
        mean_speed += run.scene->state.velocity[run.node(first + i)].x / count;
        rise += (run.scene->state.position[run.node(first + i)].z - height) / count;
    }
    EXPECT_NEAR(mean_speed, speed, 0.005 * speed) << "nothing caught";
    EXPECT_NEAR(rise, 0, 1e-3) << "at most a twentieth of free fall";
}

} // namespace

/// Two sheets that cross at the start, at rest: they must stay as they are and not be blown apart.
TEST_P(ContactStability, ShellsThatCrossAtTheStartDoNotExplode)
{
    DeckText deck = two_parts(2e-4, 1, 1);
    deck.sheet(1, {0, 0, 0}, {50, 0, 0}, {0, 50, 0}, 10, 10);
    deck.sheet(2, {1.3, 22, -20.7}, {50, 0, 0}, {0, 5, 40}, 10, 10);
    deck.text += single_surface(GetParam());
    DeckRun run(deck.text);
    // A node that was freed from its depth of 0.5 by full penalty would leave with metres a second.
    expect_calm(run, 500);
}

/// A solid that stands in another, and sheets that cross at their very nodes.
TEST_P(ContactStability, BodiesThatOverlapAtTheStartDoNotExplode)
{
    for (const bool solid : {true, false}) {
        DeckText deck = two_parts(2e-4, solid ? 0 : 1, solid ? 0 : 1);
        if (solid) {
            deck.block(1, {0, 0, 0}, {20, 20, 10}, 4, 4, 2);
            deck.block(2, {6, 7, 7.5}, {14, 15, 17.5}, 3, 3, 3);
        } else {
            deck.sheet(1, {0, 0, 0}, {50, 0, 0}, {0, 50, 0}, 10, 10);
            deck.sheet(2, {0, 25, -25}, {50, 0, 0}, {0, 0, 50}, 10, 10);
        }
        deck.text += single_surface(GetParam());
        DeckRun run(deck.text);
        expect_calm(run, 500);
    }
}

/// They cross and move against one another at 20 m/s: still in balance, and the sheet at rest is pushed.
TEST_P(ContactStability, ShellsThatCrossAndMoveStayInBalance)
{
    DeckText deck = two_parts(5e-4, 1, 1);
    deck.sheet(1, {0, 0, 0}, {50, 0, 0}, {0, 50, 0}, 10, 10);
    deck.sheet(2, {1.3, 22, -20.7}, {50, 0, 0}, {0, 5, 40}, 10, 10);
    deck.text += single_surface(GetParam()) + velocity_of_part(2, {0, 3e3, -2e4});
    DeckRun run(deck.text);
    expect_calm(run, 2e5);
    double speed = 0;
    for (int i = 0; i < 121; ++i) speed += run.scene->state.velocity[run.node(1 + i)].z / 121;
    EXPECT_LT(speed, -2e3) << "what crosses it has taken it along";
}

/// A corner comes down exactly on the edge between four facets and on a corner of the mesh below.
TEST_P(ContactStability, NodesOnEdgesAndCornersBounce)
{
    for (const double shift : {0.0, 2.5}) { // of elements 5 long: on a node, on the middle of an edge
        DeckText deck = two_parts(1e-3, 0, 2);
        deck.sheet(2, {-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, 8, 8);
        deck.block(1, {shift, 0, 1.5}, {shift + 10, 10, 11.5}, 4, 4, 4);
        deck.text += two_surfaces(GetParam()) + velocity_of_part(1, {0, 0, -5e3});
        DeckRun run(deck.text);
        expect_calm(run, 5e4);
        double speed = 0;
        for (int i = 0; i < 125; ++i) speed += run.scene->state.velocity[run.node(82 + i)].z / 125;
        EXPECT_GT(speed, -1e3) << "the sheet has taken four fifths of its momentum";
    }
}

/// A block slides on its fixed base with a matching mesh: every node runs along rows of nodes and edges.
/// Frictionless, so it must keep its speed.
TEST_P(ContactStability, CoplanarSlidingIsSmooth)
{
    DeckText deck = two_parts(2e-3, 0, 0);
    deck.block(2, {0, 0, 0}, {60, 10, 5}, 24, 4, 2);
    const int first = deck.block(1, {5, 0, 5}, {15, 10, 10}, 4, 4, 2);
    deck.text += "*SET_NODE_LIST_GENERATE\n1\n1,375\n*BOUNDARY_SPC_SET\n1,0,1,1,1\n"
                 "*LOAD_BODY_Z\n1,1.0\n*DEFINE_CURVE\n1\n0.0,9.81e3\n1.0,9.81e3\n" +
                 two_surfaces(GetParam()) + velocity_of_part(1, {2e4, 0, 0});
    expect_smooth_sliding(deck.text, first, 75, 2e4, 7.5);
}

/// A corner of a block is driven into the corner of a room of three walls and comes out again.
TEST_P(ContactStability, CornerBetweenThreeSurfacesIsHeldAndReleased)
{
    DeckText deck = two_parts(1.5e-3, 0, 1);
    deck.sheet(2, {0, 0, 0}, {30, 0, 0}, {0, 30, 0}, 6, 6);
    deck.sheet(2, {0, 0, 0}, {0, 30, 0}, {0, 0, 30}, 6, 6);
    const int walls = deck.sheet(2, {0, 0, 0}, {0, 0, 30}, {30, 0, 0}, 6, 6) + 49;
    deck.text +=
        fmt::format("*SET_NODE_LIST_GENERATE\n1\n1,{}\n*BOUNDARY_SPC_SET\n1,0,1,1,1,1,1,1\n", walls - 1);
    const int first = deck.block(1, {1, 1, 1}, {11, 11, 11}, 2, 2, 2);
    deck.text += two_surfaces(GetParam()) + velocity_of_part(1, {-5e3, -5e3, -5e3});
    DeckRun run(deck.text);
    double least = 1e9;
    const Index corner = run.node(first);
    run.watch([&](const Clock&, const State& state) {
        const Vec3& x = state.position[corner];
        least = std::min({least, x.x, x.y, x.z});
    });
    expect_calm(run, 5e4);
    EXPECT_GT(least, 0) << "the corner stayed inside of all three walls";
    const Vec3& v = run.scene->state.velocity[corner];
    EXPECT_GT(v.x + v.y + v.z, 0) << "it is on its way out";
}

/// A ball between three solid walls, whose inner edges are convex to none of them.
TEST_P(ContactStability, BallBetweenThreeSolidWallsComesBack)
{
    DeckText deck = two_parts(1.5e-3, 0, 0);
    deck.block(2, {-10, -10, -10}, {30, 30, 0}, 8, 8, 2);
    deck.block(2, {-10, -10, 0}, {0, 30, 30}, 2, 8, 6);
    const int walls = deck.block(2, {0, -10, 0}, {30, 0, 30}, 6, 2, 6) + 7 * 3 * 7;
    deck.text += fmt::format("*SET_NODE_LIST_GENERATE\n1\n1,{}\n*BOUNDARY_SPC_SET\n1,0,1,1,1\n", walls - 1);
    const int first = deck.ball(1, {7, 7, 7}, 5, 4);
    deck.text += two_surfaces(GetParam()) + velocity_of_part(1, {-1e4, -1e4, -1e4});
    DeckRun run(deck.text);
    double least = 1e9;
    run.watch([&](const Clock&, const State& state) {
        for (int i = 0; i < 125; ++i) {
            const Vec3& x = state.position[run.node(first + i)];
            least = std::min({least, x.x, x.y, x.z});
        }
    });
    expect_calm(run, 1e5);
    EXPECT_GT(least, -0.5) << "a tenth of the walls' elements";
    const Vec3& v = run.scene->state.velocity[run.node(first + 62)];
    EXPECT_GT(v.x + v.y + v.z, 0) << "it is on its way out";
}

/// Two sheets of one mesh slide on one another, node over node, pressed by their weight: frictionless, they
/// keep their speed.
TEST_P(ContactStability, SheetsOfOneMeshSlide)
{
    DeckText deck = two_parts(1e-3, 1, 1);
    deck.sheet(2, {0, 0, 0}, {60, 0, 0}, {0, 20, 0}, 24, 8);
    const int first = deck.sheet(1, {5, 5, 1}, {25, 0, 0}, {0, 10, 0}, 10, 4);
    deck.text += "*SET_NODE_LIST_GENERATE\n1\n1,225\n*BOUNDARY_SPC_SET\n1,0,1,1,1,1,1,1\n"
                 "*LOAD_BODY_Z\n1,1.0\n*DEFINE_CURVE\n1\n0.0,9.81e4\n1.0,9.81e4\n" +
                 two_surfaces(GetParam()) + velocity_of_part(1, {2e4, 0, 0});
    expect_smooth_sliding(deck.text, first, 55, 2e4, 1);
}

/// Elements of 10 against elements of 1: momentum passes, no node of either side slips through.
TEST_P(ContactStability, MeshMismatchOfTenToOne)
{
    DeckText deck = two_parts(2e-4, 0, 0);
    const int coarse = deck.block(1, {0, 0, 0}, {20, 20, 10}, 2, 2, 1);
    const int fine = deck.block(2, {5.3, 5.4, 10.05}, {13.3, 13.4, 12.05}, 8, 8, 2);
    deck.text += two_surfaces(GetParam(), 2, 1) + velocity_of_part(2, {0, 0, -1e4});
    DeckRun run(deck.text);
    double deepest = 1e9;
    run.watch([&](const Clock&, const State& state) {
        double top = -1e9, bottom = 1e9;
        for (int i = 9; i < 18; ++i) top = std::max(top, state.position[run.node(coarse + i)].z);
        for (int i = 0; i < 81; ++i) bottom = std::min(bottom, state.position[run.node(fine + i)].z);
        deepest = std::min(deepest, bottom - top);
    });
    expect_calm(run, 1e5);
    EXPECT_GT(deepest, -1.0) << "less than one of the fine elements";
    EXPECT_GT(run.scene->state.velocity[run.node(fine + 100)].z, -1e4);
}

/// Shells 5 thick with elements of 2: the sheet must not touch itself, and two such sheets bounce at their
/// contact thickness.
TEST_P(ContactStability, ThicknessBeyondTheElementSize)
{
    DeckText deck = two_parts(1e-3, 5, 5);
    const int low = deck.sheet(1, {0, 0, 0}, {20, 0, 0}, {0, 20, 0}, 10, 10);
    const int high = deck.sheet(2, {1, 1, 6}, {18, 0, 0}, {0, 18, 0}, 9, 9);
    // SSTHK = 1: the full thickness also where the element is smaller.
    deck.text += "*CONTROL_CONTACT\n0.1\n0,0,0,0,0.0,1\n";
    deck.text += single_surface(GetParam()) + velocity_of_part(2, {0, 0, -3e3});
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    double at_rest = 0;
    const auto* contact = run.find<SurfaceContact>();
    run.watch([&](const Clock& clock, const State&) {
        if (clock.time < 5e-5) at_rest = std::max(at_rest, std::abs(contact->sliding_energy()));
    });
    expect_calm(run, 2e4);
    EXPECT_EQ(at_rest, 0) << "no force while the sheets are apart";
    EXPECT_GT(run.scene->state.velocity[run.node(high + 50)].z, -3e3 / 2) << "they have met";
    EXPECT_GT(run.scene->state.position[run.node(high + 50)].z,
              run.scene->state.position[run.node(low + 60)].z);
}

/// 1,000 m/s: a steel cube on a plate of shells; momentum is kept and the cube does not pass unseen.
TEST_P(ContactStability, ThousandMetresASecond)
{
    DeckText deck = two_parts(4e-5, 0, 3);
    deck.sheet(2, {-30, -30, 0}, {60, 0, 0}, {0, 60, 0}, 20, 20);
    const int cube = deck.block(1, {-5, -5, 1.6}, {5, 5, 11.6}, 4, 4, 4);
    deck.text += single_surface(GetParam()) + velocity_of_part(1, {0, 0, -1e6});
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    const double before = testing::Momenta(run.scene->state).linear.z;
    expect_calm(run, 4e6);
    const testing::Momenta after(run.scene->state);
    EXPECT_NEAR(after.linear.z, before, 1e-9 * std::abs(before));
    double slow = 0;
    for (int i = 0; i < 125; ++i) slow += run.scene->state.velocity[run.node(cube + i)].z / 125;
    EXPECT_GT(slow, -0.95e6) << "the plate has taken momentum";
}

/// Two blocks pressed together for 10,000 cycles: neither drift nor gain of energy.
TEST_P(ContactStability, PressedBlocksNeitherDriftNorGainEnergy)
{
    DeckText deck = two_parts(1, 0, 0);
    deck.text += "*CONTROL_TERMINATION\n1.0,10000\n";
    deck.block(1, {0, 0, 0}, {12, 12, 6}, 4, 4, 2);
    const int upper = deck.block(2, {1.2, 0.8, 6}, {10.7, 11.1, 12}, 3, 3, 2);
    deck.text += "*SET_NODE_LIST_GENERATE\n1\n1,25\n*BOUNDARY_SPC_SET\n1,0,1,1,1\n"
                 "*DEFINE_CURVE\n1\n0.0,0.0\n4.0e-4,-100.0\n1.0,-100.0\n*LOAD_NODE_SET\n2,3,1,1.0\n";
    deck.text += fmt::format("*SET_NODE_LIST_GENERATE\n2\n{},{}\n", upper + 32, upper + 47);
    deck.text += two_surfaces(GetParam(), 1, 2, "0.1,0.1,0.0,0.0,20.0");
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    std::vector<Vec3> place;
    std::vector<double> total;
    const Index watched = run.node(upper + 40);
    Scene* scene = run.scene.get();
    run.watch([&, scene](const Clock&, const State& state) {
        place.push_back(state.position[watched]);
        total.push_back(scene->ledger.kinetic + scene->ledger.internal);
    });
    run.go();
    ASSERT_GE(place.size(), 10000u);
    const auto mean = [&](std::size_t from, std::size_t to, auto&& value) {
        double sum = 0;
        for (std::size_t i = from; i < to; ++i) sum += value(i);
        return sum / static_cast<double>(to - from);
    };
    const double sag = std::abs(mean(8000, 10000, [&](std::size_t i) { return place[i].z - place[0].z; }));
    for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        const double early = mean(5000, 7500, [&](std::size_t i) { return place[i].*axis; });
        const double late = mean(7500, 10000, [&](std::size_t i) { return place[i].*axis; });
        EXPECT_NEAR(early, late, 0.01 * sag) << "of the sag under the load, " << sag;
    }
    const auto energy = [&](std::size_t i) { return total[i]; };
    EXPECT_LE(mean(7500, 10000, energy), 1.005 * mean(5000, 7500, energy));
    EXPECT_LT(run.scene->ledger.balance_error(), 0.005);
}

INSTANTIATE_TEST_SUITE_P(Soft, ContactStability,
                         ::testing::Values(Variant{Variant::plain, 0}, Variant{Variant::plain, 1},
                                           Variant{Variant::plain, 2}, Variant{Variant::general, 0},
                                           Variant{Variant::general, 1}, Variant{Variant::eroding, 0},
                                           Variant{Variant::eroding, 1}, Variant{Variant::eroding, 2},
                                           Variant{Variant::one_for_all, 0}, Variant{Variant::one_for_all, 1},
                                           Variant{Variant::one_for_all, 2}),
                         [](const auto& info) { return name_of(info.param); });

/// A ball bounces and rolls in a closed box of shells for 1e5 cycles and never gets out. The box is rigid and
/// fixed; friction makes the ball roll and slowly stop.
TEST(ContactInABox, BallStaysInItsBox)
{
    DeckText deck;
    deck.text +=
        "*CONTROL_TERMINATION\n1.0e9,100000\n*CONTROL_TIMESTEP\n0.0,0.67\n*CONTROL_HOURGLASS\n4,0.05\n"
        "*SECTION_SOLID\n1,1\n*SECTION_SHELL\n2,2,0.833,3\n0.5,0.5,0.5,0.5\n"
        "*MAT_ELASTIC\n1,1.0e-6,0.3,0.3\n*MAT_RIGID\n2,7.85e-6,210.0,0.3\n1.0,7,7\n\n";
    deck.part(1, 1, 1);
    deck.part(2, 2, 2);
    const double size = 30;
    for (int side = 0; side < 2; ++side) {
        const double at = side * size;
        deck.sheet(2, {0, 0, at}, {size, 0, 0}, {0, size, 0}, 3, 3);
        deck.sheet(2, {at, 0, 0}, {0, size, 0}, {0, 0, size}, 3, 3);
        deck.sheet(2, {0, at, 0}, {0, 0, size}, {size, 0, 0}, 3, 3);
    }
    const int first = deck.ball(1, {13, 16, 14}, 6, 2);
    deck.text += "*CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE_ID\n1,box\n1,2,3,3\n0.1,0.1\n\n1\n"
                 "*INITIAL_VELOCITY_GENERATION\n1,2,0.3,3.6,1.4,-2.4\n13,16,14,0.3,1.0,0.2\n";
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    double outermost = -1e9;
    const Index from = run.node(first);
    long hits = 0;
    bool touching = false;
    const auto* contact = run.find<SurfaceContact>();
    run.watch([&](const Clock&, const State& state) {
        for (Index node = from; node < from + 27; ++node) {
            const Vec3& x = state.position[node];
            for (double value : {x.x, x.y, x.z}) outermost = std::max({outermost, -value, value - size});
        }
        const bool now = contact->touches().size() > 0;
        hits += now && !touching;
        touching = now;
    });
    run.go();
    EXPECT_GE(run.outcome.clock.cycle, 99999);
    EXPECT_GT(hits, 20) << "it has bounced";
    EXPECT_LT(outermost, 0) << "no node has passed the middle plane of a wall";
    EXPECT_LT(run.scene->ledger.balance_error(), 0.02);
}

} // namespace plash
