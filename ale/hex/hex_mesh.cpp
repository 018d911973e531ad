#include "ale/hex/hex_mesh.h"

#include "conditions/segment_forces.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace plash {

namespace {

/// For each face of each cell, cell x 6 + face of the other cell that has it; none at the mesh's outside.
using Neighbours = std::vector<std::array<std::ptrdiff_t, 6>>;

struct FaceKey {
    std::array<Index, 4> nodes; ///< ascending
    std::ptrdiff_t place;       ///< cell x 6 + face
};

Neighbours find_neighbours(const std::vector<HexCorners>& corners)
{
    std::vector<FaceKey> keys;
    keys.reserve(6 * corners.size());
    for (std::size_t cell = 0; cell < corners.size(); ++cell) {
        for (int face = 0; face < 6; ++face) {
            FaceKey key{{}, static_cast<std::ptrdiff_t>(6 * cell + face)};
            const std::array<int, 4> around = corners_of_face(face / 2, face % 2);
            for (int n = 0; n < 4; ++n) key.nodes[n] = corners[cell][around[n]];
            std::sort(key.nodes.begin(), key.nodes.end());
            if (std::adjacent_find(key.nodes.begin(), key.nodes.end()) != key.nodes.end())
                throw HexDefect{cell, "a node appears twice among its corners"};
            keys.push_back(key);
        }
    }
    std::sort(keys.begin(), keys.end(), [](const FaceKey& a, const FaceKey& b) {
        return a.nodes != b.nodes ? a.nodes < b.nodes : a.place < b.place;
    });
    Neighbours neighbours(corners.size());
    for (auto& of_cell : neighbours) of_cell.fill(none);
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        if (keys[i].nodes != keys[i + 1].nodes) continue;
        const std::ptrdiff_t a = keys[i].place, b = keys[i + 1].place;
        if (a / 6 == b / 6 || neighbours[a / 6][a % 6] != none)
            throw HexDefect{static_cast<std::size_t>(b / 6), "more than two cells share one of its faces"};
        neighbours[a / 6][a % 6] = b;
        neighbours[b / 6][b % 6] = a;
    }
    return neighbours;
}

/// Where the chords run: number of the chord along each axis of each cell, and whether it runs against it.
struct Chords {
    std::vector<std::array<Index, 3>> of_cell;
    std::vector<std::array<bool, 3>> against;
    std::vector<std::vector<std::pair<Index, int>>> members; ///< cells and axes of each chord
};

double leading_component(const Vec3& v)
{
    const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
    return x >= y && x >= z ? v.x : y >= z ? v.y : v.z;
}

Vec3 mean_edge(const std::vector<Vec3>& position, const HexCorners& corners, int axis)
{
    Vec3 sum{};
    for (int corner = 0; corner < 8; ++corner)
        sum += (corner >> axis & 1 ? 0.25 : -0.25) * position[corners[corner]];
    return sum;
}

Chords find_chords(const std::vector<Vec3>& position, const std::vector<HexCorners>& corners,
                   const Neighbours& neighbours)
{
    Chords chords;
    chords.of_cell.assign(corners.size(), {none, none, none});
    chords.against.assign(corners.size(), {false, false, false});
    for (std::size_t seed = 0; seed < corners.size(); ++seed) {
        for (int seed_axis = 0; seed_axis < 3; ++seed_axis) {
            if (chords.of_cell[seed][seed_axis] != none) continue;
            const auto number = static_cast<Index>(chords.members.size());
            chords.members.emplace_back();
            const bool seed_against = leading_component(mean_edge(position, corners[seed], seed_axis)) < 0;
            // Up from the seed and, if that has not come round, down from it.
            for (const bool up : {true, false}) {
                std::size_t cell = seed;
                int axis = seed_axis;
                bool against = seed_against;
                while (true) {
                    if (up || cell != seed) {
                        if (chords.of_cell[cell][axis] == number) break; // a ring
                        for (int other = 0; other < 3; ++other)
                            if (chords.of_cell[cell][other] == number)
                                throw HexDefect{cell, "the line of cells through it crosses itself here"};
                        chords.of_cell[cell][axis] = number;
                        chords.against[cell][axis] = against;
                        chords.members[number].emplace_back(static_cast<Index>(cell), axis);
                    }
                    const int leave = 2 * axis + (up != against ? 1 : 0);
                    const std::ptrdiff_t next = neighbours[cell][leave];
                    if (next == none) break;
                    cell = next / 6;
                    axis = static_cast<int>(next % 6) / 2;
                    // Going up one enters through the lower side, unless the axis runs the other way.
                    against = (next % 2 == 1) == up;
                }
            }
        }
    }
    return chords;
}

