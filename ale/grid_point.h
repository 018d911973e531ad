#pragma once

#include "ale/box_grid.h"
#include "ale/mesh_point.h"
#include "math/vector3.h"

#include <algorithm>
#include <array>
#include <vector>

namespace plash {

/// Number of the interval that holds `value`; looks first where the last point was.
inline int interval_of(const std::vector<double>& planes, double value, int guess)
{
    const int last = static_cast<int>(planes.size()) - 2;
    guess = std::clamp(guess, 0, last);
    if (value >= planes[guess] && value < planes[guess + 1]) return guess;
    const auto above = std::upper_bound(planes.begin(), planes.end(), value);
    return std::clamp(static_cast<int>(above - planes.begin()) - 1, 0, last);
}

inline MeshPoint locate(const BoxGrid& grid, const Vec3& point, const std::array<int, 3>& guess)
{
    MeshPoint found;
    found.inside = true;
    const double x[3] = {point.x, point.y, point.z};
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double>& planes = grid.planes(axis);
        found.inside = found.inside && x[axis] >= planes.front() && x[axis] <= planes.back();
        const int cell = interval_of(planes, x[axis], guess[axis]);
        found.cell[axis] = cell;
        found.part[axis] = std::clamp((x[axis] - planes[cell]) / (planes[cell + 1] - planes[cell]), 0.0, 1.0);
    }
    return found;
}

/// The eight nodes of the cell and the trilinear weights of the point.
inline PlaceWeights node_weights(const BoxGrid& grid, const MeshPoint& point)
{
    PlaceWeights result;
    for (int corner = 0; corner < 8; ++corner) {
        const int offset[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) weight *= offset[axis] ? point.part[axis] : 1 - point.part[axis];
        result.place[corner] =
            grid.at(point.cell[0] + offset[0], point.cell[1] + offset[1], point.cell[2] + offset[2]);
        result.weight[corner] = weight;
    }
    return result;
}

/// The eight cells whose centres surround the point, with trilinear weights; at the box's sides the outermost
/// cell stands for what lies beyond.
inline PlaceWeights cell_weights(const BoxGrid& grid, const MeshPoint& point)
{
    int low[3];
    double part[3];
    for (int axis = 0; axis < 3; ++axis) {
        const int cell = point.cell[axis], other = point.part[axis] < 0.5 ? cell - 1 : cell + 1;
        const int clamped = std::clamp(other, 0, grid.cells(axis) - 1);
        const double own = grid.width(axis, cell), next = grid.width(axis, clamped);
        const double reach = std::abs(point.part[axis] - 0.5) * own / (0.5 * (own + next));
        low[axis] = std::min(cell, other);
        part[axis] = other < cell ? 1 - reach : reach;
    }
    PlaceWeights result;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        int index[3];
        for (int axis = 0; axis < 3; ++axis) {
            const int upper = corner >> axis & 1;
            weight *= upper ? part[axis] : 1 - part[axis];
            index[axis] = std::clamp(low[axis] + upper, 0, grid.cells(axis) - 1);
        }
        result.place[corner] = grid.at(index[0], index[1], index[2]);
        result.weight[corner] = weight;
    }
    return result;
}

} // namespace plash
