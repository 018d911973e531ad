#include "rigid/rigid_bodies.h"

#include "output/glstat.h"
#include "tests/support/deck_run.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <omp.h>

namespace plash {

namespace {

/// A brick of eight masses with three different principal inertias.
State brick_state()
{
    State state;
    for (int corner = 0; corner < 8; ++corner) {
        state.position.push_back({corner & 1 ? 3.0 : 0.0, corner & 2 ? 2.0 : 0.0, corner & 4 ? 1.0 : 0.0});
    }
    state.velocity.resize(8);
    state.force.resize(8);
    state.mass.assign(8, 0.5);
    return state;
}

const std::vector<Index> corners_of_brick{0, 1, 2, 3, 4, 5, 6, 7};

} // namespace

/// Intermediate-axis tumbling without torque for 1e5 steps: angular momentum is kept exactly by construction,
/// energy must stay within 1e-6 (asked of rigid bodies; the midpoint rule has an error that oscillates but
/// does not drift).
TEST(RigidBodies, FreeTumblingKeepsEnergyAndAngularMomentum)
{
    State state = brick_state();
    const Vec3 center{1.5, 1, 0.5}, spin{0.01, 1.0, 0.005}; // y is the intermediate axis
    for (std::size_t i = 0; i < 8; ++i) state.velocity[i] = cross(spin, state.position[i] - center);
    Model model;
    model.parts.resize(1);
    RigidBody body = rigid_body_of(0, corners_of_brick, state.mass, {}, state, {});
    RigidBodies bodies(model, {{body}, {0}, {}, {}}, state);
    Clock clock;
    clock.step = 2e-3;
    const double energy = 0.5 * dot(body.angular_velocity, body.angular_momentum);
    double largest = 0, flips = 0, last = 1;
    for (int cycle = 0; cycle < 100000; ++cycle) {
        bodies.constrain(clock, state);
        for (std::size_t i = 0; i < 8; ++i) state.position[i] += clock.step * state.velocity[i];
        clock.last_step = clock.step;
        const RigidBody& now = bodies.bodies()[0];
        const double error = 0.5 * dot(now.angular_velocity, now.angular_momentum) / energy - 1;
        largest = std::max(largest, std::abs(error));
        const double along = now.orientation.row[1].y;
        if (along * last < 0) ++flips;
        if (along != 0) last = along;
    }
    EXPECT_GT(flips, 5) << "the brick must tumble, or the test shows nothing";
    EXPECT_LT(largest, 1e-6);
    const Vec3 momentum = bodies.bodies()[0].angular_momentum - body.angular_momentum;
    EXPECT_EQ(norm(momentum), 0);
    // The shape is kept: distances between nodes to round-off of 1e5 steps.
    EXPECT_NEAR(norm(state.position[7] - state.position[0]), std::sqrt(14.0), 1e-9);
}

/// Sums over the nodes go by chunks of fixed length: the same bits for any number of threads.
TEST(RigidBodies, ManyNodesGiveTheSameBitsForAnyNumberOfThreads)
{
    const auto center_after = [](int threads) {
        omp_set_num_threads(threads);
        State state;
        std::vector<Index> nodes;
        for (int i = 0; i < 9000; ++i) {
            state.position.push_back({std::sin(1.7 * i), std::cos(0.9 * i), 1e-3 * (i % 77)});
            nodes.push_back(i);
        }
        state.velocity.resize(nodes.size());
        state.force.resize(nodes.size());
        state.mass.assign(nodes.size(), 0.1);
        Model model;
        model.parts.resize(1);
        RigidBodies bodies(model, {{rigid_body_of(0, nodes, state.mass, {}, state, {})}, {0}, {}, {}}, state);
        Clock clock;
        clock.step = 1e-3;
        for (int cycle = 0; cycle < 50; ++cycle) {
            for (std::size_t i = 0; i < nodes.size(); ++i)
                state.force[i] = {std::sin(0.3 * cycle + i), 1 / (1.0 + i), std::cos(2.0 * i)};
            bodies.constrain(clock, state);
            for (std::size_t i = 0; i < nodes.size(); ++i)
                state.position[i] += clock.step * state.velocity[i];
            clock.last_step = clock.step;
        }
        const RigidBody& body = bodies.bodies()[0];
        return std::array{body.center.x,           body.center.y,
                          body.center.z,           body.orientation.row[0].y,
                          body.angular_velocity.z, state.velocity[8999].x};
    };
    const int usual = omp_get_max_threads();
    const auto one = center_after(1);
    EXPECT_EQ(one, center_after(2));
    EXPECT_EQ(one, center_after(3));
    omp_set_num_threads(usual);
    EXPECT_NE(one[3], 0);
}

TEST(RigidBodies, TorqueAboutAFixedAxisGivesTheKnownSpin)
{
    State state = brick_state();
    Model model;
    model.parts.resize(1);
    const FreedomMask only_z_rotation = 7 | 8 | 16;
    BodyFixity fixity;
    fixity.freedoms = only_z_rotation;
    RigidBody body = rigid_body_of(0, corners_of_brick, state.mass, {}, state, fixity);
    RigidBodies bodies(model, {{body}, {0}, {}, {}}, state);
    Clock clock;
    clock.step = 1e-3;
    for (int cycle = 0; cycle < 1000; ++cycle) {
        for (Vec3& force : state.force) force = {};
        const Vec3 arm = state.position[1] - state.position[0];
        const Vec3 across = unit(cross({0, 0, 1}, arm));
        state.force[1] = 2.0 * across;
        state.force[0] = -2.0 * across; // a couple of 2 x 3
        bodies.constrain(clock, state);
        for (std::size_t i = 0; i < 8; ++i) state.position[i] += clock.step * state.velocity[i];
        clock.last_step = clock.step;
    }
    // I_zz = 4 (1.5^2 + 1^2) = 13; omega = 6 t / 13 at t = n - 1/2 steps, exact for a constant couple.
    EXPECT_NEAR(bodies.bodies()[0].angular_velocity.z, 6.0 * 0.9995 / 13, 1e-9);
    EXPECT_EQ(bodies.bodies()[0].angular_velocity.x, 0);
}

namespace {

/// Keeps what glstat shows of the whole model's motion.
class GlobalVelocities : public Recorder {
public:
    explicit GlobalVelocities(std::vector<Vec3>& seen) : seen_(seen) {}
    double next_time() const override { return 0; }
    void write(const Snapshot& snapshot) override { seen_.push_back(global_statistics(snapshot).velocity); }

private:
    std::vector<Vec3>& seen_;
};

} // namespace

/// A cube at rest, one whose nodes are a nodal rigid body, and one of *MAT_RIGID that goes twice as fast: 3
/// bodies of one mass, 3 and 6 along x.
TEST(RigidBodies, CountInTheVelocityOfTheWholeModel)
{
    testing::DeckText deck;
    deck.text += "*CONTROL_TERMINATION\n1.0e-3\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,100.0,0.3\n"
                 "*MAT_RIGID\n2,1.0,100.0,0.3\n,\n,\n";
    deck.part(1, 1, 1);
    deck.part(2, 1, 1);
    deck.part(3, 1, 2);
    deck.block(1, {0, 0, 0}, {1, 1, 1}, 1, 1, 1);
    deck.block(2, {5, 0, 0}, {6, 1, 1}, 1, 1, 1);
    deck.block(3, {9, 0, 0}, {10, 1, 1}, 1, 1, 1);
    deck.text += "*SET_NODE_LIST_GENERATE\n1\n9,16\n*CONSTRAINED_NODAL_RIGID_BODY\n9,,1\n"
                 "*INITIAL_VELOCITY_GENERATION\n2,2,0.0,3.0,0.0,0.0\n0,0,0,0,0,0\n"
                 "3,2,0.0,6.0,0.0,0.0\n0,0,0,0,0,0\n";
    testing::DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    std::vector<Vec3> seen;
    Recorders recorders;
    recorders.push_back(std::make_unique<GlobalVelocities>(seen));
    const Outcome outcome = plash::run(*run.scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    ASSERT_FALSE(seen.empty());
    for (const Vec3& velocity : seen) EXPECT_NEAR(velocity.x, 3, 1e-12);
}

} // namespace plash
