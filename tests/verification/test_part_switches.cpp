// *DEFORMABLE_TO_RIGID_AUTOMATIC: parts that become rigid and deformable while the run goes on.

#include "rigid/rigid_bodies.h"
#include "tests/support/deck_run.h"
#include "tests/support/read_text.h"

#include <gtest/gtest.h>

#include <random>

namespace plash {

namespace {

using testing::DeckRun;

/// An elastic block of 2 x 2 x 2 solids with a corner in `low`, part 1, that moves and turns. Fully
/// integrated, so that no hourglass forces of types that resist turning act on it.
std::string flying_block(const Vec3& low, const Vec3& velocity, double disorder, double end)
{
    testing::DeckText deck;
    deck.text += fmt::format("*CONTROL_TERMINATION\n{}\n*CONTROL_TIMESTEP\n0,0.8\n*PART\nblock\n1,1,1\n"
                             "*SECTION_SOLID\n1,2\n*MAT_ELASTIC\n1,1.0,100.0,0.3\n",
                             end);
    deck.block(1, low, low + Vec3{1, 1.2, 0.9}, 2, 2, 2);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> jitter(-disorder, disorder);
    deck.text += "*INITIAL_VELOCITY_NODE\n";
    for (int node = 0; node < deck.nodes; ++node) {
        const Vec3 place{0.5 * (node % 3), 0.6 * (node / 3 % 3), 0.45 * (node / 9)};
        const Vec3 v = velocity + cross(Vec3{0.2, -0.1, 0.3}, place);
        deck.text += fmt::format("{},{:.12g},{:.12g},{:.12g}\n", node + 1, v.x + jitter(random),
                                 v.y + jitter(random), v.z + jitter(random));
    }
    return deck.text;
}

/// A switch by time: D2R and R2D lines as they are given.
std::string switch_at(int number, double time, const std::string& to_rigid, const std::string& to_deformable)
{
    const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
    return fmt::format("*DEFORMABLE_TO_RIGID_AUTOMATIC\n{},0,{}\n0,0,0,0,{},{}\n{}{}", number, time,
                       lines(to_rigid), lines(to_deformable), to_rigid, to_deformable);
}

/// Sees nodes as they come into a cycle, before bodies move them on.
class Look : public Term {
public:
    explicit Look(std::function<void(const Clock&, const State&)> look) : look_(std::move(look)) {}
    std::string_view name() const override { return "look"; }
    void add_forces(const Clock& clock, State& state) override { look_(clock, state); }

private:
    std::function<void(const Clock&, const State&)> look_;
};

/// Largest change of the distances from the first node, against those of `start`.
double change_of_shape(const State& state, const std::vector<Vec3>& start)
{
    double largest = 0;
    for (std::size_t i = 1; i < start.size(); ++i)
        largest = std::max(largest,
                           std::abs(norm(state.position[i] - state.position[0]) - norm(start[i] - start[0])));
    return largest;
}

struct Sums {
    Vec3 momentum{}, angular{};
    double kinetic = 0;

