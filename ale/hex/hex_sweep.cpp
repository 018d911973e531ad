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

void add_line(const HexMesh& mesh, HexSweep& sweep, const HexFace& face, int direction)
{
    const auto width = [&](Index cell) { return norm(mesh.edge[cell][axis_along(mesh, cell, direction)]); };
    const auto beside = [&](Index cell, int side) {
        const Index next = neighbour(mesh, cell, axis_along(mesh, cell, direction), side);
        return next == none ? cell : next;
    };
    const Index below = face.below != none ? face.below : face.above;
    const Index above = face.above != none ? face.above : face.below;
    const Index far_below = face.below != none ? beside(face.below, 0) : below;
    const Index far_above = face.above != none ? beside(face.above, 1) : above;
    const Pair low = cell_weights(width(far_below), width(below), width(above));
    const Pair high = cell_weights(width(below), width(above), width(far_above));
    sweep.lines.add({far_below, below, above, far_above}, {low.lower, low.upper, high.lower, high.upper});
    sweep.ends_below.push_back(face.below == none ? 1 : 0);
    sweep.ends_above.push_back(face.above == none ? 1 : 0);
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
    for (std::size_t i = 0; i < raw.size();) {
        const RawEdge& first = raw[i];
        const Index cell = sweep.members[first.member].cell;
        const Index far_below = next_node(mesh, cell, direction, 0, first.below);
        const Index far_above = next_node(mesh, cell, direction, 1, first.above);
        const double own = length(first.below, first.above);
        const double before = far_below == first.below ? own : length(far_below, first.below);
        const double after = far_above == first.above ? own : length(first.above, far_above);
        const Pair below = node_weights(before, own), above = node_weights(own, after);
        const std::size_t edge = sweep.edges.size;
        sweep.edges.add({far_below, first.below, first.above, far_above},
                        {below.lower, below.upper, above.lower, above.upper});
        for (std::size_t part = 0; i < raw.size() && raw[i].low == first.low && raw[i].high == first.high;
             ++i, ++part) {
            if (part == sweep.around_edge.size()) sweep.around_edge.emplace_back();
            HexSweep::Part& column = sweep.around_edge[part];
            column.member.place.resize(edge, 0);
            column.sign.resize(edge, 0.0);
            column.member.place.push_back(raw[i].member);
            column.sign.push_back(raw[i].below == first.below ? 1.0 : -1.0);
        }
    }
    for (HexSweep::Part& column : sweep.around_edge) {
        column.member.place.resize(sweep.edges.size, 0);
        column.member.pad(0);
        column.sign.resize(padded(sweep.edges.size), 0.0);
    }
    sweep.edges.pad();
}

void add_nodes(const HexMesh& mesh, HexSweep& sweep)
{
    const std::vector<Index>&from = sweep.edges.place[1].place, &to = sweep.edges.place[2].place;
    std::vector<Index> position(mesh.nodes(), none);
    for (std::size_t edge = 0; edge < sweep.edges.size; ++edge) position[from[edge]] = position[to[edge]] = 0;
    for (std::size_t node = 0; node < mesh.nodes(); ++node) {
        if (position[node] == none) continue;
        position[node] = static_cast<Index>(sweep.nodes.place.size());
        sweep.nodes.place.push_back(static_cast<Index>(node));
    }
    const std::size_t count = sweep.nodes.place.size();
    // Edges that leave stand in the first column and those that come in in the second one, so that rows of
    // nodes name rows of edges; only where chords meet in another way does a node need more.
    const auto give = [&](Index node, std::size_t edge, double sign, std::size_t column) {
        const Index at = position[node];
        while (true) {
            if (column >= sweep.at_node.size()) sweep.at_node.resize(column + 1);
            HexSweep::Flow& flow = sweep.at_node[column];
            flow.edge.place.resize(count, 0);
            flow.sign.resize(padded(count), 0.0);
            if (flow.sign[at] == 0) {
                flow.edge.place[at] = static_cast<Index>(edge);
                flow.sign[at] = sign;
                return;
            }
            column = std::max<std::size_t>(column + 1, 2);
        }
    };
    for (std::size_t edge = 0; edge < sweep.edges.size; ++edge) {
        give(from[edge], edge, -1, 0);
        give(to[edge], edge, 1, 1);
    }
    for (HexSweep::Flow& flow : sweep.at_node) {
        for (std::size_t at = 1; at < count; ++at)
            if (flow.sign[at] == 0)
                flow.edge.place[at] =
                    std::min(flow.edge.place[at - 1] + 1, static_cast<Index>(sweep.edges.size) - 1);
        flow.edge.pad(0);
    }
    for (std::size_t entry = 0; entry < sweep.lines.size; ++entry) {
        const std::size_t number = sweep.first_face + entry;
        const HexFace& face = mesh.faces[number];
        if (face.below != none && face.above != none) continue;
        for (Index node : face.nodes)
            sweep.ends.push_back(
                {position[node], static_cast<Index>(number), face.below == none ? 1.0 : -1.0});
    }
    sweep.nodes.pad(static_cast<Index>(mesh.nodes()));
}

} // namespace

std::vector<HexSweep> make_hex_sweeps(const HexMesh& mesh)
{
    std::vector<HexSweep> sweeps(mesh.directions);
    for (int direction = 0; direction < mesh.directions; ++direction) {
        HexSweep& sweep = sweeps[direction];
        for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
            const int axis = axis_along(mesh, static_cast<Index>(cell), direction);
            if (axis == 3) continue;
            sweep.members.push_back({static_cast<Index>(cell), axis});
            sweep.member_cell.place.push_back(static_cast<Index>(cell));
            sweep.low_face.place.push_back(mesh.cell_faces[cell][2 * axis]);
            sweep.high_face.place.push_back(mesh.cell_faces[cell][2 * axis + 1]);
        }
        sweep.member_cell.pad(static_cast<Index>(mesh.cells()));
        sweep.low_face.pad(static_cast<Index>(mesh.first_face[direction]));
        sweep.high_face.pad(static_cast<Index>(mesh.first_face[direction]));
        sweep.first_face = mesh.first_face[direction];
        for (std::size_t face = mesh.first_face[direction]; face < mesh.first_face[direction + 1]; ++face)
            add_line(mesh, sweep, mesh.faces[face], direction);
        sweep.lines.pad();
        sweep.ends_below.resize(padded(sweep.lines.size), 0.0);
        sweep.ends_above.resize(padded(sweep.lines.size), 0.0);
        add_edges(mesh, sweep, direction);
        add_nodes(mesh, sweep);
    }
    return sweeps;
}

} // namespace plash
