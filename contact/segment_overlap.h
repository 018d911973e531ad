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
/// and Papadopoulos 1991).
class SegmentOverlap {
public:
    /// Corners of a segment; a triangle repeats the third.
    using Corners = std::array<Vec3, 4>;
    /// Pressure from the active penetration, and the area that counts.
    struct Law {
        double stiffness = 0; ///< [pressure/length]
        double baseline = 0;  ///< penetration that gives no pressure [length]
        double rounding = 0;  ///< as rounded_force() [length]
        /// Areas of both segments at the start [area]. The overlap counts as large as it was there on the
        /// first segment (first_share) and on the second (the rest), since a face that is stretched or tilted
        /// under load must not be stiffer; but no segment for less than a quarter of its area.
        double first_size = 0, second_size = 0;
        double first_share = 0.5;
        double lateral = 1; ///< share of the forces across `normal` that is taken
    };
    struct Load {
        double force = 0;               ///< along `normal` on the first segment, and against it on the second
        double area = 0;                ///< over which there is pressure [area]
        double stiffness = 0;           ///< of that area [force/length]
        double energy = 0;              ///< of the pressure [energy]
        std::array<double, 4> first{};  ///< shares of the first segment's corners; they add up to 1
        std::array<double, 4> second{}; ///< of the second's
        /// Forces on the corners of the two: the energy's gradient, with its sign turned, as long as `normal`
        /// stays what it is (lateral = 1). Along `normal` they are the integrals of the pressure with the
        /// shape functions; across it they add up to nothing.
        std::array<Vec3, 4> on_first{}, on_second{};
        /// Of these forces, about any point [moment]: across `normal`, and the energy's gradient by a
        /// rotation of it.
        Vec3 moment{};
    };

    /// normal   unit, from the second segment to the first
    SegmentOverlap(const Corners& first, const Corners& second, const Vec3& normal, double gap);

    bool empty() const { return count_ == 0; }
    /// Looks from the other side: the normal turns round.
    void turn_round();
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
        double x, y;
    };
    /// A segment in the plane across `normal`, with heights along it.
    struct Shadow {
        std::array<Point2, 4> at;
        std::array<double, 4> height;
        bool triangle = false;
        double area = 0;
        /// Of the bilinear map p = s u + t v + s t twist: turn (1 or -1) is the way round of the corners,
        /// square = turn u x v, bend = turn v x twist.
        Point2 u, v, twist;
        double turn, square, bend;

        int sides() const { return triangle ? 3 : 4; }
    };
    static constexpr int no_side = -1;
    struct Corner {
        Point2 at;
        int side;        ///< from here to the next corner: 0 to 3 of the first segment, 4 to 7 of the second
        double distance; ///< of the two surfaces along `normal` [length]

        Corner() {} // all is set by the one who adds it
        Corner(const Point2& place, int from_here, double apart = 0)
            : at(place), side(from_here), distance(apart)
        {}
    };
    static constexpr int most_corners = 12; ///< of an overlap: four and four, one more by the edge of contact
    struct Polygon {
        std::array<Corner, most_corners + 1> corner;
        int count = 0;
    };
    template <class Lane>
    using Shares = std::array<Lane, 4>;
    /// Where on a segment a point of the plane is.
    template <class Lane>
    struct Place {
        Lane s, t;
        Shares<Lane> share;
    };
    /// Slope of a segment's height over the plane.
    template <class Lane>
    struct Slope {
        Lane x, y;
    };
    /// Forces in the plane (x, y) and along `normal`.
    struct CornerForces {
        std::array<Point2, 4> in_plane{};
        std::array<double, 4> along{};
    };
    struct Forces {
        CornerForces on[2];
        double energy = 0, force = 0;
    };

    Vec3 along_, beside_, normal_;
    Shadow first_, second_;
    double gap_ = 0;
    std::array<Corner, most_corners> vertex_; ///< `count_` of them
    int count_ = 0;
    double least_ = 1e300, most_ = -1e300; ///< distances of the vertices [length]

    template <class Lane>
    static Place<Lane> place_at(const Shadow& shadow, const Lane& x, const Lane& y);
    template <class Lane>
    static Slope<Lane> slope_at(const Shadow& shadow, const Place<Lane>& place);
    template <class Lane>
    static Lane height_at(const Shares<Lane>& share, const Shadow& shadow);
    Point2 middle() const;
    void clip();
    void measure();
    Polygon deeper_than(double baseline) const;
    /// Points on the sides that bound an overlap.
    struct SidePoints {
        static constexpr int room = 2 * (most_corners + 1);
        std::array<Point2, room> outward; ///< times the length of the part [length]
        std::array<int, room> side;
        int count = 0;
    };
    template <class Points>
    static double add_area_points(const Polygon& deep, Points& points);
    template <class Points>
    static SidePoints add_side_points(const Polygon& deep, Points& points);
    double press_area(const Polygon& deep, const Law& law, Forces& forces) const;
    void press_sides(const SidePoints& sides, const double* x, const double* y, const double* energy,
                     Forces& forces) const;
    static void scale_by_area(const Shadow& shadow, double size, double part, CornerForces& forces,
                              double energy);
    void balance(const Load& load, Forces& forces) const;
    void hand_over(const Forces& forces, Load& load) const;
};

} // namespace plash