/// Gives every chord a direction. Neighbouring chords have the same one where they can: a direction is handed
/// on through the faces of a cell along the edges that both cells share.
class Directions {
public:
    Directions(const HexMesh& mesh, const Neighbours& neighbours, const Chords& chords)
        : mesh_(mesh), chords_(chords), of_chord_(chords.members.size(), -1)
    {
        std::vector<bool> seen(mesh.cells());
        for (std::size_t seed = 0; seed < mesh.cells(); ++seed) {
            if (seen[seed]) continue;
            start(seed);
            std::queue<std::size_t> front;
            front.push(seed);
            seen[seed] = true;
            while (!front.empty()) {
                const std::size_t cell = front.front();
                front.pop();
                for (int face = 0; face < 6; ++face) {
                    const std::ptrdiff_t next = neighbours[cell][face];
                    if (next == none || seen[next / 6]) continue;
                    seen[next / 6] = true;
                    hand_on(cell, face, next);
                    front.push(next / 6);
                }
            }
        }
    }

    int operator()(Index chord) const { return of_chord_[chord]; }

private:
    const HexMesh& mesh_;
    const Chords& chords_;
    std::vector<int> of_chord_;

    /// Takes the wish if no chord that crosses this one has it, else the first free direction that nobody
    /// else wishes for.
    void choose(Index chord, int wish, const std::array<int, 3>& wishes)
    {
        if (of_chord_[chord] >= 0) return;
        std::vector<bool> taken(16, false);
        for (const auto& [cell, axis] : chords_.members[chord]) {
            for (int other = 0; other < 3; ++other) {
                if (other == axis) continue;
                const int direction = of_chord_[chords_.of_cell[cell][other]];
                if (direction < 0) continue;
                if (direction >= static_cast<int>(taken.size())) taken.resize(direction + 1, false);
                taken[direction] = true;
            }
        }
        int direction = wish;
        if (wish < static_cast<int>(taken.size()) && taken[wish]) {
            for (const int other : wishes)
                if (other < static_cast<int>(taken.size())) taken[other] = true;
            for (direction = 0; direction < static_cast<int>(taken.size()) && taken[direction];) ++direction;
        }
        of_chord_[chord] = direction;
    }

    /// In a block along the global axes, directions are x, y, z.
    void start(std::size_t cell)
    {
        int axes[3] = {0, 1, 2};
        int best[3] = {0, 1, 2};
        double most = -1;
        do {
            double along = 1;
            for (int axis = 0; axis < 3; ++axis) {
                const Vec3 edge = mean_edge(mesh_.position, mesh_.corners[cell], axis);
                along *= std::abs(axes[axis] == 0 ? edge.x : axes[axis] == 1 ? edge.y : edge.z);
            }
            if (along <= most) continue;
            most = along;
            std::copy(axes, axes + 3, best);
        } while (std::next_permutation(axes, axes + 3));
        for (int axis = 0; axis < 3; ++axis) choose(chords_.of_cell[cell][axis], best[axis], {0, 1, 2});
    }

    void hand_on(std::size_t cell, int face, std::ptrdiff_t next)
    {
        const HexCorners &own = mesh_.corners[cell], &theirs = mesh_.corners[next / 6];
        const int from = corners_of_face(face / 2, face % 2)[0];
        const auto number_in = [&](Index node) {
            return static_cast<int>(std::find(theirs.begin(), theirs.end(), node) - theirs.begin());
        };
        std::array<int, 3> wishes;
        for (int axis = 0; axis < 3; ++axis) wishes[axis] = of_chord_[chords_.of_cell[cell][axis]];
        for (int axis = 0; axis < 3; ++axis) {
            if (axis == face / 2) continue;
            const int changed = number_in(own[from]) ^ number_in(own[from ^ (1 << axis)]);
            const int other = changed == 1 ? 0 : changed == 2 ? 1 : 2;
            choose(chords_.of_cell[next / 6][other], wishes[axis], wishes);
        }
    }
};

