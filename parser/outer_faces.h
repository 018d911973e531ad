#pragma once

#include "model/model.h"

#include <array>
#include <vector>

namespace plash {

/// Faces of the solids for which `wanted` holds that belong to one of them only, corners in the order that
/// turns the normal outwards; a triangle repeats its third corner. Degenerate solids (wedges, tetrahedra)
/// included.
std::vector<std::array<Index, 4>> outer_faces(const Model& model, const std::vector<bool>& wanted);

} // namespace plash
