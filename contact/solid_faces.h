#pragma once

#include "model/model.h"

#include <vector>

namespace plash {

/// A face of a solid or thick shell (a brick of the Model) with its normal, by the order of nodes, pointing
/// out of it.
struct SolidFace {
    std::array<Index, 4> nodes{}; ///< a triangle repeats the third
    Index solid = none;
    Index neighbour = none; ///< the brick on the other side, `none` at the exterior of the Model
};

/// The nodes of a face sorted, the same for every first node and sense; a triangle repeats its largest node.
std::array<Index, 4> face_key(std::array<Index, 4> nodes);

/// Faces of one solid of LS-DYNA's node order; degenerate faces are left out.
void append_faces(const std::array<Index, 8>& nodes, Index solid, std::vector<SolidFace>& faces);

/// Faces of a ten-node tetrahedron, each in four triangles between its corners and mid-side nodes.
void append_ten_node_faces(const std::array<Index, 10>& nodes, Index solid, std::vector<SolidFace>& faces);

/// Every face of every brick with its neighbour, by rising brick.
std::vector<SolidFace> solid_faces(const Model& model);

} // namespace plash
