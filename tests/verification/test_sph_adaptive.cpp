#include "contact/surface_contact.h"
#include "sph/particle_body.h"
#include "tests/support/adaptive_deck.h"
#include "tests/support/deck_run.h"

#include <gtest/gtest.h>

#include <numeric>

namespace plash {

namespace {

using testing::DeckRun;
using testing::DeckText;

double mass_of(const State& state)
{
    return std::accumulate(state.mass.begin(), state.mass.end(), 0.0);
}

/// A block of 4 x 4 x 4 mm that spins and flies, until all of it becomes particles.
std::string flying_block(int per_edge)
{
    DeckText deck;
    deck.text += testing::adaptive_steel(2e-3) + "*CONTROL_TERMINATION\n4e-3\n*CONTROL_SPH\n,,,,,12\n";
    deck.text += "*PART\nsteel\n1,1,2\n*PART\nparticles\n2,2,3\n";
    deck.text += fmt::format("*DEFINE_ADAPTIVE_SOLID_TO_SPH\n1,0,{},2,2\n", per_edge);
    deck.block(1, {0, 0, 0}, {4, 4, 4}, 4, 4, 4);
    deck.text += "*INITIAL_VELOCITY_GENERATION\n1,2,30,20,10,0\n2,2,2,0,0,1\n*END\n";
    return deck.text;
}

/// Mean velocity of the body at small x of the pulled bar over the second half of the run, over that of all.
struct Bar {
    double followed = 0, balance = 0;
};
Bar pull(const std::string& coupling)
{
    constexpr double end_time = 0.05;
    DeckRun run(testing::pulled_bar(coupling, 1e-9, end_time));
    const State& state = run.scene->state;
    double sum = 0, all = 0;
    run.watch([&](const Clock& clock, const State&) {
        if (clock.time < 0.5 * end_time) return;
        double mass = 0, momentum = 0;
        for (int node = 0; node < 13 * 16; ++node) {
            if (node % 13 > 4) continue;
            const Index index = run.node(node + 1);
            mass += state.mass[index];
            momentum += state.mass[index] * state.velocity[index].x;
        }
        sum += clock.last_step * momentum / mass;
        all += clock.last_step * testing::Momenta(state).linear.x / mass_of(state);
    });
    run.go();
    return {sum / all, run.scene->ledger.balance_error()};
}

} // namespace

TEST(SphAdaptive, LatticesShareOutSolidsEvenly)
{
    const std::array<Index, 8> hexahedron{0, 1, 2, 3, 4, 5, 6, 7}, wedge{0, 1, 2, 3, 4, 4, 5, 5},
        tetrahedron{0, 1, 2, 3, 3, 3, 3, 3};
    const auto check = [](const std::array<Index, 8>& nodes, int per_edge, std::size_t count, int corners) {
        const auto weights = stand_in_weights(nodes, per_edge);
        ASSERT_EQ(weights.size(), count);
        std::array<double, 8> share{};
        for (const auto& point : weights)
            for (int i = 0; i < 8; ++i) share[nodes[i]] += point[i] / static_cast<double>(count);
        for (int i = 0; i < corners; ++i) EXPECT_NEAR(share[i], 1.0 / corners, 1e-14);
    };
    check(hexahedron, 1, 1, 8);
    check(hexahedron, 2, 8, 8);
    check(hexahedron, 3, 27, 8);
    check(wedge, 1, 1, 6);
    check(wedge, 2, 6, 6);
    check(wedge, 3, 18, 6);
    check(tetrahedron, 1, 1, 4);
    check(tetrahedron, 2, 4, 4);
    check(tetrahedron, 3, 10, 4);
}

TEST(SphAdaptive, ParticlesTakeMassMomentumAndEnergyOfTheirSolids)
{
    for (const int per_edge : {1, 2}) {
        DeckRun run(flying_block(per_edge));
        const double mass = 64 * testing::steel_density;
        const Vec3 momentum = mass * Vec3{20, 10, 0};
        bool eroded = false;
        run.watch([&](const Clock&, const State& state) {
            EXPECT_NEAR(mass_of(state), mass, 1e-12 * mass);
            EXPECT_LT(norm(testing::Momenta(state).linear - momentum), 1e-12 * norm(momentum));
            eroded = state.deletions > 0;
        });
        run.go();
        EXPECT_TRUE(eroded);
        EXPECT_EQ(run.find<ParticleBody>()->items(), per_edge == 1 ? 64u : 512u);
        // Spin within a solid of one particle is lost, with two along an edge a quarter of it, and booked.
        const EnergyLedger& ledger = run.scene->ledger;
        const double spin = 0.5 * mass * 900 / 6; // of 64 cubes of 1 mm with their masses at the corners
        EXPECT_GT(ledger.eroded_kinetic, 0);
        EXPECT_LT(ledger.eroded_kinetic, 3.1 * spin);
        EXPECT_NEAR(ledger.eroded_internal, 0, 1e-5 * ledger.kinetic); // the start of their forces
        EXPECT_LT(ledger.balance_error(), 1e-3);
    }
}

TEST(SphAdaptive, BondsPullAlongWhatDebrisLeavesBehind)
{
    const Bar debris = pull("0"), bonded = pull("1,1"), held = pull("1,0");
    EXPECT_NEAR(debris.followed, 0.05, 0.01); // what the plane at x = 5 had at the start
    EXPECT_NEAR(bonded.followed, 1, 0.1);
    EXPECT_NEAR(held.followed, 1, 0.1);
    EXPECT_LT(debris.balance, 1e-4);
    EXPECT_LT(bonded.balance, 0.005);
    EXPECT_LT(held.balance, 0.005);
}

TEST(SphAdaptive, BondedParticlesOutliveTheLastSolid)
{
    // First the slab, then all that it was bonded with.
    DeckRun run(testing::pulled_bar("1,1", 1e-9, 0.03, "*MAT_ADD_EROSION\n1,-1e9\n,,,,,,,0.01\n"));
    Vec3 first{};
    double farthest = 0;
    run.watch([&](const Clock& clock, const State& state) {
        const Vec3 now = testing::Momenta(state).linear;
        if (clock.cycle == 0) first = now;
        farthest = std::max(farthest, norm(now - first));
    });
    run.go();
    EXPECT_EQ(run.scene->state.deletions, 108);
    EXPECT_LT(farthest, 1e-12 * norm(first));
    EXPECT_LT(run.scene->ledger.balance_error(), 0.01);
}

TEST(SphAdaptive, DebrisBouncesOffSurfacesAndWalls)
{
    for (const bool plate : {false, true}) {
        DeckText deck;
        deck.text += testing::adaptive_steel(5e-3) + "*CONTROL_TERMINATION\n0.08\n";
        deck.text += "*PART\nsteel\n1,1,2\n*PART\nparticles\n2,2,3\n*PART\nplate\n3,3,4\n";
        deck.text += "*SECTION_SHELL\n3,2\n0.2\n*MAT_RIGID\n4,7.85e-6,200,0.3\n1,7,7\n";
        deck.text += "*DEFINE_ADAPTIVE_SOLID_TO_SPH\n1,0,1,2,2\n";
        deck.block(1, {0, 0, 1}, {3, 3, 4}, 3, 3, 3);
        deck.sheet(3, {-3, -3, -0.1}, {9, 0, 0}, {0, 9, 0}, 6, 6);
        deck.text += "*INITIAL_VELOCITY_GENERATION\n1,2,0,0,0,-50\n\n";
        deck.text += plate ? "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n2,3,3,3\n\n\n"
                           : "*RIGIDWALL_PLANAR\n0\n0,0,0,0,0,1\n";
        deck.text += "*END\n";
        DeckRun run(deck.text);
        double lowest = 1, rising = 0;
        run.watch([&](const Clock&, const State& state) {
            rising = 0;
            for (Index node : run.scene->model.particles.node) {
                if (state.mass[node] == 0) continue;
                lowest = std::min(lowest, state.position[node].z);
                rising += state.mass[node] * state.velocity[node].z;
            }
        });
        run.go();
        EXPECT_GT(lowest, -0.15) << "plate " << plate;
        EXPECT_GT(rising, -0.05 * 27 * testing::steel_density * 50) << "plate " << plate;
    }
}

TEST(SphAdaptive, SolidsWhoseNeighboursTookTheMassStayStable)
{
    // Every other solid goes: cubes that are left alone bear 0.73 of the step that they had in the mesh.
    DeckText deck;
    deck.text += testing::adaptive_steel(1e-3) + "*CONTROL_TERMINATION\n0.1\n";
    deck.text += "*PART\nleft\n1,1,1\n*PART\ngone\n2,1,2\n*PART\nparticles\n3,2,3\n";
    deck.text += "*DEFINE_ADAPTIVE_SOLID_TO_SPH\n2,0,1,3,2\n";
    deck.block(1, {0, 0, 0}, {4, 4, 4}, 4, 4, 4);
    const auto elements = deck.text.find("*ELEMENT_SOLID");
    for (int i = 0; i < 64; ++i) {
        if ((i + i / 4 + i / 16) % 2 == 0) continue;
        const std::string before = fmt::format("\n{},1,", i + 1);
        deck.text.replace(deck.text.find(before, elements), before.size(), fmt::format("\n{},2,", i + 1));
    }
    deck.text += "*INITIAL_VELOCITY_GENERATION\n1,2,5\n2,2,2,0,0,1\n*END\n";
    DeckRun run(deck.text);
    run.go();
    EXPECT_EQ(run.scene->state.deletions, 32);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
}

} // namespace plash
