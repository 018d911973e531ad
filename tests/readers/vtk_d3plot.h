#pragma once

#include "math/vector3.h"
#include "model/record.h"

#include <array>
#include <map>
#include <string>
#include <vector>

/// A d3plot database as VTK's vtkLSDynaReader understands it, in plain data. All of VTK stays in the .cpp
/// file.
namespace plash::testing {

/// One part. Node numbers are missing: VTK 9.1 reads those of a single-precision database as 64-bit integers.
struct VtkPart {
    std::string name;
    std::vector<Vec3> position; ///< by point, deflected
    std::vector<Vec3> deflection, velocity, acceleration;
    std::vector<Id> element_ids;                                         ///< by cell
    std::vector<std::vector<int>> corners;                               ///< by cell: points
    std::map<std::string, std::vector<std::vector<double>>> cell_values; ///< by array name: cell x component
};

struct VtkD3plot {
    int time_steps = 0;
    int nodes = 0;
    std::vector<double> times;
    std::vector<VtkPart> parts; ///< of the asked-for time step, deleted cells left out

    const VtkPart& part(const std::string& name) const;
};

/// Opens the database that begins with the file `path` and loads one of its states.
VtkD3plot read_with_vtk(const std::string& path, int time_step);

} // namespace plash::testing
