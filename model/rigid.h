#pragma once

#include "model/conditions.h"
#include "model/mesh.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plash {

/// Rigid bodies are parts and nodal rigid bodies. Where the Model names a body it gives a *body number*: the
/// index of a part, or the number of parts plus the index of a nodal rigid body.
using BodyNumber = Index;

/// Freedoms of a body's center that are held, along and about axes that do not move.
struct BodyFixity {
    FreedomMask freedoms = 0;
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
};

/// *CONSTRAINED_NODAL_RIGID_BODY in all its forms.
struct NodalRigidBody {
    Id id = 0;
    std::string title;
    Location where;
    std::vector<Index> nodes;
    Index center_node = none; ///< PNODE: sits at the center of mass
    BodyFixity fixity;        ///< _SPC
    std::optional<PartInertia> inertia;
};

/// *CONSTRAINED_RIGID_BODIES: `follower` becomes part of `lead`.
struct RigidMerge {
    BodyNumber lead = none, follower = none;
    bool add_inertia = false; ///< IFLAG = 1: also where the lead has *PART_INERTIA
    Location where;
};

/// *CONSTRAINED_EXTRA_NODES: nodes that a body carries.
struct ExtraNodes {
    BodyNumber body = none;
    std::vector<Index> nodes;
    bool add_inertia = false; ///< IFLAG = 1: also where the body has *PART_INERTIA
    Location where;
};

/// *LOAD_RIGID_BODY: force at the center or moment scale * curve(t).
struct RigidBodyLoad {
    BodyNumber body = none;
    Vec3 direction{};                             ///< unit vector, global
    bool moment = false;                          ///< about `direction`
    std::array<Index, 3> plane{none, none, none}; ///< follower load: normal to the plane of these nodes
    Index curve = none;
    double scale = 1;
    Location where;
};

/// _FAILURE of a joint: it lets go at `end`, or once (force / strength)^2 + (moment / strength)^2, summed
/// over the components along `axes` that have a strength, reaches 1.
struct JointFailure {
    double end = forever; ///< TFAIL [time]
    bool coupled = true;  ///< COUPL <= 0; else the sums of forces and of moments count each by itself
    std::array<double, 3> force{}, moment{}; ///< NXX, NYY, NZZ; MXX, MYY, MZZ; 0: not looked at
    Index system = none;                     ///< CID: the axes; none: the global ones
};

/// *CONSTRAINED_JOINT_<type>: nodes 1, 3, 5 belong to the first body, 2, 4, 6 to the second.
struct Joint {
    enum class Type {
        spherical,
        revolute,
        cylindrical,
        planar,
        universal,
        translational,
        locking,
        constant_velocity,
        gears,
        pulley,
        rack_and_pinion,
        screw,
        translational_motor,
        rotational_motor
    };
    Id id = 0;
    std::string title;
    Type type = Type::spherical;
    std::array<Index, 6> nodes{none, none, none, none, none, none};
    bool by_places = false; ///< _COOR: `places` of two `bodies` in place of nodes
    std::array<Vec3, 6> places{};
    std::array<BodyNumber, 2> bodies{none, none};
    double parameter = 0;                                             ///< PARM: ratio or pitch per radian
    Index curve = none;                                               ///< of a motor
    PrescribedMotion::Kind motion = PrescribedMotion::Kind::velocity; ///< TYPE of a motor
    std::optional<JointFailure> failure;
    Location where;
};

/// *CONSTRAINED_JOINT_STIFFNESS_GENERALIZED / _TRANSLATIONAL: springs, dampers, friction and stops in the
/// freedoms of a joint, between axes in each of the two bodies.
struct JointStiffness {
    struct Freedom {
        Index stiffness_curve = none; ///< force or moment over displacement or angle (LCID..)
        Index damping_curve = none;   ///< over its rate (DLCID..)
        double elastic = 0;           ///< ES..: stiffness of friction and stops
        double friction = 0;          ///< FM.., FF..: limit of the friction [moment] or [force]
        Index friction_curve = none;  ///< where the field is negative
        double negative_stop = 0;     ///< NSA.. [radian] or NSD.. [length]; 0: none
        double positive_stop = 0;
    };
    Id id = 0;
    std::string title;
    bool translational = false;
    BodyNumber first = none, second = none;
    std::array<Vec3, 3> first_axes{}, second_axes{}; ///< at the start
    Vec3 first_origin{}, second_origin{};
    Index joint = none; ///< JID, for reports
    std::array<Freedom, 3> freedoms{};
    Location where;
};

} // namespace plash
