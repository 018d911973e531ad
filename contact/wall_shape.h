#pragma once

#include "model/conditions.h"

namespace plash {

/// How deep a point would lie in a rigid wall after a step, and where the wall pushes it.
struct WallMeeting {
    bool inside = false; ///< the point would lie behind the surface
    double now = 0;      ///< gap before the step along `normal` [length]
    double next = 0;     ///< gap after it, negative inside [length]
    Vec3 normal{};       ///< unit, out of the wall
};

/// Meets a point with a wall. A body of several faces pushes a point out of the face through which it came.
/// now, next  places before and after the step, relative to the wall's own motion (as if it stood at its
/// start)
WallMeeting meet(const RigidWall& wall, const Vec3& now, const Vec3& next);

} // namespace plash
