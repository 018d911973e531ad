#pragma once

#include "core/state.h"
#include "math/matrix3.h"
#include "model/rigid.h"

#include <span>
#include <vector>

namespace plash {

/// A rigid body: mass properties, which nodes it carries, and how it moves. Velocity and angular momentum
/// stand at half steps like nodal velocities; center and orientation stand at n, and at n+1 once the body has
/// moved. All of it is plain data: what a restart has to keep is below the line.
struct RigidBody {
    BodyNumber number = none; ///< none: a weld
    std::vector<Index> nodes;
    std::vector<Vec3> arm;    ///< of each node from the center, in body axes [length]
    double mass = 0;          ///< [mass]
    Matrix3 body_inertia{};   ///< about the center, in body axes [mass length^2]
    BodyFixity fixity;        ///< freedoms of the center that are held
    bool own_inertia = false; ///< mass properties of the deck (*PART_INERTIA), not of the nodes
    /// What the body's own mass has more than its nodes', and its first moment in body axes: body loads act
    /// on the nodes and need this correction [mass], [mass length].
    double missing_mass = 0;
    Vec3 missing_moment{};
    std::array<Vec3, 3> local_axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}; ///< LCO, in body axes
    Vec3 first_center{};
    /// Lumped, of each node; kept where the nodes may be set free again (welds) [mass], [mass length^2].
    std::vector<double> node_mass, node_inertia;

    // -- what changes
    bool released = false; ///< a weld that has failed: its nodes move by themselves
    Vec3 center{};
    Matrix3 orientation = Matrix3::identity(); ///< body axes to global axes
    Vec3 velocity{};
    Vec3 angular_momentum{};
    Vec3 angular_velocity{};
    Vec3 shown_center{}; ///< center at the last n, when the body has moved on to n+1 already
    Matrix3 shown_orientation = Matrix3::identity();
    Vec3 angle{};                ///< integral of the angular velocity up to that n (rbdout)
    Vec3 acceleration{};         ///< of the center: velocity change at n over its span [length/time^2]
    Vec3 last_body_load{};       ///< of *LOAD_BODY at the last n [length/time^2]
    Vec3 angular_acceleration{}; ///< [1/time^2]
    std::vector<Vec3> acceleration_of_node; ///< of each node [length/time^2]
};

/// The body that nodes with these masses make: properties from the lumped masses (and the rotational inertia
/// of shell nodes, when `inertia` is not empty), velocity and angular momentum from the nodes' velocities.
/// The caller checks mass. A principal inertia below 1e-6 of the largest (nodes on a line) is lifted to it:
/// nothing could turn the body about that axis, and round-off must not.
RigidBody rigid_body_of(BodyNumber number, std::span<const Index> nodes, std::span<const double> mass,
                        std::span<const double> inertia, const State& state, const BodyFixity& fixity);

/// Mass, center and inertia about the center in global axes.
struct MassProperties {
    double mass = 0;
    Vec3 center{};
    Matrix3 inertia{};

    /// Adds another piece (parallel axes).
    void add(const MassProperties& piece);
    void add_point(double point_mass, const Vec3& place, double own_inertia);
};

/// What a card (*PART_INERTIA and the like) says.
MassProperties mass_properties_of(const PartInertia& card, const State& state);

/// Replaces the mass properties that come from the nodes, arms included; the body's velocity stays and its
/// momenta follow.
void give_properties(RigidBody& body, const MassProperties& properties, const State& state);

/// Sets velocity and angular velocity of the center; held freedoms stay at rest.
void give_velocity(RigidBody& body, const Vec3& velocity, const Vec3& angular_velocity);

/// Inertia about the center in global axes, for an orientation.
Matrix3 spatial_inertia(const RigidBody& body, const Matrix3& orientation);

/// Velocity change of the center per impulse, and change of the angular velocity per angular impulse, with
/// the held freedoms at rest [1/mass], [1/(mass length^2)].
Matrix3 translational_mobility(const RigidBody& body);
Matrix3 rotational_mobility(const RigidBody& body, const Matrix3& orientation);

/// Angular velocity over a step by the implicit midpoint rule: the orientation at the middle of the step
/// decides, so that energy and momentum of a free body do not drift (time-reversible, second order; the
/// midpoint Lie algorithm of Simo & Wong 1991 and Krysl 2005 in momentum form).
Vec3 midpoint_angular_velocity(const RigidBody& body, const Vec3& angular_momentum, double step);

} // namespace plash
