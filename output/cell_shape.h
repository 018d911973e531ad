#pragma once

#include "model/mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plash {

/// What shape an element has once repeated corners are taken as one.
enum class CellShape : std::uint8_t {
    vertex = 1,
    triangle = 5,
    quad = 9,
    tetra = 10,
    hexahedron = 12,
    wedge = 13,
    pyramid = 14,
    quadratic_tetra = 24
};

/// A cell as VTK wants it; the values of CellShape are VTK's numbers of the types.
struct Cell {
    CellShape shape;
    std::array<Index, 10> corners; ///< as many as the shape has
    int corner_count;

    std::span<const Index> used() const { return {corners.data(), static_cast<std::size_t>(corner_count)}; }
};

/// Triangles repeat the third corner (or, from some meshers, another one).
Cell shell_cell(const std::array<Index, 4>& nodes);

/// A particle.
inline Cell vertex_cell(Index node)
{
    return {CellShape::vertex, {node}, 1};
}

/// LS-DYNA's degenerate solids: tetrahedron n1 n2 n3 n4 n4 n4 n4 n4 (or n1 n2 n3 n3 n5 n5 n5 n5), pyramid n5
/// = ... = n8, wedge n5 = n6 and n7 = n8 (or n3 = n4 and n7 = n8). Any other repetition stays a hexahedron.
Cell solid_cell(const std::array<Index, 8>& nodes);

/// Ten-node tetrahedra have their nodes in VTK's order.
inline Cell tetrahedron_cell(const std::array<Index, 10>& nodes)
{
    return {CellShape::quadratic_tetra, nodes, 10};
}

} // namespace plash
