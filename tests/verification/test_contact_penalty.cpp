#include "conditions/body_loads.h"
#include "contact/surface_contact.h"
#include "solver/explicit_loop.h"
#include "tests/support/contact_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace plash {

namespace {

using testing::ContactModel;
using testing::FixedStep;
using testing::Springs;
using testing::Watch;

/// A springy cube of 2 over a plate that nobody moves.
struct CubeOverPlate {
    ContactModel mesh;
    Index plate, cube, first_cube_node = 0;
    std::vector<Index> cube_nodes;

    explicit CubeOverPlate(double height, double plate_thickness = 0.1)
    {
        cube = mesh.add_part(1.0, 210, 0);
        plate = mesh.add_part(1.0, 210, plate_thickness);
        mesh.add_sheet(plate, 8, 8, [](double u, double v) { return Vec3{8 * u - 3.1, 8 * v - 3.2, 0}; });
        first_cube_node = mesh.add_block(cube, {0, 0, height}, {2, 2, height + 2}, {3, 3, 3});
        for (Index node = first_cube_node; node < static_cast<Index>(mesh.model.nodes.size()); ++node) {
            cube_nodes.push_back(node);
        }
        Contact contact;
        contact.kind = Contact::Kind::two_way;
        contact.slave.kind = contact.master.kind = ContactSide::Kind::parts;
        contact.slave.parts = {cube};
        contact.master.parts = {plate};
        mesh.model.contacts.push_back(contact);
        mesh.model.controls.time.step_scale = 1;
    }

    Contact& contact() { return mesh.model.contacts[0]; }

    Scene scene(double step, double spring_stiffness = 20)
    {
        State state = mesh.state();
        for (Index node = 0; node < first_cube_node; ++node) state.mass[node] = 0; // held by nobody: stays
        Scene scene{mesh.model, std::move(state), {}, {}, 0, {}};
        auto springs = std::make_unique<Springs>();
        springs->add_solids(mesh.model, spring_stiffness);
        scene.terms.push_back(std::move(springs));
        scene.terms.push_back(std::make_unique<FixedStep>(step));
        scene.terms.push_back(
            std::make_unique<SurfaceContact>(mesh.model.contacts[0], mesh.model, part_data(mesh.model)));
        return scene;
    }

    static const SurfaceContact& contact_of(const Scene& scene)
    {
        return static_cast<const SurfaceContact&>(*scene.terms[2]);
    }
};

} // namespace

/// Frictionless bounce: after separation the sliding energy is back to zero within 1 % of its peak, for
/// penalty and soft-constraint stiffness.
TEST(ContactPenalty, SlidingEnergyReturnsAfterAFrictionlessBounce)
{
    for (const int soft : {0, 1}) {
        CubeOverPlate set(0.3);
        set.contact().soft = soft;
        set.mesh.model.controls.time.end_time = 6;
        Scene scene = set.scene(0.02);
        for (Index node : set.cube_nodes) scene.state.velocity[node] = {0.3, 0.1, -1};
        const SurfaceContact& contact = CubeOverPlate::contact_of(scene);
        double peak = 0;
        scene.terms.push_back(std::make_unique<Watch>(
            [&](const Clock&, const State&) { peak = std::max(peak, contact.sliding_energy()); }));
        Recorders nothing;
        const Outcome outcome = run(scene, nothing);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        EXPECT_EQ(contact.touches().size(), 0u) << "separated";
        EXPECT_GT(peak, 0.05) << "SOFT = " << soft;
        EXPECT_LT(std::abs(contact.sliding_energy()), 0.01 * peak) << "SOFT = " << soft;
        EXPECT_LT(scene.ledger.balance_error(), 1e-3);
    }
}

/// A block that slides under gravity comes to rest after v^2 / (2 mu g), and all its energy is frictional.
TEST(ContactPenalty, SlidingBlockStopsWhereCoulombSays)
{
    CubeOverPlate set(0.05);
    set.contact().static_friction = set.contact().dynamic_friction = 0.25;
    set.contact().damping = 20;
    BodyLoad gravity;
    gravity.direction = {0, 0, 1};
    gravity.scale = 1;
    set.mesh.model.body_loads.push_back(gravity);
    set.mesh.model.controls.time.end_time = 5;
    Scene scene = set.scene(0.001, 2000);
    scene.terms.push_back(std::make_unique<BodyLoads>(set.mesh.model, scene.state));
    for (Index node : set.cube_nodes) scene.state.velocity[node] = {0.8, 0, 0};
    Recorders nothing;
    run(scene, nothing);
    double travel = 0, speed = 0;
    for (Index node : set.cube_nodes) {
        travel +=
            (scene.state.position[node].x - set.mesh.model.nodes.position[node].x) / set.cube_nodes.size();
        speed += scene.state.velocity[node].x / set.cube_nodes.size();
    }
    // 0.8^2 / (2 x 0.25 x 1) = 1.28. The block sags and rocks on its springs while it slides: 2 %.
    EXPECT_NEAR(travel, 1.28, 0.025);
    // m v^2 / 2 of mass 8, but for the swinging on tangential and internal springs that is left: 5 %.
    EXPECT_NEAR(CubeOverPlate::contact_of(scene).friction_energy(), 8 * 0.8 * 0.8 / 2, 0.05 * 2.56);
    EXPECT_LT(scene.ledger.balance_error(), 2e-3);
}

