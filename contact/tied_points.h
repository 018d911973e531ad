#pragma once

#include "contact/surface.h"

namespace plash {

/// A node that is held at a point over a segment: x = sum phi_i(s, t) x_i + height n(s, t), with the
/// segment's shape functions and its unit normal there. The height goes along with the segment when it turns,
/// so an offset tie neither resists nor loses rigid rotation.
struct TiedPoint {
    Index node = none;             ///< State index
    std::array<Index, 4> corner{}; ///< State indices; a triangle repeats the third
    Index segment = none;          ///< of the master surface
    Index slave = none;            ///< of the slave surface's nodes
    double s = 0, t = 0;
    double height = 0; ///< signed, along the segment's normal [length]
    double size = 0;   ///< of the segment [length]

    bool triangle() const { return corner[3] == corner[2]; }
};

/// Shape functions of a segment and their derivatives at (s, t).
struct TieShape {
    std::array<double, 4> value{}, along_s{}, along_t{};

    TieShape() = default;
    TieShape(double s, double t, bool triangle);
};

/// Where the corners of a segment put a point that is tied to it, and how they turn what is fixed to it.
struct TieFrame {
    Vec3 place{};    ///< of the point on the segment, without the height [length]
    Vec3 g1{}, g2{}; ///< tangents d x / ds, d x / dt
    Vec3 normal{};   ///< unit; zero for a degenerate segment
    double area = 0; ///< |g1 x g2|

    TieFrame(const TieShape& shape, const std::array<Vec3, 4>& corners);
};

/// Velocity of the tied point and angular velocity of the segment there, from its corners' velocities.
struct TieRates {
    Vec3 velocity{}, spin{};
};
TieRates tie_rates(const TieShape& shape, const TieFrame& frame, double height,
                   const std::array<Vec3, 4>& corner_velocity);

/// Corner forces that do the same work as `force` at the tied point and `moment` on the segment there: the
/// transpose of tie_rates. They have the same resultant and the same moment about any point, as the map does
/// not see rigid motion.
std::array<Vec3, 4> spread_to_corners(const TieShape& shape, const TieFrame& frame, double height,
                                      const Vec3& force, const Vec3& moment);

/// Points found for a tied contact, and the nodes that lie over no segment or too far from it.
struct TieSearch {
    std::vector<TiedPoint> points; ///< by rising node
    std::vector<Index> left_out;   ///< State indices
};

/// Ties each slave node to the closest master segment that it lies over, if it is not farther than LS-DYNA
/// takes: 0.6 (thickness of node + thickness of segment) or, where that is more, 0.05 of the segment's
/// shorter diagonal; a negative SST or MST gives the thicknesses by its absolute value and leaves out the
/// diagonal (keyword manual, *CONTACT, remarks on tied contact).
TieSearch find_tied_points(const Surface& slave, const Surface& master, const Contact& contact,
                           const std::vector<Vec3>& position);

/// Values of a nodal field at the corners of a point's segment.
inline std::array<Vec3, 4> at_corners(const std::vector<Vec3>& field, const TiedPoint& point)
{
    return {field[point.corner[0]], field[point.corner[1]], field[point.corner[2]], field[point.corner[3]]};
}

} // namespace plash
