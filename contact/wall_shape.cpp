#include "contact/wall_shape.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

/// One face of a convex body: the gaps to its plane (or mantle).
struct Face {
    double now, next;
    Vec3 normal;
};

/// Inside of all faces after the step: the face with the largest gap before it was passed.
template <std::size_t count>
WallMeeting meet_faces(const Face (&faces)[count])
{
    const Face* passed = &faces[0];
    for (const Face& face : faces) {
        if (face.next >= 0) return {};
        if (face.now > passed->now) passed = &face;
    }
    return {true, passed->now, passed->next, passed->normal};
}

Face plane(const Vec3& tail, const Vec3& normal, const Vec3& now, const Vec3& next)
{
    return {dot(now - tail, normal), dot(next - tail, normal), normal};
}

/// Within the edges of a finite plane; an edge of no length is endless.
bool within(const RigidWall& wall, const Vec3& place)
{
    const Vec3 from_tail = place - wall.tail;
    const double l = dot(from_tail, wall.edge), m = dot(from_tail, cross(wall.normal, wall.edge));
    return (wall.length[0] == 0 || (l >= 0 && l <= wall.length[0])) &&
           (wall.length[1] == 0 || (m >= 0 && m <= wall.length[1]));
}

WallMeeting meet_finite_plane(const RigidWall& wall, const Vec3& now, const Vec3& next)
{
    const Face face = plane(wall.tail, wall.normal, now, next);
    // Who has come round the edge stays behind the plane.
    const double slack = 1e-6 * std::max({wall.length[0], wall.length[1], norm(next - now)});
    if (face.next >= 0 || face.now < -slack || !within(wall, next)) return {};
    return {true, face.now, face.next, face.normal};
}

WallMeeting meet_prism(const RigidWall& wall, const Vec3& now, const Vec3& next)
{
    const Vec3 l = wall.edge, m = cross(wall.normal, wall.edge), n = wall.normal;
    const Face faces[] = {
        plane(wall.tail, n, now, next),  plane(wall.tail - wall.length[2] * n, -n, now, next),
        plane(wall.tail, -l, now, next), plane(wall.tail + wall.length[0] * l, l, now, next),
        plane(wall.tail, -m, now, next), plane(wall.tail + wall.length[1] * m, m, now, next)};
    return meet_faces(faces);
}

/// A cylinder around the normal through the tail, between its two ends when it has a length.
WallMeeting meet_cylinder(const RigidWall& wall, const Vec3& now, const Vec3& next)
{
    const Vec3& axis = wall.normal;
    const auto radial = [&](const Vec3& place) {
        const Vec3 arm = place - wall.tail;
        return arm - dot(arm, axis) * axis;
    };
    const Vec3 arm_next = radial(next);
    const double radius_now = norm(radial(now)), radius_next = norm(arm_next);
    const Vec3 outward = radius_next > 0 ? (1 / radius_next) * arm_next : wall.edge;
    if (wall.interior) {
        const double along = dot(next - wall.tail, axis);
        if (wall.length[0] > 0 && (along < 0 || along > wall.length[0])) return {};
        const Face mantle[] = {{wall.radius - radius_now, wall.radius - radius_next, -outward}};
        return meet_faces(mantle);
    }
    const Face mantle{radius_now - wall.radius, radius_next - wall.radius, outward};
    if (wall.length[0] == 0) {
        const Face alone[] = {mantle};
        return meet_faces(alone);
    }
    const Face faces[] = {mantle, plane(wall.tail, -axis, now, next),
                          plane(wall.tail + wall.length[0] * axis, axis, now, next)};
    return meet_faces(faces);
}

WallMeeting meet_sphere(const RigidWall& wall, const Vec3& now, const Vec3& next)
{
    const Vec3 arm = next - wall.tail;
    const double distance = norm(arm);
    const Vec3 outward = distance > 0 ? (1 / distance) * arm : wall.normal;
    const Face face[] = {{norm(now - wall.tail) - wall.radius, distance - wall.radius, outward}};
    return meet_faces(face);
}

} // namespace

WallMeeting meet(const RigidWall& wall, const Vec3& now, const Vec3& next)
{
    switch (wall.shape) {
    case RigidWall::Shape::plane: {
        const Face face[] = {plane(wall.tail, wall.normal, now, next)};
        return meet_faces(face);
    }
    case RigidWall::Shape::finite_plane:
        return meet_finite_plane(wall, now, next);
    case RigidWall::Shape::prism:
        return meet_prism(wall, now, next);
    case RigidWall::Shape::cylinder:
        return meet_cylinder(wall, now, next);
    case RigidWall::Shape::sphere:
        return meet_sphere(wall, now, next);
    }
    return {};
}

} // namespace plash
