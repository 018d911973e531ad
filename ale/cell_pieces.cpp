#include "ale/cell_pieces.h"

#include <cmath>

namespace plash {

namespace {

Vec3 magnitudes(const Vec3& v)
{
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

} // namespace

CellPiece piece_of_cell(const FluidCell& cell, bool is_box, int cuts, const std::array<int, 3>& number)
{
    if (is_box) {
        const Vec3 &low = cell.points[0], &high = cell.points[7];
        const Vec3 centre{0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)};
        const Vec3 half{0.5 * (high.x - low.x), 0.5 * (high.y - low.y), 0.5 * (high.z - low.z)};
        const Vec3 part = (1.0 / cuts) * half;
        return {{centre.x - half.x + (2 * number[0] + 1) * part.x,
                 centre.y - half.y + (2 * number[1] + 1) * part.y,
                 centre.z - half.z + (2 * number[2] + 1) * part.z},
                part,
                1};
    }
    Vec3 centre{}, slope[3]{};
    for (int corner = 0; corner < 8; ++corner) {
        double factor[3], sign[3];
        for (int axis = 0; axis < 3; ++axis) {
            const double at = (number[axis] + 0.5) / cuts;
            const bool upper = corner >> axis & 1;
            factor[axis] = upper ? at : 1 - at;
            sign[axis] = upper ? 1 : -1;
        }
        centre += (factor[0] * factor[1] * factor[2]) * cell.points[corner];
        slope[0] += (sign[0] * factor[1] * factor[2]) * cell.points[corner];
        slope[1] += (factor[0] * sign[1] * factor[2]) * cell.points[corner];
        slope[2] += (factor[0] * factor[1] * sign[2]) * cell.points[corner];
    }
    const Vec3 reach = magnitudes(slope[0]) + magnitudes(slope[1]) + magnitudes(slope[2]);
    return {centre, (0.5 / cuts) * reach, std::abs(dot(slope[0], cross(slope[1], slope[2])))};
}

bool passes_cell(const Container& container, const FluidCell& cell, bool is_box)
{
    const CellPiece whole = piece_of_cell(cell, is_box, 1, {0, 0, 0});
    return std::abs(container.depth(whole.centre)) < norm(whole.half);
}

double share_of_cell(const Container& container, const FluidCell& cell)
{
    const int cuts = passes_cell(container, cell, false) ? cell_cuts : 1;
    double inside = 0, all = 0;
    for (int k = 0; k < cuts; ++k) {
        for (int j = 0; j < cuts; ++j) {
            for (int i = 0; i < cuts; ++i) {
                const CellPiece piece = piece_of_cell(cell, false, cuts, {i, j, k});
                all += piece.volume;
                inside += piece.volume * share_inside(container, piece.centre, piece.half);
            }
        }
    }
    return inside / all;
}

} // namespace plash
