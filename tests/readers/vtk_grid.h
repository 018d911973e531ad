#pragma once

#include <map>
#include <string>
#include <vector>

/// A VTK XML file as VTK's own reader understands it, in plain data.
namespace plash::testing {

struct VtkGrid {
    using Rows = std::vector<std::vector<double>>;
    double time = 0; ///< TimeValue of the field data
    Rows points;
    std::vector<int> cell_types;           ///< VTK's numbers
    std::vector<std::vector<int>> corners; ///< by cell
    std::map<std::string, Rows> point_values, cell_values;
};

/// Throws std::runtime_error when VTK reports an error.
VtkGrid read_vtu(const std::string& path);

} // namespace plash::testing
