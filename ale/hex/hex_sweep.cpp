#include "ale/hex/hex_sweep.h"

#include <algorithm>

namespace plash {

namespace {

int axis_along(const HexMesh& mesh, Index cell, int direction)
{
    const auto& own = mesh.direction[cell];
    return static_cast<int>(std::find(own.begin(), own.end(), direction) - own.begin());
}

/// The next cell along the chord of an axis, on a side of it; none at its end.
Index neighbour(const HexMesh& mesh, Index cell, int axis, int side)
{
    const HexFace& face = mesh.faces[mesh.cell_faces[cell][2 * axis + side]];
    return side == 0 ? face.below : face.above;
}

/// Differences to the lower and the upper neighbour in the central difference across a zone.
struct Pair {
    double lower, upper;
};

/// before, own, after  widths of three cells
Pair cell_weights(double before, double own, double after)
{
    const double low = 0.5 * (before + own), high = 0.5 * (own + after);
    return {parabola_weight(own, low, high), parabola_weight(own, high, low)};
}

/// before, after  lengths of the edges that meet at a node
Pair node_weights(double before, double after)
{
    const double zone = 0.5 * (before + after);
    return {parabola_weight(zone, before, after), parabola_weight(zone, after, before)};
}

HexLine line_of_face(const HexMesh& mesh, const HexFace& face, int direction)
{
    const auto width = [&](Index cell) { return norm(mesh.edge[cell][axis_along(mesh, cell, direction)]); };
    const auto beside = [&](Index cell, int side) {
        const Index next = neighbour(mesh, cell, axis_along(mesh, cell, direction), side);
        return next == none ? cell : next;
    };
    HexLine line;
    line.below = face.below != none ? face.below : face.above;
    line.above = face.above != none ? face.above : face.below;
    line.far_below = face.below != none ? beside(face.below, 0) : line.below;
    line.far_above = face.above != none ? beside(face.above, 1) : line.above;
    const Pair below = cell_weights(width(line.far_below), width(line.below), width(line.above));
    const Pair above = cell_weights(width(line.below), width(line.above), width(line.far_above));
    line.weights = {below.lower, below.upper, above.lower, above.upper};
    return line;
}

/// The node that follows `node`, which lies on a side of a cell, along the chord in the next cell; itself at
/// the end of the chord.
Index next_node(const HexMesh& mesh, Index cell, int direction, int side, Index node)
{
    const Index next = neighbour(mesh, cell, axis_along(mesh, cell, direction), side);
    if (next == none) return node;
    const HexCorners& corners = mesh.corners[next];
    const auto corner = std::find(corners.begin(), corners.end(), node) - corners.begin();
    return corners[corner ^ (1 << axis_along(mesh, next, direction))];
}

/// An edge of a member, before edges that several members share have been joined.
struct RawEdge {
    Index low, high; ///< nodes in rising order, to sort by
    Index member;
    Index below, above; ///< in the order of the chord
};

void add_edges(const HexMesh& mesh, HexSweep& sweep, int direction)
{
    std::vector<RawEdge> raw;
    raw.reserve(4 * sweep.members.size());
    for (std::size_t member = 0; member < sweep.members.size(); ++member) {
        const auto [cell, axis] = sweep.members[member];
        for (int corner = 0; corner < 8; ++corner) {
            if (corner >> axis & 1) continue;
            const Index below = mesh.corners[cell][corner], above = mesh.corners[cell][corner | 1 << axis];
            raw.push_back(
                {std::min(below, above), std::max(below, above), static_cast<Index>(member), below, above});
        }
    }
    std::sort(raw.begin(), raw.end(), [](const RawEdge& a, const RawEdge& b) {
        return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.member < b.member;
    });
    const auto length = [&](Index a, Index b) { return norm(mesh.position[a] - mesh.position[b]); };
    sweep.around_edge.first.push_back(0);
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const RawEdge& first = raw[i];
        HexLine edge;
        const Index cell = sweep.members[first.member].cell;
        edge.below = first.below;
        edge.above = first.above;
        edge.far_below = next_node(mesh, cell, direction, 0, first.below);
        edge.far_above = next_node(mesh, cell, direction, 1, first.above);
        const double own = length(edge.below, edge.above);
        const double before = edge.far_below == edge.below ? own : length(edge.far_below, edge.below);
        const double after = edge.far_above == edge.above ? own : length(edge.above, edge.far_above);
        const Pair below = node_weights(before, own), above = node_weights(own, after);
        edge.weights = {below.lower, below.upper, above.lower, above.upper};
        sweep.edges.push_back(edge);
        for (; i < raw.size() && raw[i].low == first.low && raw[i].high == first.high; ++i)
            sweep.around_edge.entries.push_back({raw[i].member, raw[i].below == first.below ? 1.0 : -1.0});
        --i;
        sweep.around_edge.first.push_back(sweep.around_edge.entries.size());
    }
}

void add_nodes(const HexMesh& mesh, HexSweep& sweep)
{
    std::vector<std::vector<HexSweep::Flow>> flows(mesh.nodes());
    for (std::size_t edge = 0; edge < sweep.edges.size(); ++edge) {
        flows[sweep.edges[edge].below].push_back({static_cast<Index>(edge), -1, false});
        flows[sweep.edges[edge].above].push_back({static_cast<Index>(edge), 1, false});
    }
    for (std::size_t entry = 0; entry < sweep.lines.size(); ++entry) {
        const HexFace& face = mesh.faces[sweep.first_face + entry];
        if (face.below != none && face.above != none) continue;
        for (Index node : face.nodes)
            flows[node].push_back(
                {static_cast<Index>(sweep.first_face + entry), face.below == none ? 1.0 : -1.0, true});
    }
    sweep.at_node.first.push_back(0);
    for (std::size_t node = 0; node < flows.size(); ++node) {
        if (flows[node].empty()) continue;
        sweep.nodes.push_back(static_cast<Index>(node));
        sweep.at_node.entries.insert(sweep.at_node.entries.end(), flows[node].begin(), flows[node].end());
        sweep.at_node.first.push_back(sweep.at_node.entries.size());
    }
}

} // namespace

std::vector<HexSweep> make_hex_sweeps(const HexMesh& mesh)
{
    std::vector<HexSweep> sweeps(mesh.directions);
    for (int direction = 0; direction < mesh.directions; ++direction) {
        HexSweep& sweep = sweeps[direction];
        for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
            const int axis = axis_along(mesh, static_cast<Index>(cell), direction);
            if (axis < 3) sweep.members.push_back({static_cast<Index>(cell), axis});
        }
        sweep.first_face = mesh.first_face[direction];
        for (std::size_t face = mesh.first_face[direction]; face < mesh.first_face[direction + 1]; ++face)
            sweep.lines.push_back(line_of_face(mesh, mesh.faces[face], direction));
        add_edges(mesh, sweep, direction);
        add_nodes(mesh, sweep);
    }
    return sweeps;
}

} // namespace plash
