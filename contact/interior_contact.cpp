#include "contact/interior_contact.h"

#include <cmath>

namespace plash {

namespace {

/// Corners of the near and the far face in each of the three directions.
constexpr int near_face[3][4] = {{0, 1, 2, 3}, {0, 3, 7, 4}, {0, 4, 5, 1}};
constexpr int far_face[3][4] = {{4, 5, 6, 7}, {1, 2, 6, 5}, {3, 7, 6, 2}};

Vec3 mean(const std::array<Index, 8>& nodes, const int (&face)[4], const std::vector<Vec3>& field)
{
    Vec3 sum{};
    for (int corner : face) sum += 0.25 * field[nodes[corner]];
    return sum;
}

/// Sum of the normals of both faces, towards the far one in an element that is the right way out.
Vec3 across(const std::array<Index, 8>& nodes, int direction, const std::vector<Vec3>& position)
{
    const auto normal = [&](const int(&face)[4]) {
        const auto p = [&](int i) { return position[nodes[face[i]]]; };
        return cross(p(2) - p(0), p(3) - p(1));
    };
    return normal(near_face[direction]) + normal(far_face[direction]);
}

} // namespace

InteriorContact::InteriorContact(const Model& model, const std::vector<PartData>& parts, const PartSet& set,
                                 double penalty_scale)
    : model_(model)
{
    const double scale = set.attribute[0] > 0 ? set.attribute[0] : 1;
    const double activation = set.attribute[1] > 0 ? set.attribute[1] : 0.1;
    std::vector<bool> wanted(model.parts.size());
    for (Index part : set.parts) wanted[part] = !parts[part].rigid;
    const std::vector<Vec3>& position = model.nodes.position;
    for (std::size_t i = 0; i < model.solids.size(); ++i) {
        const Index part = model.solids.part[i];
        const auto& nodes = model.solids.nodes[i];
        if (!wanted[part] || nodes[4] == nodes[5]) continue; // hexahedra only
        const double modulus = set.attribute[2] > 0 ? set.attribute[2] : parts[part].bulk_modulus;
        const double volume = solid_volume(nodes, position);
        for (int direction = 0; direction < 3; ++direction) {
            const double height = norm(mean(nodes, far_face[direction], position) -
                                       mean(nodes, near_face[direction], position));
            if (!(height > 0)) continue;
            const double stiffness = scale * penalty_scale * modulus * volume / (height * height);
            springs_.push_back({static_cast<Index>(i), direction, activation * height, stiffness, {}});
        }
    }
}

void InteriorContact::add_forces(const Clock& clock, State& state)
{
    vote_ = StepVote::nothing();
    double largest = 0;
    for (Spring& spring : springs_) {
        const auto& nodes = model_.solids.nodes[spring.solid];
        const Vec3 before = spring.force;
        spring.force = {};
        const bool gone = !state.deleted_solids.empty() && state.deleted_solids[spring.solid];
        const auto& low = near_face[spring.direction];
        const auto& high = far_face[spring.direction];
        const Vec3 reach = mean(nodes, high, state.position) - mean(nodes, low, state.position);
        const double length = norm(reach);
        if (!gone) {
            const Vec3 normal = unit(across(nodes, spring.direction, state.position));
            const bool inverted = dot(reach, normal) < 0;
            const double height = inverted ? -length : length;
            if (height < spring.limit) {
                const Vec3 away = length > 1e-6 * spring.limit ? (1 / height) * reach : normal;
                spring.force = (spring.stiffness * (spring.limit - height)) * away;
                for (int corner = 0; corner < 4; ++corner) {
                    state.force[nodes[high[corner]]] += 0.25 * spring.force;
                    state.force[nodes[low[corner]]] -= 0.25 * spring.force;
                    for (const int one : {high[corner], low[corner]}) {
                        const double mass = state.mass[nodes[one]];
                        if (!(mass > 0) || 0.5 * spring.stiffness <= largest * mass) continue;
                        largest = 0.5 * spring.stiffness / mass;
                        // Up to eight elements and three directions share a node.
                        vote_ = {2 / std::sqrt(8 * largest), "interior contact of solid",
                                 model_.solids.id[spring.solid],
                                 model_.parts[model_.solids.part[spring.solid]].id};
                    }
                }
            }
        }
        const Vec3 closing = mean(nodes, high, state.velocity) - mean(nodes, low, state.velocity);
        energy_ -= 0.5 * clock.last_step * dot(before + spring.force, closing);
    }
}

} // namespace plash
