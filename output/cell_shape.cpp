#include "output/cell_shape.h"

#include <algorithm>

namespace plash {

namespace {

Cell make(CellShape shape, std::initializer_list<Index> corners)
{
    Cell cell{shape, {}, static_cast<int>(corners.size())};
    std::copy(corners.begin(), corners.end(), cell.corners.begin());
    return cell;
}

} // namespace

Cell shell_cell(const std::array<Index, 4>& n)
{
    for (int corner = 0; corner < 4; ++corner) { // leaves out the first of two neighbours that are one
        if (n[corner] != n[(corner + 1) % 4]) continue;
        return make(CellShape::triangle, {n[(corner + 1) % 4], n[(corner + 2) % 4], n[(corner + 3) % 4]});
    }
    return make(CellShape::quad, {n[0], n[1], n[2], n[3]});
}

Cell solid_cell(const std::array<Index, 8>& n)
{
    const bool top_is_a_point = n[4] == n[5] && n[5] == n[6] && n[6] == n[7];
    if (top_is_a_point && n[3] == n[4]) return make(CellShape::tetra, {n[0], n[1], n[2], n[3]});
    if (top_is_a_point && n[2] == n[3]) return make(CellShape::tetra, {n[0], n[1], n[2], n[4]});
    if (top_is_a_point) return make(CellShape::pyramid, {n[0], n[1], n[2], n[3], n[4]});
    // VTK's wedge: two triangles one after the other, the first one's normal pointing out.
    if (n[4] == n[5] && n[6] == n[7]) return make(CellShape::wedge, {n[0], n[1], n[4], n[3], n[2], n[6]});
    if (n[2] == n[3] && n[6] == n[7]) return make(CellShape::wedge, {n[0], n[2], n[1], n[4], n[6], n[5]});
    return make(CellShape::hexahedron, {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]});
}

} // namespace plash
