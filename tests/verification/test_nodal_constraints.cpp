// Linear constraints and interpolations between nodes.

#include "rigid/interpolation.h"
#include "rigid/linear_constraints.h"
#include "solver/motion.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// Nodes with masses and a forces-to-motion cycle like the loop's.
struct Points {
    Model model;
    State state;
    Clock clock;

    Index add(const Vec3& place, double mass)
    {
        state.position.push_back(place);
        state.velocity.push_back({});
        state.force.push_back({});
        state.mass.push_back(mass);
        model.nodes.id.push_back(static_cast<Id>(state.position.size()));
        model.nodes.position.push_back(place);
        return static_cast<Index>(state.position.size()) - 1;
    }
    /// Rows of (node number, freedom, coefficient).
    void constrain_linearly(std::vector<std::array<double, 3>> rows)
    {
        Record record = make_record("CONSTRAINED_LINEAR_GLOBAL", {{"LCID", 1}});
        Table table;
        table.columns = {"NID", "DOF", "COEF"};
        for (const auto& row : rows) {
            table.values.insert(table.values.end(), row.begin(), row.end());
            table.lines.push_back(1);
        }
        record.tables.push_back(table);
        model.others.push_back(record);
    }
};

/// A force that changes from node to node and cycle to cycle.
Vec3 push(int cycle, int node)
{
    return {std::sin(0.1 * cycle + node), std::cos(0.3 * cycle * node), 0.2 * node};
}

} // namespace

/// u1 - 2 u2 + u3 = 0 in x and a chain that shares node 3; a redundant copy of the first. Sums of velocities
/// vanish to round-off, and the kinetic energy is the work of the applied forces: constraints do none.
TEST(LinearConstraints, HoldAndDoNoWork)
{
    Points points;
    for (int i = 0; i < 4; ++i) points.add({1.0 * i, 0, 0}, 1.0 + i);
    points.constrain_linearly({{1, 1, 1}, {2, 1, -2}, {3, 1, 1}});
    points.constrain_linearly({{3, 1, 1}, {4, 1, 0.5}, {4, 2, 1}});
    points.constrain_linearly({{1, 1, 2}, {2, 1, -4}, {3, 1, 2}});
    State& state = points.state;
    LinearConstraints constraints(points.model, state);
    points.clock.step = 0.01;
    double work = 0, kinetic = 0;
    std::vector<Vec3> last(4);
    for (int cycle = 0; cycle < 500; ++cycle) {
        for (int i = 0; i < 4; ++i) {
            state.force[i] = push(cycle, i);
            work += 0.5 * points.clock.last_step * dot(state.force[i] + last[i], state.velocity[i]);
            last[i] = state.force[i];
        }
        constraints.constrain(points.clock, state);
        kinetic = advance_velocities(points.clock, state);
        ASSERT_NEAR(state.velocity[0].x - 2 * state.velocity[1].x + state.velocity[2].x, 0, 1e-12);
        ASSERT_NEAR(state.velocity[2].x + 0.5 * state.velocity[3].x + state.velocity[3].y, 0, 1e-12);
        points.clock.last_step = points.clock.step;
    }
    // Equal up to the difference of start values of the two books, both exact for the discrete motion: the
    // kinetic energy at n = 0 is -m v(1/2)^2 / 2 for bodies at rest.
    EXPECT_GT(kinetic, 1);
    EXPECT_NEAR(work, kinetic, 1e-3 * kinetic);
}

/// A driven node pulls a chain u2 = 3 u1: external work is the kinetic energy of the second node.
TEST(LinearConstraints, DrivenFreedomPutsInTheWork)
{
    Points points;
    points.add({}, 1e9);
    points.add({1, 0, 0}, 2);
    points.constrain_linearly({{1, 1, 3}, {2, 1, -1}});
    PrescribedMotion motion;
    motion.nodes = {0};
    motion.direction = {1, 0, 0};
    points.model.prescribed_motions.push_back(motion);
    State& state = points.state;
    LinearConstraints constraints(points.model, state);
    points.clock.step = 1e-3;
    double initial = 0;
    for (int cycle = 0; cycle <= 1000; ++cycle) {
        // The drive: velocity t at mid-step, whatever it takes.
        const double target = points.clock.time + 0.5 * points.clock.step;
        state.force[0] = {1e9 * (target - state.velocity[0].x) / points.clock.velocity_step(), 0, 0};
        state.force[1] = {};
        constraints.constrain(points.clock, state);
        const double before = state.velocity[1].x;
        advance_velocities(points.clock, state);
        EnergyLedger ledger;
        ledger.open_cycle(0);
        constraints.report(ledger);
        const double after = state.velocity[1].x, old = cycle == 0 ? 2 * before - after : before;
        const double kinetic = 0.5 * 2 * old * after;
        if (cycle == 0) initial = kinetic - ledger.external_work;
        ASSERT_NEAR(state.velocity[1].x, 3 * target, 1e-9);
        ASSERT_NEAR(kinetic - ledger.external_work, initial, 1e-9);
        points.clock.time += points.clock.step;
        points.clock.last_step = points.clock.step;
    }
}

