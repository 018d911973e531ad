#include "contact/edge_contact.h"
#include "solver/explicit_loop.h"
#include "tests/support/contact_model.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

using testing::ContactModel;
using testing::FixedStep;
using testing::Springs;
using testing::Watch;

/// Two round beams, each of two elements in a row, that cross at right angles and meet in the middle.
struct CrossedBeams {
    ContactModel mesh;
    std::vector<Index> low, high;

    CrossedBeams(double angle, double shift)
    {
        const Index part = mesh.add_part(1.0, 100, 0);
        mesh.model.sections[0] = Record();
        mesh.model.sections[0].keyword = "SECTION_BEAM";
        const auto number = [](const char* name, double value) {
            Record::Field field;
            field.name = name;
            field.value = value;
            return field;
        };
        mesh.model.sections[0].fields = {number("ELFORM", 1), number("CST", 1), number("TS1", 0.4),
                                         number("TT1", 0)};
        for (int i = 0; i < 3; ++i) low.push_back(mesh.add_node({2.0 * i - 2 + shift, 0, 0}));
        for (int i = 0; i < 3; ++i) {
            const double x = 2.0 * i - 2;
            high.push_back(mesh.add_node({x * std::cos(angle), x * std::sin(angle), 0.6}));
        }
        for (const auto& beam : {low, high}) {
            for (int i = 0; i < 2; ++i) {
                mesh.model.beams.id.push_back(static_cast<Id>(mesh.model.beams.size()) + 1);
                mesh.model.beams.part.push_back(part);
                mesh.model.beams.nodes.push_back({beam[i], beam[i + 1], none});
            }
        }
        Contact contact;
        contact.id = 1;
        contact.kind = Contact::Kind::general;
        contact.edges = true;
        contact.slave.kind = ContactSide::Kind::all;
        mesh.model.contacts.push_back(contact);
        mesh.model.controls.time.step_scale = 1;
        mesh.model.controls.time.end_time = 6;
    }
};

} // namespace

