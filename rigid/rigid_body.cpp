#include "rigid/rigid_body.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

Matrix3 scaled(double factor, const Matrix3& a)
{
    return {{factor * a.row[0], factor * a.row[1], factor * a.row[2]}};
}

/// The part of a vector along the axes that are not held.
Vec3 free_part(const Vec3& vector, FreedomMask held, const std::array<Vec3, 3>& axes)
{
    Vec3 result = vector;
    for (int axis = 0; axis < 3; ++axis)
        if (held >> axis & 1) result -= dot(vector, axes[axis]) * axes[axis];
    return result;
}

/// Mass times (r^2 1 - r r^T).
Matrix3 point_inertia(double mass, const Vec3& arm)
{
    const double square = dot(arm, arm);
    Matrix3 result = scaled(-mass, dyad(arm, arm));
    for (int axis = 0; axis < 3; ++axis) result.row[axis] += mass * square * Matrix3::identity().row[axis];
    return result;
}

/// Lifts inertias that are (almost) zero. The trace bounds the largest principal inertia; adding a multiple
/// of the unit matrix moves all of them alike and changes a regular body only in the seventh figure, so it is
/// done for singular ones alone.
void lift_small_inertia(Matrix3& inertia)
{
    const double scale = inertia.row[0].x + inertia.row[1].y + inertia.row[2].z;
    if (scale <= 0 || determinant(inertia) > 1e-7 * scale * scale * scale) return;
    for (int axis = 0; axis < 3; ++axis) inertia.row[axis] += 1e-6 * scale * Matrix3::identity().row[axis];
}

} // namespace

RigidBody rigid_body_of(BodyNumber number, std::span<const Index> nodes, std::span<const double> mass,
                        std::span<const double> inertia, const State& state, const BodyFixity& fixity)
{
    RigidBody body;
    body.number = number;
    body.nodes.assign(nodes.begin(), nodes.end());
    body.fixity = fixity;
    Vec3 first_moment{}, momentum{};
    const Vec3 origin = state.position[nodes[0]]; // keeps figures when the model stands far from zero
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        body.mass += mass[i];
        first_moment += mass[i] * (state.position[nodes[i]] - origin);
        momentum += mass[i] * state.velocity[nodes[i]];
    }
    body.center = body.first_center = origin + (1 / body.mass) * first_moment;
    Vec3 angular_momentum{};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vec3 arm = state.position[nodes[i]] - body.center;
        body.arm.push_back(arm);
        body.body_inertia = body.body_inertia + point_inertia(mass[i], arm);
        const double own = inertia.empty() ? 0 : inertia[i];
        for (int axis = 0; axis < 3; ++axis)
            body.body_inertia.row[axis] += own * Matrix3::identity().row[axis];
        angular_momentum += mass[i] * cross(arm, state.velocity[nodes[i]]);
        if (own > 0 && state.rotational()) angular_momentum += own * state.angular_velocity[nodes[i]];
    }
    lift_small_inertia(body.body_inertia);
    const Vec3 spin = rotational_mobility(body, body.orientation) * angular_momentum;
    give_velocity(body, (1 / body.mass) * momentum, spin);
    if (fixity.freedoms >> 3 == 0) body.angular_momentum = angular_momentum; // to the last bit
    return body;
}

void give_velocity(RigidBody& body, const Vec3& velocity, const Vec3& angular_velocity)
{
    body.velocity = free_part(velocity, body.fixity.freedoms, body.fixity.axes);
    body.angular_velocity = free_part(angular_velocity, body.fixity.freedoms >> 3, body.fixity.axes);
    body.angular_momentum = spatial_inertia(body, body.orientation) * body.angular_velocity;
}

void MassProperties::add(const MassProperties& piece)
{
    const double total = mass + piece.mass;
    if (total <= 0) return;
    const Vec3 between = piece.center - center;
    inertia = inertia + piece.inertia + point_inertia(mass * piece.mass / total, between);
    center += (piece.mass / total) * between;
    mass = total;
}

