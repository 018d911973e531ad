#pragma once

#include <array>
#include <string>
#include <vector>

namespace plash {

/// What one picture shows: the outside of the model at one time with a value to colour it by.
struct Surface {
    double time = 0;
    std::vector<std::array<float, 3>> points;
    std::vector<std::vector<int>> polygons;
    std::vector<float> point_values; ///< either by point
    std::vector<float> cell_values;  ///< or by polygon

    const std::vector<float>& values() const { return point_values.empty() ? cell_values : point_values; }
};

/// Something that pictures can be coloured by.
enum class Quantity { von_mises, plastic_strain, pressure, velocity, displacement };

/// By its name on the command line: "von_mises" ... Throws std::runtime_error naming the choices.
Quantity quantity_named(const std::string& name);
std::string title_of(Quantity);

} // namespace plash
