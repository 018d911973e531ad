#pragma once

#include "ale/hex/hex_lanes.h"
#include "ale/hex/hex_mesh.h"

namespace plash {

/// A mesh as batches of its nodes, faces and cells run through it: places and areas by column.
struct HexLayout {
    /// A corner of each node: the cell, and the derivative of its volume by the node. Nodes of a row have
    /// the cells of a row in the same column. Where there is none stands the cell beyond the last one, which
    /// is empty for ever.
    struct Corner {
        PlaceList cell;
        std::array<AlignedDoubles, 3> area; ///< [length^2]
    };
    std::vector<Corner> corners;
    AlignedDoubles corner_count;              ///< of each node
    std::array<AlignedDoubles, 3> outer_area; ///< of outer faces, outward, by node [length^2]

    std::array<PlaceList, 4> face_nodes;
    std::array<std::array<AlignedDoubles, 3>, 4> face_area; ///< of the faces' corners [length^2]

    std::array<PlaceList, 6> cell_faces; ///< of each cell: entry 2 axis + side
    std::array<PlaceList, 6> neighbours; ///< beyond these faces; the cell itself where the mesh ends
    std::array<PlaceList, 8> cell_nodes;
    std::array<AlignedDoubles, 3> width; ///< of cells [length]

    explicit HexLayout(const HexMesh& mesh);
    /// Areas and widths anew, of a mesh without closed faces whose nodes have moved.
    void measure(const HexMesh& mesh);
    /// Takes the areas of an outer face away: nothing passes it, and no pressure acts on it.
    void close(const HexMesh& mesh, std::size_t face);
};

} // namespace plash
