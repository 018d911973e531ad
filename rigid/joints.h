#pragma once

#include "core/state.h"
#include "model/model.h"
#include "rigid/body_rows.h"

namespace plash {

/// Where the rows of one joint are, and at which point its force is reported.
struct JointRows {
    Index joint = none; ///< into Model::joints
    std::size_t begin = 0, count = 0;
    Vec3 arm2{}; ///< of node 2 (or 1) from the center of the second body, in its axes
    bool failed = false;
};

/// Adds the conditions of a joint between two bodies to `rows`. Types and nodes as LS-DYNA draws them:
///   spherical     1, 2 one point
///   revolute      1, 2 one point; 1-3 and 2-4 one axis
///   cylindrical   1-3 and 2-4 one axis, along which the bodies slide
///   planar        1-3 normal to the plane in which the bodies slide and turn
///   universal     1, 2 one point; 1-3 and 2-4 stay at a right angle
///   constant_velocity 1, 2 one point; 1-3 and 2-4 the shafts, no relative rotation about the line that
///   halves
///                 their angle
///   translational 1-3 the axis of sliding, no relative rotation
///   locking       no relative motion
///   gears         1-3, 2-4 axes of the two wheels, omega1 = -PARM omega2 (PARM = R2 / R1)
///   pulley        as gears, omega1 = +PARM omega2
///   rack_and_pinion 1-3 axis of the pinion, 2-4 direction of the rack, velocity = PARM omega
///   screw         1-3 axis, relative velocity = PARM times relative angular velocity
///   motors        1-3 axis, relative velocity or angular velocity follow a curve (one row, the last one)
/// Points that do not lie where the drawing has them keep their distance of the start. DeckError when nodes
/// are missing, an axis has no length, or the type is none of these.
JointRows add_joint(const Model& model, Index joint, const std::vector<RigidBody>& bodies, Index first,
                    Index second, std::vector<BodyRow>& rows);

/// True when a joint lets go at n: its time is over, or the force and the moment about node 2 that it puts on
/// its second body, global axes, reach its strengths.
bool joint_fails(const JointFailure&, const Vec3& force, const Vec3& moment, const Model&, const State&,
                 double time);

} // namespace plash