/// Lets the axes of each cell run along its chords.
void turn_cells(HexMesh& mesh, Neighbours& neighbours, const Chords& chords)
{
    std::vector<int> flips(mesh.cells());
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
        for (int axis = 0; axis < 3; ++axis) flips[cell] |= chords.against[cell][axis] ? 1 << axis : 0;
    const auto turned = [&](std::ptrdiff_t place) {
        return place == none ? place : place ^ (flips[place / 6] >> (place % 6 / 2) & 1);
    };
    Neighbours before = neighbours;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
        HexCorners corners;
        for (int corner = 0; corner < 8; ++corner) corners[corner] = mesh.corners[cell][corner ^ flips[cell]];
        mesh.corners[cell] = corners;
        for (int face = 0; face < 6; ++face)
            neighbours[cell][face] = turned(before[cell][face ^ (flips[cell] >> (face / 2) & 1)]);
    }
}

Vec3 centre_of(const HexMesh& mesh, std::size_t cell)
{
    Vec3 sum{};
    for (Index node : mesh.corners[cell]) sum += 0.125 * mesh.position[node];
    return sum;
}

void add_face(HexMesh& mesh, std::vector<int>& direction, std::size_t cell, int face, Index below,
              Index above)
{
    HexFace made;
    made.below = below;
    made.above = above;
    const std::array<int, 4> around = corners_of_face(face / 2, face % 2);
    Vec3 middle{};
    for (int n = 0; n < 4; ++n) {
        made.nodes[n] = mesh.corners[cell][around[n]];
        middle += 0.25 * mesh.position[made.nodes[n]];
    }
    made.area = unit_pressure_forces(made.nodes, mesh.position);
    const Vec3 upward = (face % 2 == 1 ? 1.0 : -1.0) * (middle - centre_of(mesh, cell));
    Vec3 area{};
    for (const Vec3& part : made.area) area += part;
    if (dot(area, upward) < 0)
        for (Vec3& part : made.area) part = -1.0 * part;
    mesh.faces.push_back(made);
    direction.push_back(mesh.direction[cell][face / 2]);
}

void make_faces(HexMesh& mesh, const Neighbours& neighbours)
{
    std::vector<int> direction;
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
        const auto own = static_cast<Index>(cell);
        for (int axis = 0; axis < 3; ++axis) {
            if (neighbours[cell][2 * axis] == none) add_face(mesh, direction, cell, 2 * axis, none, own);
            const std::ptrdiff_t next = neighbours[cell][2 * axis + 1];
            add_face(mesh, direction, cell, 2 * axis + 1, own,
                     next == none ? none : static_cast<Index>(next / 6));
        }
    }
    std::vector<HexFace> sorted;
    sorted.reserve(mesh.faces.size());
    for (int wanted = 0; wanted < mesh.directions; ++wanted) {
        mesh.first_face.push_back(sorted.size());
        // Those at the beginning of chords first: then the others are numbered as the cells below them.
        for (const bool first : {true, false})
            for (std::size_t face = 0; face < mesh.faces.size(); ++face)
                if (direction[face] == wanted && (mesh.faces[face].below == none) == first)
                    sorted.push_back(mesh.faces[face]);
    }
    mesh.first_face.push_back(sorted.size());
    mesh.faces = std::move(sorted);
    mesh.cell_faces.resize(mesh.cells());
    for (int wanted = 0; wanted < mesh.directions; ++wanted) {
        for (std::size_t face = mesh.first_face[wanted]; face < mesh.first_face[wanted + 1]; ++face) {
            const HexFace& made = mesh.faces[face];
            for (const bool upper : {true, false}) {
                const Index cell = upper ? made.below : made.above;
                if (cell == none) continue;
                for (int axis = 0; axis < 3; ++axis)
                    if (mesh.direction[cell][axis] == wanted)
                        mesh.cell_faces[cell][2 * axis + upper] = static_cast<Index>(face);
            }
        }
    }
}

