#include "contact/surface_contact.h"
#include "tests/support/deck_run.h"

#include <numbers>

/// Small decks of the kinds that crash engineers run, from reading to the end: the energy book stays within 2
/// %. A ball through a plate stands in tests/verification/test_contact_eroding.cpp, tubes in tests/decks.
namespace plash {

namespace {

using testing::DeckRun;
using testing::DeckText;

constexpr const char* steel =
    "*MAT_PIECEWISE_LINEAR_PLASTICITY\n1,7.85e-9,2.1e5,0.3,300.0,1000.0,{}\n0,0,0,0\n"
    "0,0,0,0,0,0,0,0\n0,0,0,0,0,0,0,0\n";

/// Shells along a line of points, drawn out along `way`; returns the first node. Points come first.
int drawn_out(DeckText& deck, int part, const std::vector<Vec3>& line, bool closed, const Vec3& way,
              int layers)
{
    const int first = deck.nodes + 1, count = static_cast<int>(line.size());
    deck.text += "*NODE\n";
    for (int layer = 0; layer <= layers; ++layer) {
        for (const Vec3& point : line) {
            const Vec3 x = point + (double(layer) / layers) * way;
            deck.text += fmt::format("{},{:.10g},{:.10g},{:.10g}\n", ++deck.nodes, x.x, x.y, x.z);
        }
    }
    deck.text += "*ELEMENT_SHELL\n";
    for (int layer = 0; layer < layers; ++layer) {
        for (int i = 0; i + (closed ? 0 : 1) < count; ++i) {
            const int a = first + layer * count + i, b = first + layer * count + (i + 1) % count;
            deck.text += fmt::format("{},{},{},{},{},{}\n", ++deck.shells, part, a, b, b + count, a + count);
        }
    }
    return first;
}

/// Points every `side` along straight lines between corners.
std::vector<Vec3> along(const std::vector<Vec3>& corners, double side)
{
    std::vector<Vec3> points{corners.front()};
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const Vec3 way = corners[i] - corners[i - 1];
        const int steps = static_cast<int>(std::lround(norm(way) / side));
        for (int step = 1; step <= steps; ++step)
            points.push_back(corners[i - 1] + (double(step) / steps) * way);
    }
    return points;
}

double momentum_z(const State& state)
{
    double sum = 0;
    for (std::size_t i = 0; i < state.size(); ++i) sum += state.mass[i] * state.velocity[i].z;
    return sum;
}

} // namespace

/// A square tube falls on its edge, tilted, onto a fixed table at 8 m/s: it dents and springs off.
TEST(StructuralDecks, BoxDropsOnATable)
{
    DeckText deck;
    deck.text +=
        "*CONTROL_TERMINATION\n5.0e-3\n*SECTION_SHELL\n1,2,0.833,5\n1.0,1.0,1.0,1.0\n*CONTROL_SHELL\n20,1\n" +
        fmt::format(fmt::runtime(steel), "0.0");
    deck.part(1, 1, 1);
    deck.part(2, 1, 1);
    std::vector<Vec3> ring = along({{0, -30, 44}, {0, 0, 2}, {0, 30, 44}, {0, 0, 86}, {0, -30, 44}}, 6);
    ring.pop_back(); // closed
    const Vec3 tilt{78, 0, 12};
    const int box = drawn_out(deck, 1, ring, true, tilt, 13);
    const int table = deck.sheet(2, {-20, -60, 0}, {120, 0, 0}, {0, 120, 0}, 20, 20);
    deck.text += "*SET_NODE_LIST\n1\n";
    for (int i = 0; i <= 20; ++i)
        deck.text +=
            fmt::format("{},{},{},{}\n", table + i, table + 420 + i, table + 21 * i, table + 21 * i + 20);
    deck.text +=
        "*BOUNDARY_SPC_SET\n1,0,1,1,1,1,1,1\n*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n0.2,0.2,0,0,20.0\n\n1\n"
        "*INITIAL_VELOCITY_GENERATION\n1,2,0.0,0.0,0.0,-8000.0\n0,0,0,0,0,0\n";
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    const Index low = run.node(box + 9);
    double lowest = 100;
    run.watch([&](const Clock&, const State& state) { lowest = std::min(lowest, state.position[low].z); });
    run.go();
    EXPECT_LT(lowest, 1.9) << "it has come down";
    EXPECT_GT(lowest, -30) << "and not gone through";
    EXPECT_GT(run.scene->ledger.internal, 0.2 * run.scene->ledger.initial_total) << "it is dented";
    EXPECT_LT(run.scene->ledger.balance_error(), 0.02);
}

