#pragma once

#include "ale/hex/hex_mesh.h"

namespace plash {

/// Finds the cell of a mesh that holds a point, and where in it the point lies.
class HexLocator {
public:
    explicit HexLocator(const HexMesh& mesh);

    struct Found {
        Index cell = none;
        std::array<double, 3> part{};
    };
    /// guess  cell to look in first
    Found operator()(const HexMesh& mesh, const Vec3& point, Index guess) const;

private:
    Vec3 low_, high_; ///< of all nodes
    std::array<int, 3> bins_{1, 1, 1};
    std::vector<std::size_t> first_; ///< of each bin in cells_; one more entry for the end
    std::vector<Index> cells_;       ///< whose boxes touch the bin, in rising order

    std::array<int, 3> bin_of(const Vec3& point) const;
};

/// Coordinates of a point within a cell, 0 to 1 between its faces; false when it lies outside.
bool find_in_cell(const HexMesh& mesh, Index cell, const Vec3& point, std::array<double, 3>& part);

} // namespace plash
