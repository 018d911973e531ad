#pragma once

#include "ale/box_grid.h"
#include "model/model.h"

#include <functional>

namespace plash {

/// A connected Eulerian mesh of a deck, in whatever order the deck numbers it. Where its cells stand between
/// three families of planes along the global axes, it is a box: cell and node (i, j, k) count from the lowest
/// corner, i fastest. Else it is made of general hexahedra.
struct MeshBlock {
    std::array<std::vector<double>, 3> planes; ///< of a box, ascending [length]
    std::vector<Index> nodes;                  ///< of the Model; of a box (nx + 1)(ny + 1)(nz + 1)
    std::vector<Index> solids;                 ///< elements of the Model; of a box nx ny nz
    /// Of general hexahedra: corners of each cell as positions in `nodes`; bits 0, 1, 2 of a corner's number
    /// say on which side along the cell's three axes it lies.
    std::vector<std::array<Index, 8>> corners;
    std::string why_no_box; ///< of general hexahedra, for a notice

    bool is_box() const { return corners.empty(); }
    int cells(int axis) const { return static_cast<int>(planes[axis].size()) - 1; }
    std::size_t cell(int i, int j, int k) const
    {
        return i + std::size_t(cells(0)) * (j + std::size_t(cells(1)) * k);
    }
    std::size_t node(int i, int j, int k) const
    {
        return i + std::size_t(cells(0) + 1) * (j + std::size_t(cells(1) + 1) * k);
    }
};

/// The Eulerian meshes of a Model, one entry for each that is connected through nodes. With
/// `boxes_as_hexahedra` none is taken as a box (for tests).
std::vector<MeshBlock> find_mesh_blocks(const Model& model, bool boxes_as_hexahedra = false);

/// Whether, and why, the mesh of these solids cannot be a box though it looks like one.
using WhyNoBox = std::function<std::string(const std::vector<Index>& solids)>;
std::vector<MeshBlock> find_mesh_blocks(const Model& model, const WhyNoBox& why_no_box);

} // namespace plash