void list_corners_of_nodes(HexMesh& mesh)
{
    mesh.first_corner.assign(mesh.nodes() + 1, 0);
    for (const HexCorners& corners : mesh.corners)
        for (Index node : corners) ++mesh.first_corner[node + 1];
    for (std::size_t node = 0; node < mesh.nodes(); ++node)
        mesh.first_corner[node + 1] += mesh.first_corner[node];
    mesh.node_corner.resize(8 * mesh.cells());
    std::vector<std::size_t> next(mesh.first_corner.begin(), mesh.first_corner.end() - 1);
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
        for (int corner = 0; corner < 8; ++corner)
            mesh.node_corner[next[mesh.corners[cell][corner]]++] = static_cast<Index>(8 * cell + corner);
}

/// Volume by the divergence theorem, exact for faces that are bilinear. Returns what is wrong with the cell;
/// null: nothing.
const char* measure_cell(HexMesh& mesh, std::size_t cell)
{
    const Vec3 centre = centre_of(mesh, cell);
    double volume = 0;
    double across[3] = {};
    for (int axis = 0; axis < 3; ++axis) {
        mesh.edge[cell][axis] = mean_edge(mesh.position, mesh.corners[cell], axis);
        Vec3 mean{};
        for (int side = 0; side < 2; ++side) {
            const HexFace& face = mesh.faces[mesh.cell_faces[cell][2 * axis + side]];
            for (int n = 0; n < 4; ++n) {
                mean += 0.5 * face.area[n];
                volume +=
                    (side == 1 ? 1 : -1) / 3.0 * dot(face.area[n], mesh.position[face.nodes[n]] - centre);
            }
        }
        across[axis] = norm(mean);
    }
    if (!(volume > 0)) return "it has no positive volume";
    mesh.volume[cell] = volume;
    for (int axis = 0; axis < 3; ++axis) mesh.width[cell][axis] = volume / across[axis];
    // Every corner must see its three edges in the same sense of rotation.
    double lowest = 1e300, highest = -1e300;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 edge[3];
        for (int axis = 0; axis < 3; ++axis)
            edge[axis] =
                (corner >> axis & 1 ? -1.0 : 1.0) * (mesh.position[mesh.corners[cell][corner ^ (1 << axis)]] -
                                                     mesh.position[mesh.corners[cell][corner]]);
        const double jacobian = dot(edge[0], cross(edge[1], edge[2]));
        lowest = std::min(lowest, jacobian);
        highest = std::max(highest, jacobian);
    }
    if (lowest <= 0 && highest >= 0) return "it is turned inside out at a corner";
    return nullptr;
}

} // namespace

void measure(HexMesh& mesh)
{
    mesh.volume.resize(mesh.cells());
    mesh.edge.resize(mesh.cells());
    mesh.width.resize(mesh.cells());
    std::vector<HexDefect> defects((mesh.cells() + chunk_length - 1) / chunk_length, {0, nullptr});
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        HexDefect& defect = defects[begin / chunk_length];
        for (std::size_t cell = begin; cell < end && !defect.why; ++cell)
            defect = {cell, measure_cell(mesh, cell)};
    });
    for (const HexDefect& defect : defects)
        if (defect.why) throw defect;
}

std::array<int, 4> corners_of_face(int axis, int side)
{
    const int base = side << axis, a = 1 << ((axis + 1) % 3), b = 1 << ((axis + 2) % 3);
    return {base, base | a, base | a | b, base | b};
}

HexMesh make_hex_mesh(std::vector<Vec3> position, std::vector<HexCorners> corners)
{
    HexMesh mesh;
    mesh.position = std::move(position);
    mesh.corners = std::move(corners);
    Neighbours neighbours = find_neighbours(mesh.corners);
    const Chords chords = find_chords(mesh.position, mesh.corners, neighbours);
    const Directions directions(mesh, neighbours, chords);
    mesh.direction.resize(mesh.cells());
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
        for (int axis = 0; axis < 3; ++axis) {
            mesh.direction[cell][axis] = directions(chords.of_cell[cell][axis]);
            mesh.directions = std::max(mesh.directions, mesh.direction[cell][axis] + 1);
        }
    }
    turn_cells(mesh, neighbours, chords);
    make_faces(mesh, neighbours);
    measure(mesh);
    list_corners_of_nodes(mesh);
    return mesh;
}

} // namespace plash