    Sums(const State& state, const std::vector<double>& mass)
    {
        for (std::size_t i = 0; i < mass.size(); ++i) {
            momentum += mass[i] * state.velocity[i];
            angular += mass[i] * cross(state.position[i], state.velocity[i]);
            kinetic += 0.5 * mass[i] * dot(state.velocity[i], state.velocity[i]);
        }
    }
};

} // namespace

/// Rigid from the start until a switch that comes after the end, the block flies as one that is rigid
/// for good, to round-off; its elements have no stresses.
TEST(PartSwitches, RigidUntilLaterFliesAsRigidForGood)
{
    const std::string deck = flying_block({0, 0, 0}, {1, 0.5, -0.3}, 0, 2) +
                             "*CONTROL_TIMESTEP\n0,0.8,0,0,0,9\n*DEFINE_CURVE\n9\n0,0.01\n10,0.01\n"
                             "*DEFORMABLE_TO_RIGID\n1\n";
    DeckRun rigid(deck + "*END\n"), switched(deck + switch_at(1, 3, "", "1\n") + "*END\n");
    ASSERT_TRUE(rigid.scene && switched.scene);
    rigid.go();
    switched.go();
    ASSERT_EQ(rigid.outcome.clock.cycle, switched.outcome.clock.cycle);
    const State &one = rigid.scene->state, &other = switched.scene->state;
    for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_LT(norm(one.position[i] - other.position[i]), 1e-12) << i;
    EXPECT_GT(norm(one.position[0]), 1);
    EXPECT_EQ(switched.scene->ledger.internal, 0) << "elements are not looked at";
}

/// Set free at 1, the block stretches as it turns: omega^2 rho L^2 / E is 1e-3. Until then its elements rest.
TEST(PartSwitches, ElementsRestUntilTheirPartIsSetFree)
{
    const std::string deck = flying_block({0, 0, 0}, {1, 0.5, -0.3}, 0, 2) + "*DEFORMABLE_TO_RIGID\n1\n";
    DeckRun rigid(deck + "*CONTROL_TIMESTEP\n0,0.8,0,0,0,9\n*DEFINE_CURVE\n9\n0,0.01\n10,0.01\n*END\n");
    DeckRun freed(deck + "*CONTROL_TIMESTEP\n0,0.8,0,0,0,9\n*DEFINE_CURVE\n9\n0,0.01\n10,0.01\n" +
                  switch_at(1, 1, "", "1\n") + "*END\n");
    ASSERT_TRUE(rigid.scene && freed.scene);
    freed.watch([&](const Clock& clock, const State&) {
        if (clock.time < 1.0) {
            EXPECT_EQ(freed.scene->ledger.internal, 0) << clock.time;
        }
    });
    rigid.go();
    freed.go();
    const State &one = rigid.scene->state, &other = freed.scene->state;
    double apart = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
        apart = std::max(apart, norm(one.position[i] - other.position[i]));
    EXPECT_GT(apart, 1e-5);
    EXPECT_LT(apart, 2e-3);
    EXPECT_GT(freed.scene->ledger.internal, 0);
    EXPECT_LT(freed.scene->ledger.balance_error(), 1e-6);
}

/// A block that swings becomes rigid at 1, deformable at 2 and rigid at 3. Momenta stay what they are. At a
/// switch the motion of nodes past one another is lost, and booked: the body has the momentum P, the angular
/// momentum L = I omega and their energy. While it is rigid it keeps its shape and strain energy.
TEST(PartSwitches, MomentumAndEnergyAreKeptAcrossSwitches)
{
    DeckRun run(flying_block({0, 0, 0}, {1, 0.5, -0.3}, 0.3, 4) + switch_at(1, 1, "1\n", "") +
                switch_at(2, 2, "", "1\n") + switch_at(3, 3, "1\n", "") + "*END\n");
    ASSERT_TRUE(run.scene);
    const std::vector<double> mass = run.scene->state.mass;
    const Scene& scene = *run.scene;
    const auto* bodies = run.find<RigidBodies>();
    ASSERT_TRUE(bodies);
    std::vector<Vec3> shape;
    Vec3 spin_at_start{}; ///< angular momentum when the block became rigid
    std::optional<double> internal;
    double booked = 0, largest_change = 0, swing = 0;
    int begun = 0, rigid_cycles = 0;
    std::optional<Sums> first;
    run.scene->terms.push_back(std::make_unique<Look>([&](const Clock& clock, const State& state) {
        const Sums now(state, mass);
        if (clock.cycle == 1) first = now;
        const RigidBody& body = bodies->bodies().front();
        const bool rigid = !body.released;
        EXPECT_EQ(rigid, (clock.time >= 1 && clock.time < 2) || clock.time >= 3) << clock.time;
        if (clock.cycle < 1) return;
        EXPECT_LT(norm(now.momentum - first->momentum), 1e-11);
        if (!rigid) {
            if (!shape.empty()) { // set free: chords of arcs of 0.01 radians
                EXPECT_LT(norm(now.angular - spin_at_start), 1e-4 * norm(spin_at_start));
            }
            shape.clear();
            swing = std::max(swing, std::abs(scene.ledger.internal));
            return;
        }
        ++rigid_cycles;
        if (shape.empty()) { // the nodes still have the velocities of before
            ++begun;
            shape.assign(state.position.begin(), state.position.end());
            internal.reset(); // the ledger is a cycle behind
            Vec3 spin{};
            for (std::size_t i = 0; i < mass.size(); ++i) {
                const Vec3 arm = state.position[i] - body.center;
                spin += mass[i] * cross(arm, cross(body.angular_velocity, arm));
            }
            spin_at_start = now.angular;
            const Vec3 own = now.angular - cross(body.center, now.momentum);
            EXPECT_LT(norm(body.mass * body.velocity - now.momentum), 1e-12);
            EXPECT_LT(norm(spin - own), 1e-12);
            const double rest =
                0.5 * dot(body.velocity, now.momentum) + 0.5 * dot(body.angular_velocity, own);
            EXPECT_GT(now.kinetic - rest, 1e-4 * now.kinetic);
            double power = 0; // of the forces of this cycle, past those on the body
            for (std::size_t i = 0; i < mass.size(); ++i) {
                const Vec3 arm = state.position[i] - body.center;
                power += dot(state.force[i],
                             state.velocity[i] - body.velocity - cross(body.angular_velocity, arm));
            }
            booked += rest - now.kinetic - 0.5 * clock.last_step * power;
            return;
        }
        const Vec3 whole = body.angular_momentum + cross(body.center, body.mass * body.velocity);
        EXPECT_LT(norm(whole - spin_at_start), 1e-12);
        largest_change = std::max(largest_change, change_of_shape(state, shape));
        if (!internal) internal = scene.ledger.internal;
        EXPECT_NEAR(scene.ledger.internal, *internal, 1e-6 * swing);
    }));
    run.go();
    EXPECT_EQ(begun, 2);
    EXPECT_GT(rigid_cycles, 40);
    EXPECT_LT(largest_change, 1e-12);
    // When it is set free, its nodes go on along the chords of their arcs: second order in the step.
    EXPECT_NEAR(scene.ledger.external_work, booked, 2e-3 * std::abs(booked));
    DeckRun free(flying_block({0, 0, 0}, {1, 0.5, -0.3}, 0.3, 4) + "*END\n");
    free.go();
    EXPECT_LT(scene.ledger.balance_error(), 1.2 * free.scene->ledger.balance_error() + 1e-9)
        << "strains and steps that change; switches add nothing";
}

/// A block that is rigid until it meets a wall (CODE 3), deforms there, and is rigid again as soon as the
/// wall is free (CODE 1, the slave of the pair), and so the second time.
TEST(PartSwitches, WallMakesDeformableAndReboundRigid)
{
    DeckRun run(flying_block({0, 0, 0.05}, {0, 0, -1}, 0, 0.6) +
                "*CONTROL_TIMESTEP\n0,0.2\n*RIGIDWALL_PLANAR\n0\n0,0,0,0,0,1\n*DEFORMABLE_TO_RIGID\n1\n"
                "*DEFORMABLE_TO_RIGID_AUTOMATIC\n1,3,0,0,0,1,2,1\n0,0,0,0,0,1\n1\n"
                "*DEFORMABLE_TO_RIGID_AUTOMATIC\n2,1,0,0,0,1,1,-1\n0,0,0,0,1\n1\n*END\n");
    ASSERT_TRUE(run.scene);
    const auto* bodies = run.find<RigidBodies>();
    std::vector<bool> states;
    double deepest = 0;
    run.watch([&](const Clock& clock, const State& state) {
        const bool rigid = !bodies->bodies().front().released;
        if (states.empty() || states.back() != rigid) states.push_back(rigid);
        if (clock.time < 0.02) {
            EXPECT_TRUE(rigid);
        }
        for (const Vec3& place : state.position) deepest = std::min(deepest, place.z);
    });
    run.go();
    ASSERT_GE(states.size(), 3u);
    EXPECT_TRUE(states[0]);
    EXPECT_FALSE(states[1]);
    EXPECT_TRUE(states[2]);
    EXPECT_GT(run.scene->ledger.internal, 0);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-2) << "plastic impacts of nodes";
    EXPECT_GT(deepest, -0.01);
}