void MassProperties::add_point(double point_mass, const Vec3& place, double own_inertia)
{
    add({point_mass, place, scaled(own_inertia, Matrix3::identity())});
}

MassProperties mass_properties_of(const PartInertia& card, const State& state)
{
    MassProperties properties;
    properties.mass = card.mass;
    properties.center = card.center_node == none ? card.center : state.position[card.center_node];
    const Matrix3 tensor{
        {{card.xx, card.xy, card.xz}, {card.xy, card.yy, card.yz}, {card.xz, card.yz, card.zz}}};
    const Matrix3 to_axes{{card.axes[0], card.axes[1], card.axes[2]}};
    properties.inertia = transpose(to_axes) * tensor * to_axes;
    return properties;
}

void give_properties(RigidBody& body, const MassProperties& properties, const State& state)
{
    const double node_mass = body.mass;
    const Vec3 node_moment = node_mass * (body.center - properties.center);
    body.center = body.first_center = properties.center;
    for (std::size_t i = 0; i < body.nodes.size(); ++i)
        body.arm[i] = state.position[body.nodes[i]] - body.center;
    body.mass = properties.mass;
    body.missing_mass = properties.mass - node_mass;
    body.missing_moment = -node_moment;
    body.body_inertia = properties.inertia;
    lift_small_inertia(body.body_inertia);
    body.own_inertia = true;
    give_velocity(body, body.velocity, body.angular_velocity);
}

Matrix3 spatial_inertia(const RigidBody& body, const Matrix3& orientation)
{
    return orientation * body.body_inertia * transpose(orientation);
}

Matrix3 translational_mobility(const RigidBody& body)
{
    Matrix3 result = scaled(1 / body.mass, Matrix3::identity());
    for (int axis = 0; axis < 3; ++axis) {
        if (!(body.fixity.freedoms >> axis & 1)) continue;
        const Vec3& a = body.fixity.axes[axis];
        result = result + scaled(-1 / body.mass, dyad(a, a));
    }
    return result;
}

Matrix3 rotational_mobility(const RigidBody& body, const Matrix3& orientation)
{
    const Matrix3 inertia = spatial_inertia(body, orientation);
    const double scale = inertia.row[0].x + inertia.row[1].y + inertia.row[2].z;
    const FreedomMask held = body.fixity.freedoms >> 3 & 7;
    if (scale == 0 || held == 7) return {};
    if (held == 0) return inverse(inertia);
    // In the axes of the fixity: rows and columns of held freedoms out, the rest inverted.
    const Matrix3 to_axes{{body.fixity.axes[0], body.fixity.axes[1], body.fixity.axes[2]}};
    Matrix3 reduced = to_axes * inertia * transpose(to_axes);
    for (int axis = 0; axis < 3; ++axis) {
        if (!(held >> axis & 1)) continue;
        for (int other = 0; other < 3; ++other) {
            reduced.row[axis].*vector_component[other] = other == axis ? scale : 0;
            reduced.row[other].*vector_component[axis] = other == axis ? scale : 0;
        }
    }
    Matrix3 mobility = inverse(reduced);
    for (int axis = 0; axis < 3; ++axis)
        if (held >> axis & 1) mobility.row[axis].*vector_component[axis] = 0;
    return transpose(to_axes) * mobility * to_axes;
}

Vec3 midpoint_angular_velocity(const RigidBody& body, const Vec3& angular_momentum, double step)
{
    Vec3 omega = body.angular_velocity;
    for (int iteration = 0; iteration < 20; ++iteration) {
        const Matrix3 middle = rotation(0.5 * step * omega) * body.orientation;
        const Vec3 next = rotational_mobility(body, middle) * angular_momentum;
        const double change = norm(next - omega);
        omega = next;
        if (change <= 1e-15 * norm(omega)) break;
    }
    return omega;
}

} // namespace plash
