#pragma once

#include "core/state.h"
#include "math/matrix3.h"
#include "model/conditions.h"

#include <span>
#include <vector>

namespace plash {

/// A rigid body: mass properties, which nodes it carries, and how it moves. Velocity and angular momentum
/// stand at half steps like nodal velocities; center and orientation stand at n.
struct RigidBody {
    Index part = none;
    std::vector<Index> nodes;
    std::vector<Vec3> arm;  ///< of each node from the center, in body axes [length]
    double mass = 0;        ///< [mass]
    Matrix3 body_inertia{}; ///< about the center, in body axes [mass length^2]
    FreedomMask fixed = 0;  ///< global freedoms held at zero (CON1, CON2 with CMO = 1)

    Vec3 center{};
    Matrix3 orientation = Matrix3::identity(); ///< body axes to global axes
    Vec3 velocity{};
    Vec3 angular_momentum{};
    Vec3 angular_velocity{};

    std::vector<Vec3> acceleration; ///< of each node: velocity change at n over its span [length/time^2]
    Vec3 angular_acceleration{};    ///< of all of them [1/time^2]
};

/// The body that nodes with these masses make: properties from the lumped masses (and the rotational inertia
/// of shell nodes), velocity and angular momentum from the nodes' velocities. DeckError-free: the caller
/// checks mass.
RigidBody rigid_body_of(Index part, std::span<const Index> nodes, std::span<const double> mass,
                        std::span<const double> inertia, const State& state, FreedomMask fixed);

/// Inertia about the center in global axes, for an orientation.
Matrix3 spatial_inertia(const RigidBody& body, const Matrix3& orientation);

/// Angular velocity that belongs to an angular momentum when the rotations in `fixed` (global axes) are held.
Vec3 angular_velocity_of(const Matrix3& inertia, const Vec3& angular_momentum, FreedomMask fixed);

/// Angular velocity over a step by the implicit midpoint rule: the orientation at the middle of the step
/// decides, so that energy and momentum of a free body do not drift (time-reversible, second order).
Vec3 midpoint_angular_velocity(const RigidBody& body, const Vec3& angular_momentum, double step);

} // namespace plash
