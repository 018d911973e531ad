#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace plash {

/// What one picture shows: the outside of the model at one time with a value to colour it by.
struct Surface {
    double time = 0;
    std::vector<std::array<float, 3>> points;
    std::vector<std::vector<int>> polygons;
    std::vector<char> bare; ///< by polygon: 1 has no edges to show, being a facet of a particle
    /// Box around nodes and middles of particles: low and high ends.
    std::array<std::array<float, 3>, 2> bounds{{{1e30f, 1e30f, 1e30f}, {-1e30f, -1e30f, -1e30f}}};
    std::vector<float> point_values; ///< either by point
    std::vector<float> cell_values;  ///< or by polygon

    void include(const std::array<float, 3>& point)
    {
        for (int i = 0; i < 3; ++i) {
            bounds[0][i] = std::min(bounds[0][i], point[i]);
            bounds[1][i] = std::max(bounds[1][i], point[i]);
        }
    }
    const std::vector<float>& values() const { return point_values.empty() ? cell_values : point_values; }
};

/// Something that pictures can be coloured by.
enum class Quantity { von_mises, plastic_strain, pressure, velocity, displacement };

/// By its name on the command line: "von_mises" ... Throws std::runtime_error naming the choices.
Quantity quantity_named(const std::string& name);
std::string title_of(Quantity);

} // namespace plash
