#include "contact/surface_contact.h"
#include "output/recorders.h"
#include "solver/explicit_loop.h"
#include "tests/support/contact_model.h"
#include "tests/support/deck_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <omp.h>
#include <sstream>

namespace plash {

namespace {

using testing::ContactModel;
using testing::DeckRun;
using testing::DeckText;
using testing::FixedStep;
using testing::Springs;
using testing::Watch;

/// Two sheets with meshes that do not match, the upper one within the lower one's outline, `distance` apart.
struct TwoSheets {
    ContactModel mesh;
    Index lower = 0, upper = 0, first_upper = 0;

    TwoSheets(double distance, double skew, int soft = 2)
    {
        const Index low = mesh.add_part(2.0, 210, 0.1), high = mesh.add_part(1.0, 210, 0.2);
        mesh.add_sheet(low, 7, 5, [](double u, double v) { return Vec3{7 * u, 5 * v, 0}; });
        // Skewed quadrilaterals, still flat.
        first_upper = mesh.add_sheet(high, 6, 4, [&](double u, double v) {
            const double bend = skew * u * (1 - u) * v * (1 - v);
            return Vec3{1 + 4.7 * u + bend, 1 + 3.1 * v - bend, distance};
        });
        Contact contact;
        contact.soft = soft;
        contact.kind = Contact::Kind::two_way;
        contact.slave.kind = contact.master.kind = ContactSide::Kind::parts;
        contact.slave.parts = {high};
        contact.master.parts = {low};
        contact.limit_thickness = false;
        mesh.model.contacts.push_back(contact);
    }

