#include "ale/box_grid.h"

#include "ale/slope.h"

#include <algorithm>

namespace plash {

BoxGrid::BoxGrid(std::array<std::vector<double>, 3> planes) : planes_(std::move(planes))
{
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double>& plane = planes_[axis];
        cells_[axis] = static_cast<int>(plane.size()) - 1;
        std::vector<double>& width = width_[axis];
        width.resize(cells_[axis] + 3 * lane_count);
        for (int entry = 0; entry < static_cast<int>(width.size()); ++entry) {
            const int cell = std::clamp(entry - lane_count, 0, cells_[axis] - 1);
            width[entry] = plane[cell + 1] - plane[cell];
        }
        for (int upper = 0; upper < 2; ++upper) {
            cell_weight_[axis][upper].assign(width.size(), 0.5);
            node_weight_[axis][upper].assign(width.size(), 0.5);
        }
        for (std::size_t entry = 1; entry + 1 < width.size(); ++entry) {
            const double before = width[entry - 1], own = width[entry], after = width[entry + 1];
            const double low = 0.5 * (before + own), high = 0.5 * (own + after);
            cell_weight_[axis][0][entry] = parabola_weight(own, low, high);
            cell_weight_[axis][1][entry] = parabola_weight(own, high, low);
            node_weight_[axis][0][entry] = parabola_weight(low, before, own);
            node_weight_[axis][1][entry] = parabola_weight(low, own, before);
        }
        smallest_width_[axis] = *std::min_element(width.begin(), width.end());
    }
    const int row = lane_count + (cells_[0] + 1 + ghosts + lane_count - 1) / lane_count * lane_count;
    const int rows = cells_[1] + 2 * ghosts, sheets = cells_[2] + 2 * ghosts;
    stride_ = {1, row, std::ptrdiff_t(row) * rows};
    origin_ = lane_count + ghosts * (stride_[1] + stride_[2]);
    storage_ = stride_[2] * sheets + row;
}

BoxGrid BoxGrid::uniform(std::array<double, 3> low, std::array<double, 3> high, std::array<int, 3> cells)
{
    std::array<std::vector<double>, 3> planes;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i <= cells[axis]; ++i) {
            planes[axis].push_back(low[axis] + (high[axis] - low[axis]) * i / cells[axis]);
        }
    }
    return BoxGrid(std::move(planes));
}

} // namespace plash