/// The same between a contact that presses (CODE 4) and one that is free (CODE 2): the block falls on a plate
/// that is held. Without friction and with springs the rebound gives all back but what the switch to rigid
/// takes of its vibrations.
TEST(PartSwitches, ContactMakesDeformableAndReboundRigid)
{
    std::string plate =
        "*PART\nplate\n2,2,2\n*SECTION_SOLID\n2,1\n*MAT_RIGID\n2,1.0,100.0,0.3\n1,7,7\n*NODE\n";
    for (int n = 0; n < 8; ++n)
        plate += fmt::format("{},{},{},{}\n", 101 + n, n % 4 == 0 || n % 4 == 3 ? -1 : 2, n % 4 < 2 ? -1 : 2,
                             n < 4 ? -1 : 0);
    plate += "*ELEMENT_SOLID\n101,2,101,102,103,104,105,106,107,108\n"
             "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n5\n1,2,3,3\n\n\n";
    DeckRun run(flying_block({0, 0, 0.05}, {0, 0, -1}, 0, 1.5) + "*CONTROL_TIMESTEP\n0,0.2\n" + plate +
                "*DEFORMABLE_TO_RIGID\n1\n"
                "*DEFORMABLE_TO_RIGID_AUTOMATIC\n1,4,0,0,0,5,2,1\n0,0,0,0,0,1\n1\n"
                "*DEFORMABLE_TO_RIGID_AUTOMATIC\n2,2,0,0,0,5,1,-1\n0,0,0,0,1\n1\n*END\n");
    ASSERT_TRUE(run.scene);
    const auto* bodies = run.find<RigidBodies>();
    std::vector<bool> states;
    double first_free = 0;
    run.watch([&](const Clock& clock, const State&) {
        const auto& all = bodies->bodies();
        const bool rigid =
            std::none_of(all.begin(), all.end(), [](const RigidBody& body) { return body.released; });
        if (states.empty() || states.back() != rigid) states.push_back(rigid);
        if (!rigid && first_free == 0) first_free = clock.time;
    });
    run.go();
    ASSERT_GE(states.size(), 3u);
    EXPECT_TRUE(states[0]);
    EXPECT_FALSE(states[1]);
    EXPECT_TRUE(states[2]);
    EXPECT_NEAR(first_free, 0.05, 0.02); // 0.05 above the plate at a speed of 1, less what turning adds
    EXPECT_GT(run.scene->ledger.internal, 0);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-2);
}

