#pragma once

#include "ale/container.h"
#include "ale/fluid.h"

#include <array>

namespace plash {

/// A piece of a cell, as a box along the global axes that reaches as far as the piece.
struct CellPiece {
    Vec3 centre, half; ///< [length]
    double volume;     ///< up to a factor
};

/// Pieces along each axis of a cell that a surface passes.
inline constexpr int cell_cuts = 8;

/// Piece (i, j, k) of `cuts` along each axis of a cell.
CellPiece piece_of_cell(const FluidCell& cell, bool is_box, int cuts, const std::array<int, 3>& number);

/// Whether the surface of a container may pass a cell.
bool passes_cell(const Container& container, const FluidCell& cell, bool is_box);

/// Share of a hexahedron in a container, by its pieces as at the start: exact for planes where the
/// hexahedron is a parallelepiped, else of second order.
double share_of_cell(const Container& container, const FluidCell& cell);

} // namespace plash
