#include "tests/readers/vtk_grid.h"

#include <stdexcept>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace plash::testing {

namespace {

std::map<std::string, VtkGrid::Rows> arrays_of(vtkFieldData* data)
{
    std::map<std::string, VtkGrid::Rows> values;
    for (int a = 0; a < data->GetNumberOfArrays(); ++a) {
        vtkDataArray* array = data->GetArray(a);
        VtkGrid::Rows& rows = values[array->GetName()];
        for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
            rows.emplace_back(array->GetTuple(i), array->GetTuple(i) + array->GetNumberOfComponents());
        }
    }
    return values;
}

} // namespace

VtkGrid read_vtu(const std::string& path)
{
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    if (reader->GetErrorCode() != 0) throw std::runtime_error("VTK cannot read " + path);
    vtkUnstructuredGrid* grid = reader->GetOutput();
    VtkGrid result;
    if (vtkDataArray* time = grid->GetFieldData()->GetArray("TimeValue")) result.time = time->GetTuple1(0);
    vtkNew<vtkIdList> corners;
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
        result.points.emplace_back(grid->GetPoint(i), grid->GetPoint(i) + 3);
    }
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
        result.cell_types.push_back(grid->GetCellType(i));
        grid->GetCellPoints(i, corners);
        result.corners.emplace_back(corners->begin(), corners->end());
    }
    result.point_values = arrays_of(grid->GetPointData());
    result.cell_values = arrays_of(grid->GetCellData());
    return result;
}

} // namespace plash::testing
