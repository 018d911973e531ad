#pragma once

#include "contact/surface.h"
#include "core/state.h"

#include <array>
#include <functional>
#include <vector>

namespace plash {

/// Points of a structure's surface at which it meets the fluid. Each carries its share of its segment's area.
class CouplingPoints {
public:
    /// A point within its segment: bilinear weights of the corners, and the share of the area.
    struct Place {
        std::size_t segment;
        std::array<double, 4> weight;
        std::array<double, 4> along_s, along_t; ///< derivatives of the weights
        double share;                           ///< quadrature weight, in the segment's own coordinates
    };

    /// Position, velocity and area vector at t_n.
    struct Motion {
        Vec3 position, velocity;
        Vec3 area; ///< along the segment's normal [length^2]
    };

    /// per_edge   least number of points along an edge of a segment
    /// spacing    largest distance of the points along an edge between two places [length]
    CouplingPoints(Surface surface, int per_edge,
                   const std::function<double(const Vec3&, const Vec3&)>& spacing,
                   const std::vector<Vec3>& position);

    std::size_t size() const { return places_.size(); }
    const Place& place(std::size_t point) const { return places_[point]; }
    const std::array<Index, 4>& nodes(std::size_t point) const
    {
        return surface_.segments[places_[point].segment].nodes;
    }
    /// How far from the segment's plane the fluid meets it [length].
    double half_thickness(std::size_t point) const
    {
        return surface_.segments[places_[point].segment].half_thickness;
    }
    /// The points of a segment: from its first to that of the next one.
    std::size_t first_point(std::size_t segment) const { return first_[segment]; }
    Motion motion(std::size_t point, const State& state) const;
    const Surface& surface() const { return surface_; }

private:
    Surface surface_;
    std::vector<Place> places_;
    std::vector<std::size_t> first_; ///< point of each segment; one more entry for the end
};

} // namespace plash