TEST(NodeSets, ShareTheAccelerationOfTheirMass)
{
    Points points;
    for (int i = 0; i < 5; ++i) points.add({1.0 * i, 0, 0}, 1.0 + i);
    points.model.node_sets.push_back({7, "", {0, 1, 2, 3}, {}});
    points.model.others.push_back(
        make_record("CONSTRAINED_NODE_SET", {{"NSID", 7}, {"DOF", 4}, {"TF", 0.55}}));
    State& state = points.state;
    LinearConstraints constraints(points.model, state);
    points.clock.step = 0.1;
    points.clock.last_step = 0.1;
    for (int i = 0; i < 5; ++i) state.force[i] = {1, 2, 3};
    constraints.constrain(points.clock, state);
    for (int i = 0; i < 4; ++i) { // total force (4, 8), total mass 10
        EXPECT_NEAR(state.force[i].x, 0.4 * state.mass[i], 1e-12);
        EXPECT_NEAR(state.force[i].y, 0.8 * state.mass[i], 1e-12);
        EXPECT_EQ(state.force[i].z, 3);
    }
    EXPECT_EQ(state.force[4].x, 1);
    points.clock.time = 0.6; // past TF
    for (int i = 0; i < 5; ++i) state.force[i] = {1, 2, 3};
    constraints.constrain(points.clock, state);
    EXPECT_EQ(state.force[1].x, 1);
}

/// What the dependent node feels arrives as the same force and moment; a rigid motion of the independent
/// nodes carries it along exactly, a stretch moves it by the mean.
TEST(Interpolations, HandOnForceAndMomentAndFollowRigidMotion)
{
    Points points;
    const Vec3 corners[] = {{0, 0, 0}, {2, 0, 0.1}, {2, 1, 0}, {0, 1, -0.2}, {1, 0.5, 0.7}};
    for (const Vec3& corner : corners) points.add(corner, 1);
    const Index dependent = points.add({1.5, 0.2, 0.4}, 0.5);
    Record record = make_record("CONSTRAINED_INTERPOLATION", {{"ICID", 1}, {"DNID", 6}, {"DDOF", 123}});
    Table table;
    table.columns = {"INID", "IDOF", "TWGHTX", "TWGHTY", "TWGHTZ", "RWGHTX", "RWGHTY", "RWGHTZ"};
    for (double node : {1, 2, 3, 4, 5}) {
        table.values.insert(table.values.end(), {node, 123, node == 2 ? 3.0 : 1.0, 0, 0, 0, 0, 0});
        table.lines.push_back(1);
    }
    record.tables.push_back(table);
    points.model.others.push_back(record);
    State& state = points.state;
    const Interpolations links(points.model, state);
    EXPECT_EQ(state.mass[dependent], 0);
    EXPECT_NEAR(state.mass[1], 1 + 0.5 * 3 / 7, 1e-15);

    state.force[dependent] = {3, -2, 5};
    const Vec3 moment = cross(state.position[dependent], state.force[dependent]);
    links.hand_forces_on(state);
    Vec3 sum{}, turning{};
    for (int i = 0; i < 6; ++i) {
        sum += state.force[i];
        turning += cross(state.position[i], state.force[i]);
    }
    EXPECT_LT(norm(sum - Vec3{3, -2, 5}), 1e-12);
    EXPECT_LT(norm(turning - moment), 1e-9);

    const Vec3 shift{0.3, 0.1, -0.2}, spin{0.5, -1, 2};
    for (int i = 0; i < 5; ++i) {
        state.velocity[i] = shift + cross(spin, state.position[i]);
        state.force[i] = {};
    }
    points.clock.step = 0.1;
    links.move_dependents(points.clock, state);
    EXPECT_LT(norm(state.velocity[dependent] - shift - cross(spin, state.position[dependent])), 1e-9);
}

} // namespace plash
