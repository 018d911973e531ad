#include "conditions/bag_surface.h"

#include "core/parallel.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace plash {

/// One side of one segment.
struct BagSurface::Edge {
    Index low, high; ///< its nodes by number
    Index segment;
    bool rising; ///< the segment runs from `low` to `high`

    bool same_nodes(const Edge& other) const { return low == other.low && high == other.high; }
};

namespace {

int corner_count(const SegmentNodes& segment)
{
    return segment[2] == segment[3] ? 3 : 4;
}

void turn(SegmentNodes& segment)
{
    if (corner_count(segment) == 3)
        std::swap(segment[0], segment[1]);
    else
        std::swap(segment[1], segment[3]);
}

/// Six times the volume of the tetrahedron of three points and the origin.
double triple(const Vec3& a, const Vec3& b, const Vec3& c)
{
    return dot(a, cross(b, c));
}

} // namespace

BagSurface::BagSurface(std::vector<SegmentNodes> segments, std::span<const Vec3> position)
    : segments_(std::move(segments))
{
    const std::vector<SegmentNodes> as_given = segments_;
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        const int count = corner_count(segments_[i]);
        for (int c = 0; c < count; ++c) {
            const Index a = segments_[i][c], b = segments_[i][(c + 1) % count];
            edges.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(i), a < b});
        }
    }
    std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return a.low != b.low ? a.low < b.low : a.high < b.high;
    });
    const std::vector<Index> piece = turn_alike(edges);
    find_holes(edges, piece);
    turn_outwards(piece, position);
    for (std::size_t i = 0; i < segments_.size(); ++i) turned_ += segments_[i] != as_given[i];
}

/// Walks from segment to segment over edges of two. Returns the piece that each segment belongs to.
std::vector<Index> BagSurface::turn_alike(const std::vector<Edge>& edges)
{
    struct Neighbour {
        Index segment;
        bool against; ///< both run along the edge the same way: one of them is the wrong way round
    };
    std::vector<std::vector<Neighbour>> beside(segments_.size());
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end].same_nodes(edges[i])) ++end;
        if (end - i == 2) {
            const bool against = edges[i].rising == edges[i + 1].rising;
            beside[edges[i].segment].push_back({edges[i + 1].segment, against});
            beside[edges[i + 1].segment].push_back({edges[i].segment, against});
        }
        if (end - i > 2) ++crossings_;
        i = end;
    }
    std::vector<Index> piece(segments_.size(), none), open;
    std::vector<std::uint8_t> turned(segments_.size());
    Index pieces = 0;
    for (std::size_t start = 0; start < segments_.size(); ++start) {
        if (piece[start] != none) continue;
        open = {static_cast<Index>(start)};
        piece[start] = pieces;
        while (!open.empty()) {
            const Index here = open.back();
            open.pop_back();
            for (const Neighbour& next : beside[here]) {
                if (piece[next.segment] != none) continue;
                piece[next.segment] = pieces;
                turned[next.segment] = turned[here] != next.against;
                open.push_back(next.segment);
            }
        }
        ++pieces;
    }
    // As many as can be stay as the deck has them: a flat piece has nothing else to go by.
    std::vector<Index> size(pieces), other_way(pieces);
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        ++size[piece[i]];
        other_way[piece[i]] += turned[i];
    }
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        if (2 * other_way[piece[i]] > size[piece[i]]) turned[i] = !turned[i];
        if (turned[i]) turn(segments_[i]);
    }
    return piece;
}

/// Groups edges of one segment that hang together.
void BagSurface::find_holes(const std::vector<Edge>& edges, const std::vector<Index>& piece)
{
    std::vector<std::array<Index, 2>> rims;
    std::vector<Index> piece_of_rim;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end].same_nodes(edges[i])) ++end;
        if (end - i == 1) {
            const SegmentNodes& segment = segments_[edges[i].segment]; // as it has been turned
            const int count = corner_count(segment);
            for (int c = 0; c < count; ++c) {
                const Index a = segment[c], b = segment[(c + 1) % count];
                if (std::min(a, b) == edges[i].low && std::max(a, b) == edges[i].high) rims.push_back({a, b});
            }
            piece_of_rim.push_back(piece[edges[i].segment]);
        }
        i = end;
    }
    std::map<std::pair<Index, Index>, std::vector<Index>> at_node; // by piece and node
    for (std::size_t i = 0; i < rims.size(); ++i)
        for (Index node : rims[i]) at_node[{piece_of_rim[i], node}].push_back(static_cast<Index>(i));
    std::vector<std::uint8_t> done(rims.size());
    for (std::size_t start = 0; start < rims.size(); ++start) {
        if (done[start]) continue;
        Hole hole{piece_of_rim[start], {}};
        std::vector<Index> open{static_cast<Index>(start)};
        done[start] = 1;
        while (!open.empty()) {
            const Index here = open.back();
            open.pop_back();
            hole.edges.push_back(rims[here]);
            for (Index node : rims[here])
                for (Index next : at_node[{piece_of_rim[here], node}])
                    if (!done[next]) {
                        done[next] = 1;
                        open.push_back(next);
                    }
        }
        holes_.push_back(std::move(hole));
    }
}

/// Turns whole pieces, with the rims of their holes, whose volume is negative.
void BagSurface::turn_outwards(const std::vector<Index>& piece, std::span<const Vec3> position)
{
    if (segments_.empty()) return;
    const Index pieces = *std::max_element(piece.begin(), piece.end()) + 1;
    const Vec3 origin = position[segments_[0][0]];
    std::vector<double> volume(pieces), area(pieces);
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        const auto forces = unit_pressure_forces(segments_[i], position);
        for (int c = 0; c < 4; ++c)
            volume[piece[i]] += dot(position[segments_[i][c]] - origin, forces[c]) / 3;
        area[piece[i]] += segment_area(segments_[i], position);
    }
    for (const Hole& hole : holes_) volume[hole.piece] += fan_volume(hole, origin, position);
    constexpr double flat = 1e-6; // volume over area^(3/2) of a sheet that round-off has bent
    const auto inside_out = [&](Index p) { return volume[p] < -flat * area[p] * std::sqrt(area[p]); };
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        if (inside_out(piece[i])) turn(segments_[i]);
    }
    for (Hole& hole : holes_)
        if (inside_out(hole.piece))
            for (auto& edge : hole.edges) std::swap(edge[0], edge[1]);
}

double BagSurface::fan_volume(const Hole& hole, const Vec3& origin, std::span<const Vec3> position)
{
    Vec3 middle{};
    for (const auto& edge : hole.edges) middle += 0.5 * (position[edge[0]] + position[edge[1]]);
    middle *= 1.0 / static_cast<double>(hole.edges.size());
    double sum = 0;
    for (const auto& edge : hole.edges)
        sum += triple(position[edge[1]] - origin, position[edge[0]] - origin, middle - origin);
    return sum / 6;
}

double BagSurface::volume(std::span<const Vec3> position,
                          std::span<const std::array<Vec3, 4>> unit_forces) const
{
    const Vec3 origin = position[segments_[0][0]]; // near, so that round-off stays small
    double sum = sum_chunks(segments_.size(), [&](std::size_t begin, std::size_t end) {
        double part = 0;
        for (std::size_t i = begin; i < end; ++i)
            for (int c = 0; c < 4; ++c) part += dot(position[segments_[i][c]] - origin, unit_forces[i][c]);
        return part;
    });
    sum /= 3;
    for (const Hole& hole : holes_) sum += fan_volume(hole, origin, position);
    return sum;
}

} // namespace plash
