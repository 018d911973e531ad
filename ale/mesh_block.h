#pragma once

#include "ale/box_grid.h"
#include "model/model.h"

namespace plash {

/// A connected Eulerian mesh of a deck whose cells stand between three families of planes along the global
/// axes, in whatever order the deck numbers them. Cell and node (i, j, k) count from the lowest corner, i
/// fastest.
struct MeshBlock {
    std::array<std::vector<double>, 3> planes; ///< ascending [length]
    std::vector<Index> nodes;                  ///< of the Model, (nx + 1)(ny + 1)(nz + 1)
    std::vector<Index> solids;                 ///< elements of the Model, nx ny nz

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

/// The Eulerian meshes of a Model, one entry for each that is connected through nodes. DeckError where a mesh
/// is not such a block.
std::vector<MeshBlock> find_mesh_blocks(const Model& model);

} // namespace plash
