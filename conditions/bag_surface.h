#pragma once

#include "conditions/segment_forces.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// The surface around a control volume. Segments that share an edge are turned the same way, and each piece
/// of the surface outwards (a flat piece, which has no outside, stays as the deck has it). The edges that
/// only one segment has are grouped into holes; each hole is closed by a fan about the mean of its nodes, so
/// that the surface has a volume; two sheets that meet without sharing nodes have fans that cancel.
class BagSurface {
public:
    BagSurface() = default;
    BagSurface(std::vector<SegmentNodes> segments, std::span<const Vec3> position);

    const std::vector<SegmentNodes>& segments() const { return segments_; }

    /// Volume inside; `unit_forces` are unit_pressure_forces of each segment: the sum of x . N_i n dA over
    /// all corners and the fans, a third of it, exact for bilinear segments [volume].
    double volume(std::span<const Vec3> position, std::span<const std::array<Vec3, 4>> unit_forces) const;

    std::size_t turned() const { return turned_; } ///< segments that the deck has the other way round
    std::size_t hole_count() const { return holes_.size(); }
    std::size_t crossings() const { return crossings_; } ///< edges of three and more segments

private:
    struct Hole {
        Index piece = 0;
        std::vector<std::array<Index, 2>> edges; ///< as their segments run
    };
    std::vector<SegmentNodes> segments_;
    std::vector<Hole> holes_;
    std::size_t turned_ = 0, crossings_ = 0;

    struct Edge;
    std::vector<Index> turn_alike(const std::vector<Edge>& edges);
    void find_holes(const std::vector<Edge>& edges, const std::vector<Index>& piece);
    void turn_outwards(const std::vector<Index>& piece, std::span<const Vec3> position);
    static double fan_volume(const Hole& hole, const Vec3& origin, std::span<const Vec3> position);
};

} // namespace plash