/// On a slope below the friction angle the block stays: it moves by the elastic slip only and does not creep.
TEST(ContactPenalty, BlockOnASlopeBelowTheFrictionAngleDoesNotCreep)
{
    CubeOverPlate set(0.05);
    set.contact().static_friction = set.contact().dynamic_friction = 0.3;
    set.contact().damping = 20;
    BodyLoad gravity;
    gravity.direction = unit(Vec3{-0.2, 0, 1});
    gravity.scale = 1;
    set.mesh.model.body_loads.push_back(gravity);
    set.mesh.model.controls.time.end_time = 40;
    Scene scene = set.scene(0.001, 2000);
    scene.terms.push_back(std::make_unique<BodyLoads>(set.mesh.model, scene.state));
    std::vector<double> place;
    const Index corner = set.first_cube_node;
    scene.terms.push_back(std::make_unique<Watch>(
        [&](const Clock&, const State& state) { place.push_back(state.position[corner].x); }));
    Recorders nothing;
    run(scene, nothing);
    const auto mean = [&](std::size_t begin, std::size_t end) {
        return std::accumulate(place.begin() + begin, place.begin() + end, 0.0) / (end - begin);
    };
    const std::size_t quarter = place.size() / 4;
    // It swings on the tangential stiffness, undamped; its mean place stays.
    EXPECT_NEAR(mean(2 * quarter, 3 * quarter), mean(3 * quarter, 4 * quarter), 5e-4)
        << "creep in 10,000 cycles";
    // Coulomb sliding on this slope without friction would be 0.2 t^2 / 2 = 157.
    EXPECT_LT(place.back() - place.front(), 0.05);
}

/// *CONTACT_CONSTRAINT_NODES_TO_SURFACE: a block falls on a held plate and stays on it, no node deeper than
/// one step's path; the energy of the impact is booked as sliding energy.
TEST(ContactPenalty, ConstraintContactStopsNodesOnTheSurface)
{
    CubeOverPlate set(0.12);
    set.contact().kind = Contact::Kind::one_way;
    set.contact().constraint = true;
    set.mesh.model.controls.time.end_time = 0.6;
    Scene scene = set.scene(0.005, 200);
    for (Index node : set.cube_nodes) scene.state.velocity[node] = {0.2, 0, -1};
    const SurfaceContact& contact = CubeOverPlate::contact_of(scene);
    double deepest = 0, lost = 0;
    std::size_t most = 0;
    scene.terms.push_back(std::make_unique<Watch>([&](const Clock& clock, const State&) {
        most = std::max(most, contact.touches().size());
        if (clock.cycle < 3) return;
        contact.touches().for_each(
            [&](const Touch& touch) { deepest = std::max(deepest, touch.penetration); });
        lost = contact.sliding_energy();
    }));
    Recorders nothing;
    run(scene, nothing);
    EXPECT_EQ(most, 16u);
    EXPECT_LT(deepest, 1.5 * 0.005 * 1.0) << "at most the approach of a step";
    // 16 nodes of mass 8 / 27 x (1 to 4) / 8 in a row stop plastically: 8 / 6 of the mass at 1 / 2.
    EXPECT_NEAR(lost, 0.5 * 8.0 / 6, 0.35 * 0.5 * 8.0 / 6);
    EXPECT_LT(scene.ledger.balance_error(), 5e-3);
}

/// Contact forces are internal: they neither push nor turn the pair of bodies.
TEST(ContactPenalty, ForcesOfAPairAddUpToNothing)
{
    CubeOverPlate set(0.04);
    set.contact().static_friction = set.contact().dynamic_friction = 0.2;
    State state = set.mesh.state();
    for (Index node : set.cube_nodes) state.velocity[node] = {0.5, 0, -1};
    SurfaceContact contact(set.contact(), set.mesh.model, part_data(set.mesh.model));
    Clock clock;
    contact.add_forces(clock, state);
    clock.last_step = clock.step = 0.02;
    Vec3 sum{};
    double largest = 0;
    for (int cycle = 0; cycle < 3; ++cycle) {
        for (std::size_t i = 0; i < state.size(); ++i) state.position[i] += clock.step * state.velocity[i];
        state.clear_forces();
        contact.add_forces(clock, state);
    }
    for (const Vec3& force : state.force) {
        sum += force;
        largest = std::max(largest, norm(force));
    }
    EXPECT_GT(largest, 0.01);
    EXPECT_NEAR(norm(sum), 0, 1e-13);
}

} // namespace plash
