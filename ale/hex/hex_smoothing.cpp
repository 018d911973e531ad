#include "ale/hex/hex_smoothing.h"

#include "conditions/segment_forces.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

/// A node's neighbour along an edge, and the cells that have both.
struct EdgeNeighbour {
    Index node;
    std::vector<Index> cells;

    bool shares_cell_with(const EdgeNeighbour& other) const
    {
        return std::any_of(cells.begin(), cells.end(), [&](Index cell) {
            return std::find(other.cells.begin(), other.cells.end(), cell) != other.cells.end();
        });
    }
};

std::vector<EdgeNeighbour> edge_neighbours(const HexMesh& mesh, std::size_t node)
{
    std::vector<EdgeNeighbour> neighbours;
    for (std::size_t i = mesh.first_corner[node]; i < mesh.first_corner[node + 1]; ++i) {
        const Index cell = mesh.node_corner[i] / 8, corner = mesh.node_corner[i] % 8;
        for (int axis = 0; axis < 3; ++axis) {
            const Index next = mesh.corners[cell][corner ^ (1 << axis)];
            auto known = std::find_if(neighbours.begin(), neighbours.end(),
                                      [&](const EdgeNeighbour& other) { return other.node == next; });
            if (known == neighbours.end()) known = neighbours.insert(known, {next, {}});
            known->cells.push_back(cell);
        }
    }
    return neighbours;
}

double shortest_edge(const HexMesh& mesh, std::size_t node, const std::vector<Vec3>& nodes)
{
    double square = 1e300;
    for (std::size_t i = mesh.first_corner[node]; i < mesh.first_corner[node + 1]; ++i) {
        const HexCorners& corners = mesh.corners[mesh.node_corner[i] / 8];
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 edge = nodes[corners[(mesh.node_corner[i] % 8) ^ (1 << axis)]] - nodes[node];
            square = std::min(square, dot(edge, edge));
        }
    }
    return std::sqrt(square);
}

} // namespace

/// Directions across the outer faces at a node, unit and across one another.
struct HexSmoothing::Walls {
    int count = 0;
    std::array<Vec3, 3> across{};

    void add(const Vec3& area)
    {
        // Faces of one plane differ by round-off alone; whatever differs more is a bend that has to stay.
        constexpr double bent = 1e-6;
        if (count == 3) return;
        const Vec3 rest = along(unit(area));
        if (norm(rest) > bent) across[count++] = unit(rest);
    }
    /// What of a vector lies within all walls.
    Vec3 along(Vec3 vector) const
    {
        for (int i = 0; i < count; ++i) vector -= dot(vector, across[i]) * across[i];
        return vector;
    }
};

HexSmoothing::HexSmoothing(const HexMesh& mesh, const std::vector<Index>& kept)
    : start_(mesh.position),
      kept_(mesh.nodes()),
      frames_(mesh.node_corner.size()),
      mirrored_(mesh.nodes(), -1),
      outer_number_(mesh.nodes(), none)
{
    for (std::size_t number = 0; number < mesh.faces.size(); ++number) {
        const HexFace& face = mesh.faces[number];
        if (face.below != none && face.above != none) continue;
        outer_faces_.push_back(static_cast<Index>(number));
        for (const Index node : face.nodes)
            if (outer_number_[node] == none) outer_number_[node] = static_cast<Index>(outer_nodes_++);
    }
    // Nodes of the sides that are held slide all the same: their mesh has to make room along the wall.
    for (const Index node : kept) kept_[node] = outer_number_[node] == none;
    for (std::size_t node = 0; node < mesh.nodes(); ++node) find_frame(mesh, node);
}

/// Logical axes of a node where, with mirrored cells for those beyond the mesh's sides, eight cells meet as
/// in a block: edges that share no cell are the two ends of an axis.
void HexSmoothing::find_frame(const HexMesh& mesh, std::size_t node)
{
    const std::vector<EdgeNeighbour> neighbours = edge_neighbours(mesh, node);
    std::vector<int> axis_of(neighbours.size(), -1), sign_of(neighbours.size(), 1);
    int axes = 0, mirrored = 0, missing = 0;
    for (std::size_t one = 0; one < neighbours.size(); ++one) {
        if (axis_of[one] >= 0) continue;
        if (axes == 3) return;
        axis_of[one] = axes;
        int opposite = 0;
        for (std::size_t other = 0; other < neighbours.size(); ++other) {
            if (other == one || neighbours[one].shares_cell_with(neighbours[other])) continue;
            if (++opposite > 1 || axis_of[other] >= 0) return;
            axis_of[other] = axes;
            sign_of[other] = -1;
        }
        if (opposite == 0) {
            mirrored |= 1 << axes;
            ++missing;
        }
        ++axes;
    }
    const std::size_t begin = mesh.first_corner[node], end = mesh.first_corner[node + 1];
    if (axes != 3 || (end - begin) << missing != 8) return;
    for (std::size_t i = begin; i < end; ++i) {
        const HexCorners& corners = mesh.corners[mesh.node_corner[i] / 8];
        int seen = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const Index next = corners[(mesh.node_corner[i] % 8) ^ (1 << axis)];
            const auto found = std::find_if(neighbours.begin(), neighbours.end(),
                                            [&](const EdgeNeighbour& other) { return other.node == next; });
            const std::ptrdiff_t number = found - neighbours.begin();
            frames_[i].axis[axis] = static_cast<std::int8_t>(axis_of[number]);
            frames_[i].sign[axis] = static_cast<std::int8_t>(sign_of[number]);
            seen |= 1 << axis_of[number];
        }
        if (seen != 7) return;
    }
    mirrored_[node] = static_cast<std::int8_t>(mirrored);
}

