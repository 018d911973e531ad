#pragma once

#include <array>
#include <cstddef>

namespace plash {

/// Where a point lies in a mesh of cells.
struct MeshPoint {
    std::array<int, 3> cell{};    ///< that holds it: indices in a box, else its number and zeros
    std::array<double, 3> part{}; ///< place in the cell, 0 to 1 along each of its axes
    bool inside = false;          ///< of the mesh
};

/// Places in the arrays over nodes or cells, and their weights.
struct PlaceWeights {
    std::array<std::ptrdiff_t, 8> place{};
    std::array<double, 8> weight{};
};

} // namespace plash
