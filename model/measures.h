#pragma once

#include "math/vector3.h"
#include "model/record.h"

#include <array>
#include <vector>

namespace plash {

/// Volume of a hexahedron or one of its degenerate forms (Grandy 1997, sum of tetrahedra) [length^3].
double solid_volume(const std::array<Index, 8>& nodes, const std::vector<Vec3>& position);
/// Area of a quadrilateral or triangle [length^2].
double segment_area(const std::array<Index, 4>& nodes, const std::vector<Vec3>& position);

} // namespace plash
