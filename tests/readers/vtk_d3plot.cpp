#include "tests/readers/vtk_d3plot.h"

#include <stdexcept>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkLSDynaReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

namespace plash::testing {

namespace {

Vec3 vector_at(vtkDataArray* values, vtkIdType row)
{
    if (!values) return {};
    double xyz[3];
    values->GetTuple(row, xyz);
    return {xyz[0], xyz[1], xyz[2]};
}

VtkPart part_of(vtkUnstructuredGrid* grid, const std::string& name)
{
    VtkPart part;
    part.name = name;
    vtkPointData* points = grid->GetPointData();
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
        const double* x = grid->GetPoint(i);
        part.position.push_back({x[0], x[1], x[2]});
        part.deflection.push_back(vector_at(points->GetArray("Deflection"), i));
        part.velocity.push_back(vector_at(points->GetArray("Velocity"), i));
        part.acceleration.push_back(vector_at(points->GetArray("Acceleration"), i));
    }
    vtkCellData* cells = grid->GetCellData();
    vtkNew<vtkIdList> corners;
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
        if (vtkDataArray* ids = cells->GetArray("UserIds")) // not for particles
            part.element_ids.push_back(ids->GetVariantValue(i).ToLongLong());
        grid->GetCellPoints(i, corners);
        part.corners.emplace_back(corners->begin(), corners->end());
    }
    for (int a = 0; a < cells->GetNumberOfArrays(); ++a) {
        vtkDataArray* array = cells->GetArray(a);
        auto& rows = part.cell_values[cells->GetArrayName(a)];
        for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
            rows.emplace_back(array->GetTuple(i), array->GetTuple(i) + array->GetNumberOfComponents());
        }
    }
    return part;
}

void collect_parts(vtkMultiBlockDataSet* blocks, std::vector<VtkPart>& parts)
{
    for (unsigned i = 0; i < blocks->GetNumberOfBlocks(); ++i) {
        vtkDataObject* block = blocks->GetBlock(i);
        if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(block)) collect_parts(inner, parts);
        if (auto* grid = vtkUnstructuredGrid::SafeDownCast(block)) {
            const bool named =
                blocks->HasMetaData(i) && blocks->GetMetaData(i)->Has(vtkCompositeDataSet::NAME());
            parts.push_back(
                part_of(grid, named ? blocks->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) : ""));
        }
    }
}

} // namespace

const VtkPart& VtkD3plot::part(const std::string& name) const
{
    for (const VtkPart& part : parts) {
        if (part.name == name) return part;
    }
    throw std::runtime_error("no part named " + name);
}

VtkD3plot read_with_vtk(const std::string& path, int time_step)
{
    vtkNew<vtkLSDynaReader> reader;
    reader->SetFileName(path.c_str());
    reader->UpdateInformation();
    VtkD3plot result;
    result.time_steps = static_cast<int>(reader->GetNumberOfTimeSteps());
    result.nodes = static_cast<int>(reader->GetNumberOfNodes());
    for (int i = 0; i < result.time_steps; ++i) result.times.push_back(reader->GetTimeValue(i));
    reader->SetTimeStep(time_step);
    reader->SetRemoveDeletedCells(true);
    reader->Update();
    collect_parts(reader->GetOutput(), result.parts);
    return result;
}

} // namespace plash::testing
