#pragma once

#include "math/lanes.h"
#include "math/vector3.h"

#include <array>

namespace plash {

/// Where two segments lie over one another, seen along a direction, and how deep they are in one another
/// there.
///
/// Both are projected along `normal`; the part that their shadows share is a convex polygon (Sutherland and
/// Hodgman 1974, 'Reentrant polygon clipping'). Over it the penetration is gap less the distance of the two
/// bilinear surfaces along `normal`. Pressure that is integrated over the part with the shape functions of
/// both segments hands a constant pressure on exactly, whatever the two meshes (contact patch test, Taylor
/// and Papadopoulos 1991), and no force or moment is lost as both points of each pair lie on one line.
class SegmentOverlap {
public:
    /// Corners of a segment; a triangle repeats the third.
    using Corners = std::array<Vec3, 4>;
    /// Pressure from the active penetration.
    struct Law {
        double stiffness = 0; ///< [pressure/length]
        double baseline = 0;  ///< penetration that gives no pressure [length]
        double rounding = 0;  ///< as rounded_force() [length]
    };
    struct Load {
        double force = 0;               ///< along `normal` on the first segment, and against it on the second
        double area = 0;                ///< over which there is pressure [area]
        std::array<double, 4> first{};  ///< shares of the first segment's corners; they add up to 1
        std::array<double, 4> second{}; ///< of the second's
    };

    /// normal   unit, from the second segment to the first
    SegmentOverlap(const Corners& first, const Corners& second, const Vec3& normal, double gap);

    bool empty() const { return count_ == 0; }
    /// Looks from the other side: the normal turns round.
    void turn_round();
    /// Areas of the two shadows [area].
    double first_area() const { return first_.area; }
    double second_area() const { return second_.area; }
    /// Largest penetration [length]; negative if they are apart.
    double deepest() const { return gap_ - least_; }
    /// Largest penetration seen from the other side.
    double deepest_behind() const { return gap_ + most_; }
    /// Shares of the corners where the overlap has its middle.
    std::array<double, 4> first_middle() const;
    std::array<double, 4> second_middle() const;
    /// Shares of a load without force are those of the middle.
    Load load(const Law& law) const;

private:
    struct Point2 {
        double x = 0, y = 0;
    };
    /// A segment in the plane across `normal`, with heights along it.
    struct Shadow {
        std::array<Point2, 4> at;
        std::array<double, 4> height;
        bool triangle = false;
        double area = 0;
    };
    struct Vertex {
        Point2 at;
        double distance = 0; ///< of the two surfaces along `normal` [length]
    };
    static constexpr int most_corners = 12; ///< of an overlap: four and four, one more by the edge of contact
    template <class Lane>
    using Shares = std::array<Lane, 4>;

    Shadow first_, second_;
    double gap_ = 0;
    std::array<Vertex, most_corners> vertex_{};
    int count_ = 0;
    double least_ = 1e300, most_ = -1e300; ///< distances of the vertices [length]

    template <class Lane>
    static Shares<Lane> shares_at(const Shadow& shadow, const Lane& x, const Lane& y);
    template <class Lane>
    static Lane height_at(const Shares<Lane>& share, const Shadow& shadow);
    Point2 middle() const;
    void clip();
    void measure();
};

} // namespace plash
