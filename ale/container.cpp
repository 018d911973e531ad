#include "ale/container.h"

#include "ale/plane_in_cell.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

double depth_in_cone(const Container& cone, const Vec3& point)
{
    const Vec3 axis = cone.end - cone.origin;
    const double length = norm(axis);
    const Vec3 along = (1 / length) * axis;
    const Vec3 reach = point - cone.origin;
    const double height = dot(reach, along);
    const double radial = norm(reach - height * along);
    const double slope = (cone.end_radius - cone.radius) / length;
    const double lateral = (cone.radius + slope * height - radial) / std::sqrt(1 + slope * slope);
    return std::min({height, length - height, lateral});
}

double depth_in_box(const Container& box, const Vec3& point)
{
    const Vec3 centre = 0.5 * (box.origin + box.end), diagonal = box.end - box.origin;
    const Vec3 reach = point - centre;
    double depth = std::numeric_limits<double>::infinity();
    for (const Vec3* axis : {&box.axis_x, &box.axis_y, &box.axis_z})
        depth = std::min(depth, 0.5 * std::abs(dot(diagonal, *axis)) - std::abs(dot(reach, *axis)));
    return depth;
}

bool along_global_axes(const Container& box)
{
    return box.axis_x.x == 1 && box.axis_y.y == 1 && box.axis_z.z == 1;
}

/// Share of the interval centre - half .. centre + half between two ends.
double overlap(double centre, double half, double end, double other_end)
{
    const double low = std::max(centre - half, std::min(end, other_end));
    const double high = std::min(centre + half, std::max(end, other_end));
    const double share = std::max(high - low, 0.0) / (2 * half);
    return share > 1 - 1e-12 ? 1 : share;
}

} // namespace

double Container::depth(const Vec3& point) const
{
    double inside = 0;
    switch (shape) {
    case Shape::half_space:
        inside = dot(point - origin, normal);
        break;
    case Shape::cone:
        inside = depth_in_cone(*this, point);
        break;
    case Shape::box:
        inside = depth_in_box(*this, point);
        break;
    case Shape::sphere:
        inside = radius - norm(point - origin);
        break;
    }
    return outside ? -inside : inside;
}

double share_inside(const Container& container, const Vec3& centre, const Vec3& half)
{
    if (container.shape == Container::Shape::box && along_global_axes(container)) {
        const double inside = overlap(centre.x, half.x, container.origin.x, container.end.x) *
                              overlap(centre.y, half.y, container.origin.y, container.end.y) *
                              overlap(centre.z, half.z, container.origin.z, container.end.z);
        return container.outside ? 1 - inside : inside;
    }
    const double here = container.depth(centre);
    const Vec3 x{half.x, 0, 0}, y{0, half.y, 0}, z{0, 0, half.z};
    // Change of the depth over the box along each axis: the plane's normal in the box's own coordinates.
    const Vec3 change{0.5 * std::abs(container.depth(centre + x) - container.depth(centre - x)),
                      0.5 * std::abs(container.depth(centre + y) - container.depth(centre - y)),
                      0.5 * std::abs(container.depth(centre + z) - container.depth(centre - z))};
    const double sum = change.x + change.y + change.z;
    if (std::abs(here) >= sum || sum == 0) return here > 0 ? 1 : 0;
    return volume_below_plane((1 / sum) * change, 0.5 + 0.5 * here / sum);
}

} // namespace plash