    bool is_upper(std::size_t node) const { return static_cast<Index>(node) >= first_upper; }
};

/// Forces of the contact after the upper sheet has come down by `depth` below the first touch in two steps.
State pressed(TwoSheets& set, double depth, const Vec3& drift = {})
{
    State state = set.mesh.state();
    const double start = 0.16; // the gap is 0.15
    SurfaceContact contact(set.mesh.model.contacts[0], set.mesh.model, part_data(set.mesh.model));
    Clock clock;
    clock.last_step = clock.step = 0.01;
    const double fall = start - 0.15 + depth;
    for (int cycle = 0; cycle < 3; ++cycle) {
        state.clear_forces();
        contact.add_forces(clock, state);
        if (cycle == 2) break;
        for (std::size_t i = 0; i < state.size(); ++i) {
            if (!set.is_upper(i)) continue;
            state.velocity[i] = Vec3{drift.x, drift.y, -50 * fall};
            state.position[i] += clock.step * state.velocity[i];
        }
    }
    return state;
}

} // namespace

/// Contact patch test: under a constant penetration each node receives the consistent load of a constant
/// pressure, exactly, for meshes that do not match and for skewed quadrilaterals.
TEST(SegmentContact, ConstantPressureBetweenMeshesThatDoNotMatch)
{
    for (const double skew : {0.0, 1.5}) {
        TwoSheets set(0.16, skew);
        const double depth = 0.02;
        const State state = pressed(set, depth);
        // Areas of the upper sheet's nodes by the shape functions: exact integrals of N over each element.
        std::vector<double> load(state.size());
        const auto& shells = set.mesh.model.shells;
        for (std::size_t e = 0; e < shells.size(); ++e) {
            if (shells.part[e] == 0) continue;
            std::array<Vec3, 4> q;
            for (int i = 0; i < 4; ++i) q[i] = state.position[shells.nodes[e][i]];
            for (const double s : {0.5 - std::sqrt(1 / 12.0), 0.5 + std::sqrt(1 / 12.0)}) {
                for (const double t : {0.5 - std::sqrt(1 / 12.0), 0.5 + std::sqrt(1 / 12.0)}) {
                    const Vec3 u = (1 - t) * (q[1] - q[0]) + t * (q[2] - q[3]);
                    const Vec3 v = (1 - s) * (q[3] - q[0]) + s * (q[2] - q[1]);
                    const double share[4] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
                    for (int i = 0; i < 4; ++i)
                        load[shells.nodes[e][i]] += 0.25 * share[i] * norm(cross(u, v));
                }
            }
        }
        // Masses per area are 0.2 both: 0.1 x 0.1 / 0.01^2; the kink is rounded over the last approach,
        // 0.5 x (0.01 + 0.02) = 0.015.
        const double pressure = 100 * (depth - 0.5 * 0.015);
        double whole = 0, lower = 0;
        for (std::size_t i = 0; i < state.size(); ++i) {
            EXPECT_NEAR(state.force[i].x, 0, 1e-13);
            if (!set.is_upper(i)) {
                lower += state.force[i].z;
                continue;
            }
            whole += state.force[i].z;
            // The shape functions of skewed elements are no polynomials of the place: three points a
            // triangle.
            EXPECT_NEAR(state.force[i].z, pressure * load[i], (skew == 0 ? 1e-12 : 2e-3) * pressure) << i;
        }
        EXPECT_NEAR(whole, pressure * 4.7 * 3.1, 1e-11 * whole);
        EXPECT_NEAR(whole + lower, 0, 1e-12 * whole);
    }
}

/// Neither force nor moment is lost, also with friction, tilt and warped segments.
TEST(SegmentContact, ForcesAndMomentsOfAPairAddUpToNothing)
{
    TwoSheets set(0.16, 1.0);
    for (std::size_t i = 0; i < set.mesh.model.nodes.size(); ++i) {
        Vec3& place = set.mesh.model.nodes.position[i];
        if (set.is_upper(i)) place.z += 0.004 * std::sin(3 * place.x + 2 * place.y) + 0.003 * place.x;
    }
    const State frictionless = pressed(set, 0.05, {0.3, 0.2, 0});
    Vec3 sum{}, moment{};
    double size = 0;
    for (std::size_t i = 0; i < frictionless.size(); ++i) {
        sum += frictionless.force[i];
        moment += cross(frictionless.position[i], frictionless.force[i]);
        size += norm(frictionless.force[i]);
    }
    EXPECT_GT(size, 1);
    EXPECT_LT(norm(sum), 1e-12 * size);
    EXPECT_LT(norm(moment), 1e-12 * size);

    set.mesh.model.contacts[0].static_friction = set.mesh.model.contacts[0].dynamic_friction = 0.3;
    const State rubbing = pressed(set, 0.05, {0.3, 0.2, 0});
    sum = {};
    Vec3 on_upper{};
    for (std::size_t i = 0; i < rubbing.size(); ++i) {
        sum += rubbing.force[i];
        if (set.is_upper(i)) on_upper += rubbing.force[i];
    }
    EXPECT_LT(norm(sum), 1e-12 * size);
    EXPECT_NEAR(on_upper.y / on_upper.x, 0.2 / 0.3, 0.05) << "friction works against the drift";
    EXPECT_LT(on_upper.x, 0);
}

/// A springy cube bounces off a plate that nobody moves; once, and tilted so that an edge or a corner comes
/// first: sliding energy returns to nothing within 1 % of its peak.
TEST(SegmentContact, SlidingEnergyReturnsAfterABounce)
{
    for (const double tilt : {0.0, 0.2, 0.7}) {
        ContactModel mesh;
        const Index cube = mesh.add_part(1.0, 210, 0), plate = mesh.add_part(1.0, 210, 0.1);
        mesh.add_sheet(plate, 8, 8, [](double u, double v) { return Vec3{8 * u - 3.1, 8 * v - 3.2, 0}; });
        const Index first = mesh.add_block(cube, {0, 0, 0}, {2, 2, 2}, {3, 3, 3});
        const double c = std::cos(tilt), s = std::sin(tilt);
        for (std::size_t i = first; i < mesh.model.nodes.size(); ++i) {
            Vec3& p = mesh.model.nodes.position[i];
            p = {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
            p = {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
            p.z += 0.3 + 2 * s;
        }
        Contact contact;
        contact.soft = 2;
        contact.kind = Contact::Kind::two_way;
        contact.slave.kind = contact.master.kind = ContactSide::Kind::parts;
        contact.slave.parts = {cube};
        contact.master.parts = {plate};
        mesh.model.contacts.push_back(contact);
        mesh.model.controls.time.step_scale = 1;
        mesh.model.controls.time.end_time = 9;
        State state = mesh.state();
        for (Index node = 0; node < first; ++node) state.mass[node] = 0;
        for (std::size_t node = first; node < state.size(); ++node) state.velocity[node] = {0.1, 0.05, -1};
        Scene scene{mesh.model, std::move(state), {}, {}, 0, {}};
        auto springs = std::make_unique<Springs>();
        springs->add_solids(mesh.model, 20);
        scene.terms.push_back(std::move(springs));
        scene.terms.push_back(std::make_unique<FixedStep>(0.004));
        auto term =
            std::make_unique<SurfaceContact>(mesh.model.contacts[0], mesh.model, part_data(mesh.model));
        const SurfaceContact& bounce = *term;
        scene.terms.push_back(std::move(term));
        double peak = 0;
        scene.terms.push_back(std::make_unique<Watch>(
            [&](const Clock&, const State&) { peak = std::max(peak, bounce.sliding_energy()); }));
        Recorders nothing;
        const Outcome outcome = run(scene, nothing);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        ASSERT_NE(bounce.facing(), nullptr);
        EXPECT_EQ(bounce.touches().size() + bounce.facing()->touches().size(), 0u) << "separated " << tilt;
        EXPECT_GT(peak, 0.02) << tilt;
        // 0.8, 0.4 and 1.2 %: on its corner the cube rolls over a fifth of an element deep, and the direction
        // in which faces press turns with it.
        EXPECT_LT(std::abs(bounce.sliding_energy()), (tilt < 0.5 ? 0.01 : 0.015) * peak) << tilt;
        EXPECT_LT(scene.ledger.balance_error(), 2e-3) << tilt;
    }
}

/// Two blocks of meshes 3:4 and 5:2 under a pressure from above come to a uniform stress: the nodes of each
/// face of the joint stand in one plane. With nodes on segments they do not.
TEST(SegmentContact, PressedBlocksOfDifferentMeshesAreUnderOneStress)
{
    double unevenness[3] = {};
    for (const int soft : {0, 2}) {
        DeckText deck;
        deck.text += "*CONTROL_TERMINATION\n0.002\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,7.85e-9,2.1e5,0.0\n";
        deck.part(1, 1, 1);
        deck.part(2, 1, 1);
        const int low = deck.block(1, {0, 0, 0}, {30, 30, 20}, 3, 5, 2);
        const int high = deck.block(2, {0, 0, 20}, {30, 30, 40}, 4, 2, 2);
        deck.text += "*BOUNDARY_SPC_SET\n1,0,0,0,1\n*SET_NODE_LIST_GENERATE\n1\n1,24\n";
        deck.text += "*DEFINE_CURVE\n1\n0,0\n2e-4,1\n1,1\n*DAMPING_GLOBAL\n0,20000.\n";
        deck.text += "*LOAD_SEGMENT\n";
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 4; ++i) {
                const int corner = high + 30 + j * 5 + i;
                deck.text +=
                    fmt::format("1,100.,0,{},{},{},{}\n", corner, corner + 1, corner + 6, corner + 5);
            }
        }
        deck.text += fmt::format("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n\n\n{}\n", soft);
        DeckRun run(deck.text);
        ASSERT_TRUE(run.scene);
        run.go();
        const auto range = [&](int first, int count) {
            double least = 1e9, most = -1e9, mean = 0;
            for (int i = 0; i < count; ++i) {
                const double z = run.scene->state.position[run.node(first + i)].z;
                least = std::min(least, z);
                most = std::max(most, z);
                mean += z / count;
            }
            return std::pair(most - least, mean);
        };
        // 100 / 2.1e5 x 20 = 0.00952 of shortening of the lower block.
        const auto [rough_low, at_low] = range(low + 48, 24);
        const auto [rough_high, at_high] = range(high, 15);
        if (soft == 2) {
            EXPECT_NEAR(20 - at_low, 0.00952, 0.01 * 0.00952);
        }
        unevenness[soft] = std::max(rough_low, rough_high) / 0.00952;
        EXPECT_LT(at_high, 20) << soft;
    }
    EXPECT_LT(unevenness[2], 0.01);
    EXPECT_GT(unevenness[0], 0.05) << "what the patch test is about";
}

/// *DATABASE_BINARY_INTFOR: pressure and shear of the faces add up to the force between the surfaces, on
/// either side, and the files hold them.
TEST(SegmentContact, InterfaceFieldsAddUpToTheForces)
{
    DeckText deck;
    deck.text += "*CONTROL_TERMINATION\n0.0002\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,7.85e-9,2.1e5,0.3\n"
                 "*DATABASE_BINARY_INTFOR\n1.0e-4\n";
    deck.part(1, 1, 1);
    deck.part(2, 1, 1);
    deck.block(1, {0, 0, 0}, {30, 30, 20}, 3, 5, 2);
    deck.block(2, {3, 3, 20}, {28, 27, 40}, 4, 2, 2);
    deck.text += "*SET_NODE_LIST_GENERATE\n1\n1,24\n*BOUNDARY_SPC_SET\n1,0,1,1,1\n"
                 "*INITIAL_VELOCITY_GENERATION\n2,2,0.0,2000.,0.,-4000.\n0,0,0,0,0,0\n"
                 "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n7,joint\n2,1,3,3\n0.2,0.2\n\n2\n";
    DeckRun run(deck.text);
    ASSERT_TRUE(run.scene);
    double most = 0;
    Scene* scene = run.scene.get();
    run.watch([&, scene](const Clock&, const State& state) {
        ElementResults results;
        results.contact_faces_wanted = true;
        for (const auto& term : scene->terms) term->collect(state, results);
        double pressing[3] = {};
        Vec3 rubbing[3] = {};
        for (const auto& face : results.contact_faces) {
            EXPECT_EQ(face.contact, 7);
            const double area = segment_area(face.nodes, state.position);
            pressing[face.sides] += face.pressure * area;
            rubbing[face.sides] += area * face.shear;
        }
        const double force = norm(results.contacts[0].slave_force);
        most = std::max(most, force);
        if (force == 0) return;
        EXPECT_NEAR(pressing[1], pressing[2], 1e-9 * pressing[1]);
        EXPECT_LT(norm(rubbing[1] + rubbing[2]), 1e-9 * pressing[1]);
        // Each touch presses along z, but for the tilt of its facets.
        EXPECT_NEAR(std::hypot(pressing[1], norm(rubbing[1])), force, 0.01 * force);
    });
    const testing::TemporaryFolder folder;
    Recorders recorders = make_recorders(run.read->model, folder.path().string(), {});
    const Outcome outcome = plash::run(*run.scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_GT(most, 100) << "they have met";
    std::ifstream index(folder / "interface.pvd"), state(folder / "vtk/interface_0002.vtu");
    std::stringstream pvd, vtu;
    pvd << index.rdbuf();
    vtu << state.rdbuf();
    EXPECT_NE(pvd.str().find("vtk/interface_0001.vtu"), std::string::npos);
    for (const char* field : {"contact_id", "surface", "pressure", "shear", "penetration"})
        EXPECT_NE(vtu.str().find(fmt::format("Name=\"{}\"", field)), std::string::npos) << field;
}

/// The same bits for any number of threads.
TEST(SegmentContact, ThreadsDoNotMatter)
{
    const int threads = omp_get_max_threads();
    std::vector<std::vector<Vec3>> force;
    for (const int count : {1, 3}) {
        omp_set_num_threads(count);
        TwoSheets set(0.16, 1.2);
        force.push_back(pressed(set, 0.03, {0.1, 0, 0}).force);
    }
    omp_set_num_threads(threads);
    for (std::size_t i = 0; i < force[0].size(); ++i) {
        EXPECT_EQ(force[0][i].z, force[1][i].z);
        EXPECT_EQ(force[0][i].x, force[1][i].x);
    }
}

} // namespace plash
