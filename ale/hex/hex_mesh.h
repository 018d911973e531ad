#pragma once

#include "math/vector3.h"
#include "model/model.h"

#include <array>
#include <cstddef>
#include <vector>

/// A mesh of hexahedra of any shape, of which any number may meet at an edge or a node, and how fluid is
/// swept through it.
namespace plash {

/// Corners of a cell, numbered by bits: bit d is set on the upper side of its axis d.
using HexCorners = std::array<Index, 8>;

/// A face between two cells of a chord, or at its end. Chords are the lines of cells that follow one another
/// through opposite faces; every face belongs to one of them and is crossed by it from `below` to `above`.
struct HexFace {
    Index below = none, above = none; ///< cells; none: the mesh ends here
    std::array<Index, 4> nodes{};
    std::array<Vec3, 4> area{}; ///< integrals of N_i n dA, n from below to above [length^2]
};

/// Cells and faces of a mesh.
struct HexMesh {
    std::vector<Vec3> position;      ///< of nodes at the start [length]
    std::vector<HexCorners> corners; ///< by cell; axes run along the chords
    std::vector<HexFace> faces;      ///< sorted by direction
    /// Faces of each cell: entry 2 axis + side.
    std::vector<std::array<Index, 6>> cell_faces;

    /// Chords have one of a few directions, so that the three chords of every cell have different ones: three
    /// in a block, one more for the rings of an O-grid. A sweep takes all chords of one direction.
    int directions = 0;
    std::vector<std::array<int, 3>> direction; ///< of each cell's axes
    std::vector<std::size_t> first_face;       ///< of each direction; one more entry for the end

    std::vector<double> volume;               ///< of cells [length^3]
    std::vector<std::array<Vec3, 3>> edge;    ///< mean of the four edges of a cell along each axis [length]
    std::vector<std::array<double, 3>> width; ///< volume over mean area across each axis [length]
    std::vector<std::size_t> first_corner;    ///< of each node in node_corner; one more entry for the end
    std::vector<Index> node_corner;           ///< 8 cell + corner, cells in rising order

    std::size_t cells() const { return corners.size(); }
    std::size_t nodes() const { return position.size(); }
    std::size_t cell_of_face(std::size_t face) const
    {
        return faces[face].below != none ? faces[face].below : faces[face].above;
    }
};

/// What is wrong with a mesh: the cell, and why.
struct HexDefect {
    std::size_t cell;
    const char* why;
};

/// Builds the mesh; throws HexDefect.
HexMesh make_hex_mesh(std::vector<Vec3> position, std::vector<HexCorners> corners);

/// Volumes, edges and widths of all cells; throws HexDefect.
void measure(HexMesh& mesh);

/// Numbers of the corners of the face on a side of an axis, so that a walk along their order goes around it.
std::array<int, 4> corners_of_face(int axis, int side);

} // namespace plash
