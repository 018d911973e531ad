#pragma once

#include "math/lanes.h"

#include <array>
#include <cstddef>
#include <vector>

namespace plash {

/// A box of cells between three families of parallel planes, and how its values lie in memory: cells and
/// nodes share one numbering in which node (i, j, k) is the lowest corner of cell (i, j, k). Index i runs
/// fastest; rows start on a cache line and are padded so that batches of lane_count may run past their end.
/// Two layers of ghosts stand around the box.
class BoxGrid {
public:
    static constexpr int ghosts = 2;

    /// planes  coordinates of the planes along each axis, ascending; at least two an axis [length]
    explicit BoxGrid(std::array<std::vector<double>, 3> planes);

    /// Equal cells in the box from `low` to `high`.
    static BoxGrid uniform(std::array<double, 3> low, std::array<double, 3> high, std::array<int, 3> cells);

    int cells(int axis) const { return cells_[axis]; }
    const std::vector<double>& planes(int axis) const { return planes_[axis]; }
    /// Width of a cell; ghosts are as wide as the outermost cell [length].
    double width(int axis, int cell) const { return width_[axis][cell + lane_count]; }
    /// Widths along an axis from cell 0 on, padded on both sides for loads in lanes.
    const double* widths(int axis) const { return width_[axis].data() + lane_count; }
    double centre(int axis, int cell) const { return 0.5 * (planes_[axis][cell] + planes_[axis][cell + 1]); }
    double volume(int i, int j, int k) const { return width(0, i) * width(1, j) * width(2, k); }
    double smallest_width(int axis) const { return smallest_width_[axis]; }
    /// Weights of the differences to the lower and the upper neighbour in the central estimate of the
    /// difference across a cell (entry `cell`) or across a node's own zone (entry `node`): the parabola
    /// through three points.
    const double* cell_weights(int axis, bool upper) const
    {
        return cell_weight_[axis][upper].data() + lane_count;
    }
    const double* node_weights(int axis, bool upper) const
    {
        return node_weight_[axis][upper].data() + lane_count;
    }

    /// Moves all planes across an axis; widths stay as they are.
    void shift(int axis, double distance)
    {
        for (double& plane : planes_[axis]) plane += distance;
    }
    /// Planes that have been shifted, from a restart file.
    void set_planes(std::array<std::vector<double>, 3> planes) { planes_ = std::move(planes); }

    /// Distance in memory between neighbours along an axis.
    std::ptrdiff_t stride(int axis) const { return stride_[axis]; }
    /// Where cell or node (i, j, k) lies; ghosts have indices -2, -1 and cells(axis), cells(axis) + 1.
    std::ptrdiff_t at(int i, int j, int k) const { return origin_ + i + j * stride_[1] + k * stride_[2]; }
    /// Number of values an array over cells or nodes must hold.
    std::size_t storage() const { return storage_; }
    /// Batches that cover the cells of a row, and those that cover its nodes.
    int cell_batches() const { return (cells_[0] + lane_count - 1) / lane_count; }
    int node_batches() const { return cells_[0] / lane_count + 1; }
    std::size_t cell_count() const { return std::size_t(cells_[0]) * cells_[1] * cells_[2]; }

private:
    std::array<int, 3> cells_{};
    std::array<std::vector<double>, 3> planes_;
    std::array<std::vector<double>, 3> width_;
    std::array<std::array<std::vector<double>, 2>, 3> cell_weight_, node_weight_;
    std::array<double, 3> smallest_width_{};
    std::array<std::ptrdiff_t, 3> stride_{};
    std::ptrdiff_t origin_ = 0;
    std::size_t storage_ = 0;
};

} // namespace plash
