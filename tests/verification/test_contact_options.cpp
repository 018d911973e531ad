#include "contact/edge_contact.h"
#include "contact/surface_contact.h"
#include "tests/support/contact_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

using testing::ContactModel;

/// Two flat sheets of unit squares, 0.2 kg per area each, the upper one over the middle of the lower one.
struct PressedSheets {
    static constexpr double step = 0.01, gap = 0.15, start = 0.16;
    ContactModel mesh;
    Index lower, upper, first_upper;
    State state;

    explicit PressedSheets(int soft = 2)
    {
        lower = mesh.add_part(2.0, 210, 0.1);
        upper = mesh.add_part(1.0, 210, 0.2);
        mesh.add_sheet(lower, 6, 5, [](double u, double v) { return Vec3{6 * u, 5 * v, 0}; });
        first_upper = mesh.add_sheet(upper, 4, 3, [](double u, double v) {
            return Vec3{1 + 4 * u, 1 + 3 * v, start};
        });
        Contact contact;
        contact.soft = soft;
        contact.kind = Contact::Kind::two_way;
        contact.slave.kind = contact.master.kind = ContactSide::Kind::parts;
        contact.slave.parts = {upper};
        contact.master.parts = {lower};
        contact.limit_thickness = false;
        mesh.model.contacts.push_back(contact);
        state = mesh.state();
    }

    Contact& options() { return mesh.model.contacts[0]; }

    /// Steps with given velocities of the upper sheet; the force on it after each.
    std::vector<Vec3> forces(SurfaceContact& contact, const std::vector<Vec3>& velocity)
    {
        std::vector<Vec3> found;
        Clock clock;
        clock.last_step = clock.step = step;
        for (const Vec3& v : velocity) {
            for (std::size_t i = first_upper; i < state.size(); ++i) {
                state.velocity[i] = v;
                state.position[i] += step * v;
            }
            state.clear_forces();
            contact.add_forces(clock, state);
            Vec3 sum{};
            for (std::size_t i = first_upper; i < state.size(); ++i) sum += state.force[i];
            found.push_back(sum);
        }
        return found;
    }
    std::vector<Vec3> forces(const std::vector<Vec3>& velocity)
    {
        SurfaceContact contact(options(), mesh.model, part_data(mesh.model));
        return forces(contact, velocity);
    }
    /// After a fall to a penetration of 0.01.
    double pressed() { return forces({{0, 0, 0}, {0, 0, -2}}).back().z; }
};

} // namespace

/// PSTIFF = 1: a segment weighs what its nodes do (0.6, three times the shells).
TEST(ContactOptions, PenaltyFromMassesOfNodes)
{
    PressedSheets plain, by_nodes;
    by_nodes.options().stiffness_of_nodes = true;
    for (PressedSheets* set : {&plain, &by_nodes}) set->state.mass.assign(set->state.size(), 0.6);
    EXPECT_NEAR(by_nodes.pressed() / plain.pressed(), 3, 1e-9);
}

/// SSF of *PART_CONTACT under SOFT = 2: the mean of both, or with SSFTYP = 1 the larger one.
TEST(ContactOptions, StiffnessOfPartsUnderSegments)
{
    PressedSheets plain, mean, larger;
    larger.options().larger_part_scale = true;
    for (PressedSheets* set : {&mean, &larger}) set->mesh.model.part_contacts[set->lower].stiffness_scale = 3;
    const double force = plain.pressed();
    EXPECT_GT(force, 0);
    EXPECT_NEAR(mean.pressed() / force, 2, 1e-9);
    EXPECT_NEAR(larger.pressed() / force, 3, 1e-9);
}

/// FRICSF: as long as nothing slips, friction is that much stiffer, and the step is told.
TEST(ContactOptions, TangentialStiffness)
{
    PressedSheets plain, stiff;
    stiff.options().friction_stiffness_scale = 2;
    double friction[2], vote[2];
    int number = 0;
    for (PressedSheets* set : {&plain, &stiff}) {
        set->options().static_friction = set->options().dynamic_friction = 1e3;
        SurfaceContact contact(set->options(), set->mesh.model, part_data(set->mesh.model));
        friction[number] = set->forces(contact, {{0, 0, 0}, {0, 0, -2}, {0.01, 0, 0}}).back().x;
        vote[number++] = contact.stable_step().step;
    }
    EXPECT_LT(friction[0], 0);
    EXPECT_NEAR(friction[1] / friction[0], 2, 1e-9);
    EXPECT_NEAR(vote[0] / vote[1], std::sqrt(2.0), 1e-9);
}

