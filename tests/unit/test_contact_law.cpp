#include "contact/closest_point.h"
#include "contact/penalty_law.h"
#include "contact/surface_contact.h"
#include "tests/support/contact_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

using testing::ContactModel;

/// What a contact is told; all else is the same.
struct Variant {
    const char* name;
    int soft = 0;
    double damping = 0, at_rest = 0, moving = 0, decay = 0, cap = 0;
};

/// A wavy sheet with a number of nodes that fills no batch slides over quadrilaterals and triangles.
struct SlidingSheet {
    ContactModel mesh;
    Index lower, upper, first_upper;
    State state;
    Clock clock;

    explicit SlidingSheet(const Variant& variant)
    {
        lower = mesh.add_part(2.0, 210, 0.1);
        upper = mesh.add_part(1.0, 150, 0.2);
        mesh.add_sheet(lower, 9, 7, [](double u, double v) {
            return Vec3{9 * u + 0.3 * v, 7 * v, 0.02 * std::sin(9 * u) * std::cos(7 * v)};
        });
        auto& shells = mesh.model.shells.nodes;
        for (std::size_t shell = 0; shell < shells.size(); shell += 3) {
            const auto quad = shells[shell];
            shells[shell] = {quad[0], quad[1], quad[2], quad[2]};
            mesh.add_shell(lower, {quad[0], quad[2], quad[3], quad[3]});
        }
        first_upper = mesh.add_sheet(upper, 10, 6, [](double u, double v) {
            return Vec3{1 + 6 * u, 1.2 + 4 * v, 0.165 + 0.01 * std::sin(5 * u + 3 * v)};
        });
        Contact contact;
        contact.kind = Contact::Kind::two_way;
        contact.slave.kind = contact.master.kind = ContactSide::Kind::parts;
        contact.slave.parts = {upper};
        contact.master.parts = {lower};
        contact.limit_thickness = false;
        contact.soft = variant.soft;
        contact.damping = variant.damping;
        contact.static_friction = variant.at_rest;
        contact.dynamic_friction = variant.moving;
        contact.friction_decay = variant.decay;
        contact.friction_stress = variant.cap;
        if (variant.at_rest == -1) {
            mesh.model.part_contacts[lower] = {0.5, 0.3, 0.2, 0, 0, 1, 1};
            mesh.model.part_contacts[upper] = {0.1, 0.1, 0.0, 0, 0, 1, 1};
        }
        mesh.model.contacts.push_back(contact);
        state = mesh.state();
        clock.step = clock.last_step = 0.01;
    }

    /// The upper sheet comes down, slides and turns; nothing else moves it.
    void advance(int cycle)
    {
        const double fall = cycle < 8 ? -0.6 : 0.1;
        for (std::size_t i = first_upper; i < state.size(); ++i) {
            const Vec3& at = mesh.model.nodes.position[i];
            state.velocity[i] = {0.4 + 0.05 * at.y, -0.2 - 0.05 * at.x, fall + 0.1 * std::sin(at.x + cycle)};
            state.position[i] += clock.step * state.velocity[i];
        }
        clock.time += clock.step;
    }
};

Friction friction_of(const SlidingSheet& set)
{
    const Contact& contact = set.mesh.model.contacts[0];
    if (contact.static_friction != -1)
        return {contact.static_friction, contact.dynamic_friction, contact.friction_decay,
                contact.friction_stress};
    return {0.3, 0.2, 0.1, 0}; // the mean of both parts, between which every touch is
}

} // namespace

