#pragma once

#include "math/vector3.h"

#include <limits>

namespace plash {

/// A region of *INITIAL_VOLUME_FRACTION_GEOMETRY: half space, cone, box or sphere.
struct Container {
    enum class Shape { half_space, cone, box, sphere };
    Shape shape = Shape::half_space;
    bool outside = false; ///< FILLOPT = 1: everything but the region
    int group = 0;        ///< that fills it, by the deck's order
    Vec3 velocity{};      ///< of what fills it [velocity]

    Vec3 origin{};                                          ///< on the plane; centre of the sphere; end 1 of
                                                            ///< the cone; a corner of the box
    Vec3 end{};                                             ///< end 2 of the cone, opposite corner
    Vec3 normal{0, 0, 1};                                   ///< of the half space, pointing into it; unit
    double radius = 0, end_radius = 0;                      ///< [length]
    Vec3 axis_x{1, 0, 0}, axis_y{0, 1, 0}, axis_z{0, 0, 1}; ///< of the box

    /// How far a point lies inside, negative outside; exact near the surface away from edges [length].
    double depth(const Vec3& point) const;
};

/// Share of a small box with half widths `half` about `centre` that lies in a container: exact where the
/// surface is a plane there, else of second order.
double share_inside(const Container& container, const Vec3& centre, const Vec3& half);

} // namespace plash
