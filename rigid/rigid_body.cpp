#include "rigid/rigid_body.h"

#include <cmath>

namespace plash {

namespace {

Vec3 held(Vec3 vector, FreedomMask freedoms)
{
    if (freedoms & 1) vector.x = 0;
    if (freedoms & 2) vector.y = 0;
    if (freedoms & 4) vector.z = 0;
    return vector;
}

} // namespace

RigidBody rigid_body_of(Index part, std::span<const Index> nodes, std::span<const double> mass,
                        std::span<const double> inertia, const State& state, FreedomMask fixed)
{
    RigidBody body;
    body.part = part;
    body.nodes.assign(nodes.begin(), nodes.end());
    body.fixed = fixed;
    Vec3 first_moment{}, momentum{};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        body.mass += mass[i];
        first_moment += mass[i] * state.position[nodes[i]];
        momentum += mass[i] * state.velocity[nodes[i]];
    }
    body.center = (1 / body.mass) * first_moment;
    body.velocity = held((1 / body.mass) * momentum, fixed);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vec3 arm = state.position[nodes[i]] - body.center;
        body.arm.push_back(arm);
        const Matrix3 outer = dyad(arm, arm);
        const double square = dot(arm, arm);
        const double own = inertia.empty() ? 0 : inertia[i];
        for (int axis = 0; axis < 3; ++axis) {
            body.body_inertia.row[axis] +=
                (mass[i] * square + own) * Matrix3::identity().row[axis] - mass[i] * outer.row[axis];
        }
        body.angular_momentum += mass[i] * cross(arm, state.velocity[nodes[i]]);
        if (own > 0 && state.rotational()) {
            body.angular_momentum += own * state.angular_velocity[nodes[i]];
        }
    }
    body.angular_velocity = angular_velocity_of(body.body_inertia, body.angular_momentum, fixed >> 3);
    return body;
}

Matrix3 spatial_inertia(const RigidBody& body, const Matrix3& orientation)
{
    return orientation * body.body_inertia * transpose(orientation);
}

Vec3 angular_velocity_of(const Matrix3& inertia, const Vec3& angular_momentum, FreedomMask fixed)
{
    Matrix3 reduced = inertia;
    const double scale = inertia.row[0].x + inertia.row[1].y + inertia.row[2].z;
    if (scale == 0) return {};
    for (int axis = 0; axis < 3; ++axis) {
        if (!(fixed >> axis & 1)) continue;
        for (int other = 0; other < 3; ++other) {
            constexpr double Vec3::*component[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
            reduced.row[axis].*component[other] = other == axis ? scale : 0;
            reduced.row[other].*component[axis] = other == axis ? scale : 0;
        }
    }
    return inverse(reduced) * held(angular_momentum, fixed);
}

Vec3 midpoint_angular_velocity(const RigidBody& body, const Vec3& angular_momentum, double step)
{
    Vec3 omega = body.angular_velocity;
    for (int iteration = 0; iteration < 20; ++iteration) {
        const Matrix3 middle = rotation(0.5 * step * omega) * body.orientation;
        const Vec3 next =
            angular_velocity_of(spatial_inertia(body, middle), angular_momentum, body.fixed >> 3);
        const double change = norm(next - omega);
        omega = next;
        if (change <= 1e-15 * norm(omega)) break;
    }
    return omega;
}

} // namespace plash