/// A hat rail runs into a wall at 10 m/s with 40 kg behind it and folds.
TEST(StructuralDecks, HatRailFolds)
{
    DeckText deck;
    deck.text +=
        "*CONTROL_TERMINATION\n6.0e-3\n*SECTION_SHELL\n1,2,0.833,5\n1.5,1.5,1.5,1.5\n*CONTROL_SHELL\n20,1\n"
        "*CONTROL_HOURGLASS\n4,0.05\n" +
        fmt::format(fmt::runtime(steel), "0.0");
    deck.part(1, 1, 1);
    const std::vector<Vec3> hat =
        along({{-48, 0, 0.5}, {-24, 0, 0.5}, {-24, 40, 0.5}, {24, 40, 0.5}, {24, 0, 0.5}, {48, 0, 0.5}}, 8);
    const int first = drawn_out(deck, 1, hat, false, {0, 0, 200}, 25);
    const int count = static_cast<int>(hat.size());
    deck.text += "*ELEMENT_MASS\n";
    for (int i = 0; i < count; ++i)
        deck.text += fmt::format("{},{},{:.8g}\n", i + 1, first + 25 * count + i, 0.040 / count);
    deck.text +=
        fmt::format("*SET_NODE_LIST_GENERATE\n1\n{},{}\n", first + 25 * count, first + 26 * count - 1) +
        "*BOUNDARY_SPC_SET\n1,0,1,1,0,1,1,1\n*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n0.2,0.2,0,0,20.0\n\n\n"
        "*RIGIDWALL_PLANAR\n0,0,0\n0,0,0,0,0,1,0.2\n"
        "*INITIAL_VELOCITY_GENERATION\n1,2,0.0,0.0,0.0,-10000.0\n0,0,0,0,0,0\n";
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    const double before = momentum_z(run.scene->state);
    run.go();
    const double force = (momentum_z(run.scene->state) - before) / run.outcome.clock.time;
    // Between the squash force of a crippled wall and that of the section: 300 MPa x 176 mm x 1.5 mm = 79 kN.
    EXPECT_GT(force, 8e3);
    EXPECT_LT(force, 79e3);
    EXPECT_GT(run.scene->ledger.internal, 0.3 * run.scene->ledger.initial_total);
    EXPECT_LT(run.scene->ledger.hourglass, 0.1 * run.scene->ledger.internal);
    EXPECT_LT(run.scene->ledger.balance_error(), 0.02);
}

/// A rigid head of 8 mm radius is pulled through a sheet of 1 mm with a hole of 5 mm: the rim tears.
TEST(StructuralDecks, BoltHeadIsPulledOut)
{
    DeckText deck;
    deck.text +=
        "*CONTROL_TERMINATION\n4.0e-3\n*SECTION_SHELL\n1,2,0.833,3\n1.0,1.0,1.0,1.0\n*CONTROL_SHELL\n20,1\n" +
        fmt::format(fmt::runtime(steel), "0.15") + "*MAT_RIGID\n2,7.85e-9,2.1e5,0.3\n1.0,4,7\n\n";
    deck.part(1, 1, 1);
    deck.part(2, 1, 2);
    const auto circle = [](double radius, double z, int count) {
        std::vector<Vec3> points;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * i / count;
            points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
        }
        return points;
    };
    // Rings as layers: each further out than the one before.
    const auto rings = [&](int part, double z, double from, double to, int layers, int count) {
        const int first = deck.nodes + 1;
        deck.text += "*NODE\n";
        for (int layer = 0; layer <= layers; ++layer) {
            for (const Vec3& x : circle(from + (to - from) * layer / layers, z, count))
                deck.text += fmt::format("{},{:.10g},{:.10g},{:.10g}\n", ++deck.nodes, x.x, x.y, x.z);
        }
        deck.text += "*ELEMENT_SHELL\n";
        for (int layer = 0; layer < layers; ++layer) {
            for (int i = 0; i < count; ++i) {
                const int a = first + layer * count + i, b = first + layer * count + (i + 1) % count;
                deck.text +=
                    fmt::format("{},{},{},{},{},{}\n", ++deck.shells, part, a, a + count, b + count, b);
            }
        }
        return first;
    };
    const int sheet = rings(1, 0, 5, 29, 16, 32);
    rings(2, -1.05, 2, 8, 3, 24);
    deck.text +=
        fmt::format("*SET_NODE_LIST_GENERATE\n1\n{},{}\n", sheet + 16 * 32, sheet + 17 * 32 - 1) +
        "*BOUNDARY_SPC_SET\n1,0,1,1,1,1,1,1\n*CONTACT_ERODING_SINGLE_SURFACE\n0\n0.1,0.1\n\n0,1\n"
        "*DEFINE_CURVE\n1\n0.0,0.0\n4.0e-4,5000.0\n1.0,5000.0\n*BOUNDARY_PRESCRIBED_MOTION_RIGID\n2,3,0,1\n";
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    long deleted = 0;
    run.watch([&](const Clock&, const State& state) { deleted = state.deletions; });
    run.go();
    EXPECT_GT(deleted, 10) << "the rim has torn";
    EXPECT_GT(run.scene->ledger.external_work, 0);
    EXPECT_LT(run.scene->ledger.balance_error(), 0.02);
}

} // namespace plash