/// The law in lanes of eight touches against the same law, one touch after the other, with all that it knows:
/// rounded penalty, damping, friction that decays with the speed, its cap, the mean of both parts' friction.
TEST(ContactLaw, LanesEqualTheScalarReference)
{
    const Variant variants[] = {{"plain"},
                                {"soft constraint", 1},
                                {"damping", 0, 20},
                                {"friction", 0, 0, 0.3, 0.3},
                                {"decay", 1, 10, 0.4, 0.1, 0.9},
                                {"cap", 0, 0, 0.3, 0.3, 0, 0.02},
                                {"by parts", 0, 0, -1}};
    for (const Variant& variant : variants) {
        SlidingSheet set(variant);
        const Model& model = set.mesh.model;
        const std::vector<double> mass = set.state.mass;
        SurfaceContact contact(model.contacts[0], model, part_data(model));
        std::vector<Touch> before;
        int compared = 0, sliding = 0, capped = 0;
        for (int cycle = 0; cycle < 40; ++cycle) {
            State& state = set.state;
            state.clear_forces();
            const double taken_before = contact.friction_energy();
            contact.add_forces(set.clock, state);
            const auto& nodes = contact.mesh().nodes;
            const auto of = [&](const std::vector<Vec3>& field, Index node) {
                return field[nodes[node].node];
            };
            std::vector<Vec3> sum(state.size());
            double loss = 0, size = 1e-12;
            bool all_known = true;
            for (const Touch& touch : contact.touches().all) {
                const auto& facet = contact.mesh().facets[touch.facet];
                const auto share = corner_shares(touch.s, touch.t, facet.triangle());
                Vec3 velocity = of(state.velocity, touch.node);
                double inverse = 0, smallest = mass[nodes[touch.node].node];
                for (int i = 0; i < 4; ++i) {
                    velocity -= share[i] * of(state.velocity, facet.corner[i]);
                    inverse += share[i] * share[i] / mass[nodes[facet.corner[i]].node];
                    smallest = std::min(smallest, mass[nodes[facet.corner[i]].node]);
                }
                double stiffness = 0.1 * std::min(nodes[touch.node].stiffness, facet.stiffness);
                if (variant.soft == 1) stiffness = std::max(stiffness, 0.05 * smallest / 1e-4);
                EXPECT_NEAR(touch.stiffness, stiffness, 1e-12 * stiffness) << variant.name;
                EXPECT_EQ(touch.weight, 1);
                const double closing = -dot(velocity, touch.normal);
                double force = rounded_force(stiffness, touch.active_penetration(), touch.rounding);
                if (force > 0 && variant.damping > 0)
                    force =
                        std::max(0.0, force + damping_coefficient(variant.damping, stiffness,
                                                                  mass[nodes[touch.node].node], 1 / inverse) *
                                                  closing);
                size = std::max(size, force);
                const auto old = std::find_if(before.begin(), before.end(), [&](const Touch& one) {
                    return one.node == touch.node && one.facet == touch.facet;
                });
                const bool fresh = std::none_of(before.begin(), before.end(),
                                                [&](const Touch& one) { return one.node == touch.node; });
                // What a touch takes over from another facet is the finder's business.
                const bool known = fresh || old != before.end();
                all_known = all_known && known;
                const Vec3 rubbed = fresh ? Vec3{} : known ? old->friction : Vec3{};
                const Vec3 slip = set.clock.last_step * (velocity + closing * touch.normal);
                const Friction friction = friction_of(set);
                double limit = friction.coefficient(norm(slip) / set.clock.last_step) * force;
                if (friction.shear_cap > 0 && friction.shear_cap * facet.size * facet.size < limit) {
                    limit = friction.shear_cap * facet.size * facet.size;
                    ++capped;
                }
                const Vec3 tangential =
                    friction.any() ? friction_force(rubbed, touch.normal, slip, stiffness, limit) : Vec3{};
                const Vec3 whole = force * touch.normal + tangential;
                if (known) {
                    EXPECT_NEAR(norm(touch.force - whole), 0, 1e-10 * size) << variant.name << ' ' << cycle;
                    loss -= 0.5 * dot(rubbed + tangential, slip);
                    ++compared;
                    sliding += friction.any() && norm(tangential) > 0.999 * limit && limit > 0;
                }
                sum[nodes[touch.node].node] += touch.force;
                for (int i = 0; i < 4; ++i) sum[nodes[facet.corner[i]].node] -= share[i] * touch.force;
            }
            for (std::size_t i = 0; i < state.size(); ++i)
                EXPECT_NEAR(norm(state.force[i] - sum[i]), 0, 1e-10 * size) << variant.name << ' ' << cycle;
            if (all_known) {
                EXPECT_NEAR(contact.friction_energy() - taken_before, loss, 1e-10 * size) << variant.name;
            }
            before = contact.touches().all;
            set.advance(cycle);
        }
        EXPECT_GT(compared, 1000) << variant.name;
        if (variant.at_rest != 0) {
            EXPECT_GT(sliding, 300) << variant.name;
        }
        if (variant.cap > 0) {
            EXPECT_GT(capped, 300);
        }
    }
}

} // namespace plash