std::vector<HexSmoothing::Walls> HexSmoothing::walls_at(const HexMesh& mesh,
                                                        const std::vector<Vec3>& nodes) const
{
    std::vector<Walls> walls(outer_nodes_);
    for (const Index number : outer_faces_) {
        const HexFace& face = mesh.faces[number];
        const std::array<Vec3, 4> areas = unit_pressure_forces(face.nodes, nodes);
        for (const Index node : face.nodes)
            for (const Vec3& area : areas) walls[outer_number_[node]].add(area);
    }
    return walls;
}

Vec3 HexSmoothing::equipotential_way(const HexMesh& mesh, std::size_t node, const Walls& walls,
                                     const std::vector<Vec3>& nodes) const
{
    const std::size_t begin = mesh.first_corner[node], end = mesh.first_corner[node + 1];
    const double per_cell = 1.0 / static_cast<double>(end - begin); // with mirrors: eight cells in all
    // First and second derivatives along the axes, and mixed ones of the other two axes than their number.
    Vec3 first[3]{}, second[3]{}, mixed[3]{};
    for (std::size_t i = begin; i < end; ++i) {
        const HexCorners& corners = mesh.corners[mesh.node_corner[i] / 8];
        const int own = mesh.node_corner[i] % 8;
        const Frame& frame = frames_[i];
        for (int a = 0; a < 3; ++a) {
            const Vec3 arm = nodes[corners[own ^ (1 << a)]] - nodes[node];
            first[frame.axis[a]] += (per_cell * frame.sign[a]) * arm;
            second[frame.axis[a]] += (2 * per_cell) * arm;
            const int b = (a + 1) % 3;
            const Vec3 across = nodes[corners[own ^ (1 << a) ^ (1 << b)]] - nodes[node];
            mixed[3 - frame.axis[a] - frame.axis[b]] += (per_cell * frame.sign[a] * frame.sign[b]) * across;
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (!(mirrored_[node] >> axis & 1)) continue;
        // Of a derivative along an axis that a mirror ends, what lies within the mirror cancels.
        first[axis] -= walls.along(first[axis]);
        mixed[(axis + 1) % 3] = mixed[(axis + 2) % 3] = {};
    }
    const auto g = [&](int a, int b) { return dot(first[a], first[b]); };
    Vec3 sum{};
    double weight = 0;
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const double same = g(b, b) * g(c, c) - g(b, c) * g(b, c);  // det g times g^aa
        const double other = g(a, b) * g(a, c) - g(b, c) * g(a, a); // and g^bc
        sum += same * second[a] + (2 * other) * mixed[a];
        weight += 2 * same;
    }
    return weight > 0 ? (0.5 / weight) * sum : Vec3{};
}

Vec3 HexSmoothing::way_of(const HexMesh& mesh, const NodeSmoothing& by, std::size_t node, const Walls& walls,
                          const std::vector<Vec3>& nodes) const
{
    const std::size_t begin = mesh.first_corner[node], end = mesh.first_corner[node + 1];
    const double per_cell = 1.0 / static_cast<double>(end - begin);
    Vec3 average{}, by_volume{}, isoparametric{};
    double volume = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const Index cell = mesh.node_corner[i] / 8, own = mesh.node_corner[i] % 8;
        Vec3 all{}, alternating{};
        for (int other = 1; other < 8; ++other) {
            const Vec3 arm = nodes[mesh.corners[cell][own ^ other]] - nodes[node];
            all += arm;
            const bool across_face = other == 3 || other == 5 || other == 6;
            alternating += (across_face ? -1.0 : 1.0) * arm;
        }
        average += (per_cell / 7) * all;
        by_volume += (0.0625 * mesh.volume[cell]) * all;
        volume += mesh.volume[cell];
        isoparametric += (0.125 * per_cell) * alternating;
    }
    Vec3 way = by.average * average + (by.volume / volume) * by_volume + by.isoparametric * isoparametric;
    if (by.equipotential > 0) {
        const bool regular =
            mirrored_[node] >= 0 &&
            walls.count == (mirrored_[node] & 1) + (mirrored_[node] >> 1 & 1) + (mirrored_[node] >> 2);
        way += by.equipotential * (regular ? equipotential_way(mesh, node, walls, nodes) : average);
    }
    return (1 / std::max(by.sum(), 1.0)) * way;
}

void HexSmoothing::operator()(const HexMesh& mesh, const NodeSmoothing& by, std::vector<Vec3>& nodes) const
{
    if (!(by.sum() > 0)) return;
    if (by.back > 0) {
        for (std::size_t node = 0; node < mesh.nodes(); ++node)
            nodes[node] += by.back * (start_[node] - nodes[node]);
        return;
    }
    const std::vector<Walls> all_walls = walls_at(mesh, nodes);
    std::vector<Vec3> next = nodes;
    for_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t node = begin; node < end; ++node) {
            if (kept_[node]) continue;
            const Walls walls = outer_number_[node] == none ? Walls{} : all_walls[outer_number_[node]];
            if (walls.count == 3) continue;
            const Vec3 way = walls.along(way_of(mesh, by, node, walls, nodes));
            const double length = norm(way), most = 0.25 * shortest_edge(mesh, node, nodes);
            next[node] += (length > most ? most / length : 1.0) * way;
        }
    });
    nodes = std::move(next);
}

} // namespace plash