TEST(PartSwitches, RefuseWhatCannotBe)
{
    const std::string deck = flying_block({0, 0, 0}, {1, 0, 0}, 0, 1);
    const auto complaint = [&](const std::string& cards) {
        return testing::complaint_about(deck + cards + "*END\n");
    };
    const auto says = [&](const std::string& cards, const char* wanted) {
        EXPECT_NE(complaint(cards).find(wanted), std::string::npos) << complaint(cards);
    };
    says(switch_at(1, 0, "1\n", "") + "*BOUNDARY_SPC_NODE\n1,0,1\n", "node 1 is held or driven");
    says(switch_at(1, 0, "1,2\n", ""), "field LRB: part 2");
    says("*DEFORMABLE_TO_RIGID_AUTOMATIC\n1,3,0,0,0,4\n0,0,0,0,1\n1\n", "field ENTNO: 4");
    says("*DEFORMABLE_TO_RIGID_AUTOMATIC\n1,5\n0,0,0,0,1\n1\n", "field CODE: 5");
    says("*DEFORMABLE_TO_RIGID_AUTOMATIC\n1,0,0,0,0,0,7,1\n0,0,0,0,1\n1\n", "field RELSW");
    says("*DEFORMABLE_TO_RIGID_AUTOMATIC\n1,0\n0,0,1,0,1\n1\n", "field RWF");
}

} // namespace plash