TEST(EdgeContact, ClosestPointsOfSegments)
{
    const EdgePoints cross = closest_points({-1, 0, 0}, {3, 0, 0}, {0, -1, 1}, {0, 4, 1});
    EXPECT_DOUBLE_EQ(cross.s, 0.25);
    EXPECT_DOUBLE_EQ(cross.t, 0.2);
    const EdgePoints apart = closest_points({0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0});
    EXPECT_DOUBLE_EQ(apart.s, 1);
    EXPECT_DOUBLE_EQ(apart.t, 0);
    const EdgePoints parallel = closest_points({0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {3, 1, 0});
    EXPECT_DOUBLE_EQ(parallel.s, 0.5) << "the middle of the overlap";
    EXPECT_DOUBLE_EQ(parallel.t, 0.5);
}

/// Beams of radius 0.2 that come together across one another bounce at a distance of 0.4, keep momentum and
/// angular momentum, and give the sliding energy back, whether they meet between nodes or just at them.
TEST(EdgeContact, CrossedBeamsBounce)
{
    for (const double shift : {0.7, 0.0}) {
        for (const double angle : {1.5707963, 0.9}) {
            CrossedBeams set(angle, shift);
            State state = set.mesh.state();
            for (Index node : set.high) state.velocity[node] = {0, 0, -0.5};
            Scene scene{set.mesh.model, std::move(state), {}, {}, 0, {}};
            auto springs = std::make_unique<Springs>();
            for (const auto& beam : {set.low, set.high}) {
                for (int i = 0; i < 2; ++i) springs->add(set.mesh.model, beam[i], beam[i + 1], 50);
                springs->add(set.mesh.model, beam[0], beam[2], 50);
            }
            scene.terms.push_back(std::move(springs));
            scene.terms.push_back(std::make_unique<FixedStep>(0.002));
            scene.terms.push_back(std::make_unique<EdgeContact>(set.mesh.model.contacts[0], set.mesh.model,
                                                                part_data(set.mesh.model)));
            const auto& contact = static_cast<const EdgeContact&>(*scene.terms[2]);
            EXPECT_EQ(contact.edges().size(), 4u);
            // The beams go on swinging, so some pairs meet again: the energy counts whenever they are apart.
            double first = 0, peak = 0, apart = 0;
            int partings = 0;
            std::size_t most = 0, before = 0;
            scene.terms.push_back(std::make_unique<Watch>([&](const Clock&, const State& now) {
                const std::size_t touches = contact.touches().size();
                if (first == 0 && touches > 0) first = now.position[set.high[1]].z;
                peak = std::max(peak, contact.sliding_energy());
                most = std::max(most, touches);
                if (before > 0 && touches == 0) ++partings;
                if (touches == 0) apart = std::max(apart, std::abs(contact.sliding_energy()));
                before = touches;
            }));
            Recorders nothing;
            const Outcome outcome = run(scene, nothing);
            EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
            EXPECT_NEAR(first, 0.4, 0.003) << "one step is 0.001";
            EXPECT_EQ(most, 1u) << "ends that go on count once";
            EXPECT_GT(peak, 0.001);
            EXPECT_GT(partings, 0);
            EXPECT_LT(apart, 0.01 * peak);
            Vec3 momentum{};
            for (std::size_t i = 0; i < scene.state.size(); ++i) {
                momentum += scene.state.mass[i] * scene.state.velocity[i];
            }
            double mass = 0;
            for (Index node : set.high) mass += scene.state.mass[node];
            EXPECT_NEAR(momentum.z, -0.5 * mass, 1e-12);
            EXPECT_LT(scene.ledger.balance_error(), 2e-3);
        }
    }
}

/// Free sides of two sheets that hit edge to edge, where no node meets a facet.
TEST(EdgeContact, FreeSidesOfSheetsMeet)
{
    ContactModel mesh;
    const Index part = mesh.add_part(1.0, 100, 0.2);
    const Index flat = mesh.add_sheet(part, 2, 2, [](double u, double v) { return Vec3{3 * u, 3 * v, 0}; });
    const Index upright = mesh.add_sheet(part, 2, 2, [](double u, double v) {
        return Vec3{0.7 + 1.1 * u, -0.25 - v, 1.4 * u - 0.7};
    });
    Contact contact;
    contact.kind = Contact::Kind::general;
    contact.edges = true;
    contact.slave.kind = ContactSide::Kind::all;
    contact.limit_thickness = false;
    mesh.model.contacts.push_back(contact);
    State state = mesh.state();
    for (Index i = 0; i < 9; ++i) state.velocity[upright + i] = {0, 1, 0};
    EdgeContact edges(mesh.model.contacts[0], mesh.model, part_data(mesh.model));
    EXPECT_EQ(edges.edges().size(), 24u) << "12 sides a sheet, 8 of them free";
    Clock clock;
    edges.add_forces(clock, state);
    EXPECT_TRUE(edges.touches().empty());
    clock.last_step = 0.01;
    Vec3 sum{};
    for (int cycle = 0; cycle < 8; ++cycle) {
        for (std::size_t i = 0; i < state.size(); ++i)
            state.position[i] += clock.last_step * state.velocity[i];
        state.clear_forces();
        edges.add_forces(clock, state);
    }
    ASSERT_EQ(edges.touches().size(), 1u);
    // 0.25 - 0.08 = 0.17 apart, thickness 0.2: 0.03 deep.
    EXPECT_NEAR(edges.touches()[0].penetration, 0.03, 1e-12);
    // From the second edge to the first, which is that of the flat sheet.
    EXPECT_NEAR(edges.touches()[0].normal.y, 1, 1e-12);
    Vec3 on_flat{};
    for (Index i = 0; i < 9; ++i) on_flat += state.force[flat + i];
    for (const Vec3& force : state.force) sum += force;
    EXPECT_NEAR(norm(sum), 0, 1e-14);
    EXPECT_GT(on_flat.y, 0);
}

/// Two surfaces whose sheets meet edge to edge: with SOFT = 2 and DEPTH = 5 they bounce, and what one gets
/// the other gives; where only corners are looked at they pass through one another.
TEST(EdgeContact, SurfacesMeetAtTheirEdges)
{
    for (const bool with_edges : {true, false}) {
        ContactModel mesh;
        const Index lower = mesh.add_part(1.0, 100, 0.2), upper = mesh.add_part(1.0, 100, 0.2);
        const Index flat = mesh.add_sheet(lower, 2, 2, [](double u, double v) {
            return Vec3{3 * u, 3 * v, 0};
        });
        const Index upright = mesh.add_sheet(upper, 2, 2, [](double u, double v) {
            return Vec3{0.7 + 1.1 * u, -0.25 - v, 1.4 * u - 0.35};
        });
        Contact contact;
        contact.kind = Contact::Kind::two_way;
        contact.edges = with_edges;
        contact.soft = 2;
        contact.slave.kind = contact.master.kind = ContactSide::Kind::parts;
        contact.slave.parts = {lower};
        contact.master.parts = {upper};
        contact.limit_thickness = false;
        mesh.model.contacts.push_back(contact);
        mesh.model.controls.time.step_scale = 0.9;
        mesh.model.controls.time.end_time = 1.5;
        Scene scene = make_scene(mesh.model);
        for (Index i = 0; i < 9; ++i) scene.state.velocity[upright + i] = {0, 1, 0};
        double largest = 0;
        const std::vector<std::unique_ptr<Term>>& terms = scene.terms;
        scene.terms.push_back(std::make_unique<Watch>([&](const Clock&, const State& state) {
            ElementResults results;
            for (const auto& term : terms) term->collect(state, results);
            ASSERT_EQ(results.contacts.size(), 1u);
            const auto& sum = results.contacts[0];
            EXPECT_NEAR(norm(sum.slave_force + sum.master_force), 0, 1e-14);
            largest = std::max(largest, sum.slave_force.y);
        }));
        Recorders recorders;
        ASSERT_EQ(run(scene, recorders).termination, Outcome::Termination::normal);
        double pushed = 0, whole = 0;
        for (Index i = 0; i < 9; ++i) {
            pushed += scene.state.mass[flat + i] * scene.state.velocity[flat + i].y;
            whole += scene.state.mass[upright + i] * scene.state.velocity[upright + i].y;
        }
        whole += pushed;
        if (with_edges) {
            EXPECT_GT(pushed, 0.3 * whole);
            EXPECT_GT(largest, 0);
            EXPECT_LT(scene.ledger.balance_error(), 5e-3);
        } else {
            EXPECT_EQ(pushed, 0);
        }
    }
}

} // namespace plash
