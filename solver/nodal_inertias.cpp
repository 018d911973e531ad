#include "solver/nodal_inertias.h"

#include "materials/parameters.h"
#include "rigid/deck_nodes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace plash {

namespace {

constexpr const char* keywords[] = {"ELEMENT_INERTIA", "ELEMENT_INERTIA_OFFSET"};

/// Whether an element turns alike about all axes through its node.
bool is_isotropic(const Record& record)
{
    if (record.keyword != keywords[0]) return false;
    const double moment = record.real("IXX");
    for (const char* field : {"IYY", "IZZ"})
        if (std::abs(record.real(field) - moment) > 1e-6 * moment) return false;
    for (const char* field : {"IXY", "IXZ", "IYZ"})
        if (std::abs(record.real(field)) > 1e-6 * moment) return false;
    return true;
}

/// Rows are the axes of the tensor: those of CSID, or the global ones.
Matrix3 axes_of_tensor(const Model& model, const Record& record)
{
    const Id number = record.integer("CSID");
    if (number == 0) return Matrix3::identity();
    const auto found = std::find_if(model.coordinate_systems.begin(), model.coordinate_systems.end(),
                                    [&](const CoordinateSystem& one) { return one.id == number; });
    if (found == model.coordinate_systems.end())
        reject_field(record, "CSID", fmt::format("there is no coordinate system {}", number));
    return {{found->axes[0], found->axes[1], found->axes[2]}};
}

/// Mass, place and inertia about its own centre.
MassProperties properties_of(const Model& model, const Record& record, const Vec3& node)
{
    const auto value = [&](const char* field) { return record.real(field); };
    const Matrix3 axes = axes_of_tensor(model, record);
    const Matrix3 tensor{{{value("IXX"), value("IXY"), value("IXZ")},
                          {value("IXY"), value("IYY"), value("IYZ")},
                          {value("IXZ"), value("IYZ"), value("IZZ")}}};
    const Vec3 *x = &tensor.row[0], *y = &tensor.row[1], *z = &tensor.row[2];
    if (!(x->x > 0 && x->x * y->y > x->y * x->y && determinant(tensor) > 0)) {
        reject_field(record, "IXX", "the moments of inertia are not positive definite");
    }
    if (x->x + y->y + z->z < 2 * std::max({x->x, y->y, z->z}) * (1 - 1e-6)) {
        reject_field(record, "IXX", "no mass has such moments: one is larger than the sum of the other two");
    }
    Vec3 offset{};
    if (record.keyword == keywords[1]) {
        offset = {value("X-OFF"), value("Y_OFF"), value("Z_OFF")};
        if (norm(offset) > 0 && !(value("MASS") > 0))
            reject_field(record, "MASS", "an offset needs a mass that is off the node");
    }
    return {value("MASS"), node + offset, transpose(axes) * tensor * axes};
}

template <class Visit>
void for_each_inertia(const Model& model, Visit&& visit)
{
    for (const char* keyword : keywords) for_each_record(model, keyword, visit);
}

void refuse_driven_nodes(const Model& model, Index node, const Record& record)
{
    for (const PrescribedMotion& motion : model.prescribed_motions) {
        if (std::find(motion.nodes.begin(), motion.nodes.end(), node) == motion.nodes.end()) continue;
        throw DeckError(
            motion.where,
            fmt::format("node {} has moments of inertia that are not equal about all axes ({}:{}); "
                        "its motion cannot be prescribed",
                        model.nodes.id[node], model.place(record.where), record.keyword));
    }
}

} // namespace

void add_nodal_inertias(const Model& model, State& state)
{
    std::optional<DeckNodes> nodes; // only where a deck has such elements
    for_each_inertia(model, [&](const Record& record) {
        if (!nodes) nodes.emplace(model);
        const Index node = nodes->find(record.integer("NID"), record, record.where.line);
        state.need_rotation();
        if (!is_isotropic(record)) return;
        state.inertia[node] += positive(record, "IXX", "moment of inertia");
        state.mass[node] += record.real("MASS");
    });
}

void add_inertia_bodies(const Model& model, const State& state, RigidSetup& setup)
{
    std::optional<DeckNodes> nodes;
    std::map<Index, MassProperties> of_node;
    for_each_inertia(model, [&](const Record& record) {
        if (is_isotropic(record)) return;
        if (!nodes) nodes.emplace(model);
        const Index node = nodes->find(record.integer("NID"), record, record.where.line);
        refuse_driven_nodes(model, node, record);
        of_node[node].add(properties_of(model, record, state.position[node]));
    });
    if (of_node.empty()) return;
    std::vector<Index> owner(state.size(), none);
    for (std::size_t body = 0; body < setup.bodies.size(); ++body)
        for (Index node : setup.bodies[body].nodes) owner[node] = static_cast<Index>(body);
    for (auto& [node, properties] : of_node) {
        if (owner[node] != none) {
            RigidBody& body = setup.bodies[owner[node]];
            if (body.own_inertia) continue; // the card speaks for all of the body
            properties.add({body.mass, body.center, body.body_inertia});
            const Vec3 velocity = body.velocity, spin = body.angular_velocity;
            const Vec3 moved = properties.center - body.center;
            give_properties(body, properties, state);
            give_velocity(body, velocity + cross(spin, moved), spin);
            continue;
        }
        const double mass = std::max(state.mass[node], 1e-200); // only to divide by
        RigidBody body = rigid_body_of(none, {&node, 1}, {&mass, 1}, {&state.inertia[node], 1}, state, {});
        properties.add_point(state.mass[node], state.position[node], state.inertia[node]);
        if (!(properties.mass > 0)) {
            throw DeckError({}, fmt::format("node {} has moments of inertia (*ELEMENT_INERTIA) but no mass",
                                            model.nodes.id[node]));
        }
        const Vec3 spin = state.angular_velocity[node];
        const Vec3 velocity = state.velocity[node] + cross(spin, properties.center - state.position[node]);
        give_properties(body, properties, state);
        give_velocity(body, velocity, spin);
        setup.bodies.push_back(std::move(body));
    }
}

} // namespace plash