/// DPRFAC: a penetration that gave no force when it was found is taken back by that share in every cycle; one
/// of before the first cycle is not.
TEST(ContactOptions, BaselinesOfSegmentsDecay)
{
    for (const bool from_start : {false, true}) {
        PressedSheets set;
        set.options().baseline_decay = 0.1;
        for (std::size_t i = set.first_upper; i < set.state.size(); ++i)
            set.state.position[i].z = PressedSheets::gap - 0.02;
        SurfaceContact contact(set.options(), set.mesh.model, part_data(set.mesh.model));
        Clock clock;
        clock.step = PressedSheets::step;
        if (from_start) contact.add_forces(clock, set.state);
        const std::vector<Vec3> force = set.forces(contact, std::vector<Vec3>(4));
        // 0.1 kg per area of both, over an area of 12, times SLSFAC / dt^2 and what is left of the baseline.
        const double stiffness = 0.1 * 0.1 / (PressedSheets::step * PressedSheets::step) * 12;
        for (int cycle = 0; cycle < 4; ++cycle) {
            const double active = from_start ? 0 : 0.02 * (1 - std::pow(0.9, cycle));
            EXPECT_NEAR(force[cycle].z, stiffness * active, 1e-9 * stiffness) << cycle;
        }
    }
}

/// VC and VSF arrive as one stress (the parser multiplies them): friction of a touch is no more than that
/// over its area.
TEST(ContactOptions, FrictionIsCapped)
{
    PressedSheets set;
    set.options().static_friction = set.options().dynamic_friction = 1e3;
    set.options().friction_stress = 0.01;
    EXPECT_NEAR(set.forces({{0, 0, 0}, {0, 0, -2}, {1, 0, 0}}).back().x, -0.01 * 12, 1e-9);
}

/// FRCENG: what friction has taken stands on the faces, half on either side, for nodes on segments and for
/// segments on segments.
TEST(ContactOptions, FrictionEnergyOfFaces)
{
    for (const int soft : {0, 2}) {
        PressedSheets set(soft);
        set.options().friction_energy = true;
        set.options().static_friction = set.options().dynamic_friction = 0.3;
        SurfaceContact contact(set.options(), set.mesh.model, part_data(set.mesh.model));
        set.forces(contact, {{0, 0, 0}, {0, 0, -2}, {1, 0, 0}, {1, 0.5, 0}, {1, 0.5, 0}});
        ElementResults results;
        results.contact_faces_wanted = true;
        contact.collect(set.state, results);
        double sum[2] = {};
        for (const auto& face : results.contact_faces)
            sum[face.sides - 1] += face.friction_energy * segment_area(face.nodes, set.state.position);
        EXPECT_GT(contact.friction_energy(), 0);
        EXPECT_NEAR(sum[0] / contact.friction_energy(), 0.5, 1e-12) << soft;
        EXPECT_NEAR(sum[1] / contact.friction_energy(), 0.5, 1e-12) << soft;
        set.options().friction_energy = false;
        SurfaceContact without(set.options(), set.mesh.model, part_data(set.mesh.model));
        set.forces(without, {{0, 0, 0}, {1, 0, 0}});
        ElementResults nothing;
        nothing.contact_faces_wanted = true;
        without.collect(set.state, nothing);
        for (const auto& face : nothing.contact_faces) EXPECT_EQ(face.friction_energy, 0);
    }
}

/// EDGEK: rims of two sheets that meet edge on.
TEST(ContactOptions, StiffnessOfEdges)
{
    double force[2];
    int number = 0;
    for (const double scale : {1.0, 3.0}) {
        ContactModel mesh;
        const Index part = mesh.add_part(1.0, 210, 0.1);
        mesh.add_sheet(part, 1, 1, [](double u, double v) { return Vec3{u, 0.3 * u, v}; });
        const Index first = mesh.add_sheet(part, 1, 1, [](double u, double v) {
            return Vec3{u, 0.3 - 0.3 * u, 1.12 + v};
        });
        Contact contact;
        contact.soft = 2;
        contact.kind = Contact::Kind::single_surface;
        contact.slave.kind = ContactSide::Kind::all;
        contact.edges = true;
        contact.limit_thickness = false;
        contact.edge_stiffness_scale = scale;
        mesh.model.contacts.push_back(contact);
        State state = mesh.state();
        EdgeContact edges(mesh.model.contacts[0], mesh.model, part_data(mesh.model));
        Clock clock;
        clock.last_step = clock.step = 0.01;
        for (int cycle = 0; cycle < 3; ++cycle) {
            state.clear_forces();
            for (std::size_t i = first; i < state.size(); ++i) {
                state.velocity[i] = {0, 0, -1};
                state.position[i].z -= clock.step;
            }
            edges.add_forces(clock, state);
        }
        Vec3 sum{};
        for (std::size_t i = first; i < state.size(); ++i) sum += state.force[i];
        force[number++] = sum.z;
    }
    EXPECT_GT(force[0], 0);
    EXPECT_NEAR(force[1] / force[0], 3, 1e-9);
}

} // namespace plash
