#include "picture/run_results.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkLSDynaReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkThreshold.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace plash {

namespace {

namespace fs = std::filesystem;

const char* const value_name = "picture value";

/// Equivalent stress of six components xx, yy, zz, xy, yz, zx.
double von_mises(const double* s)
{
    const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
    return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/// Pressure of six components; tension counts as none.
double pressure(const double* s)
{
    return std::max(0.0, -(s[0] + s[1] + s[2]) / 3);
}

double magnitude(const double* v)
{
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double itself(const double* value)
{
    return *value;
}

/// Adds an array with the largest `measure` over those of the named arrays that are there; zero without any.
void add_values(vtkDataSetAttributes* data, vtkIdType count, const std::vector<std::string>& names,
                double (*measure)(const double*))
{
    vtkNew<vtkFloatArray> values;
    values->SetName(value_name);
    values->SetNumberOfTuples(count);
    values->Fill(0);
    for (const std::string& name : names) {
        vtkDataArray* source = data->GetArray(name.c_str());
        if (!source) continue;
        for (vtkIdType i = 0; i < count; ++i) {
            const float value = static_cast<float>(measure(source->GetTuple(i)));
            values->SetValue(i, std::max(values->GetValue(i), value));
        }
    }
    data->AddArray(values);
}

/// A particle is shown as an octahedron as large as its share of the space: `radius` from middle to corner.
void append_particle(const double* middle, double radius, float value, bool value_of_points, Surface& surface)
{
    const int first = static_cast<int>(surface.points.size());
    surface.include(
        {static_cast<float>(middle[0]), static_cast<float>(middle[1]), static_cast<float>(middle[2])});
    for (int axis = 0; axis < 3; ++axis) {
        for (double side : {-radius, radius}) {
            std::array<float, 3> corner;
            for (int i = 0; i < 3; ++i) {
                corner[i] = static_cast<float>(middle[i] + (i == axis ? side : 0));
            }
            surface.points.push_back(corner);
            if (value_of_points) surface.point_values.push_back(value);
        }
    }
    for (int x : {0, 1}) {
        for (int y : {2, 3}) {
            for (int z : {4, 5}) {
                surface.polygons.push_back({first + x, first + y, first + z});
                surface.bare.push_back(1);
                if (!value_of_points) surface.cell_values.push_back(value);
            }
        }
    }
}

/// Half of the spacing of particles over their smoothing length, for the usual 1.2.
constexpr double radius_share = 0.42;

/// Of the particles in a grid, by cell; nullptr: there are none.
vtkDataArray* smoothing_lengths(vtkCellData* data)
{
    // d3plot's name in two versions of VTK, and that of Plash's own files
    for (const char* name : {"InfluenceRadius", "RadiusOfInfluence", "smoothing_length"}) {
        if (vtkDataArray* found = data->GetArray(name)) return found;
    }
    return nullptr;
}

/// Density and volume fractions of Eulerian cells, the history variables of solids in d3plot; nullptr where
/// the fractions do not make up every cell, as in solids.
vtkDataArray* fluid_of(vtkUnstructuredGrid* grid)
{
    vtkDataArray* fluid = grid->GetCellData()->GetArray("IntPtData");
    if (!fluid || fluid->GetNumberOfComponents() < 2) return nullptr;
    for (vtkIdType cell = 0; cell < fluid->GetNumberOfTuples(); ++cell) {
        double sum = 0;
        for (int i = 1; i < fluid->GetNumberOfComponents(); ++i) sum += fluid->GetComponent(cell, i);
        if (!(std::abs(sum - 1) < 1e-3)) return nullptr;
    }
    return fluid;
}

/// Cells lighter than this share of the heaviest one are void, or gas around a liquid, and not drawn.
constexpr double lightest_share = 0.2;

/// Largest density of the Eulerian cells; 0 without any.
double heaviest_cell(vtkMultiBlockDataSet* blocks)
{
    double largest = 0;
    for (unsigned i = 0; i < blocks->GetNumberOfBlocks(); ++i) {
        vtkDataObject* block = blocks->GetBlock(i);
        if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(block)) {
            largest = std::max(largest, heaviest_cell(inner));
        }
        auto* grid = vtkUnstructuredGrid::SafeDownCast(block);
        vtkDataArray* fluid = grid ? fluid_of(grid) : nullptr;
        for (vtkIdType cell = 0; fluid && cell < fluid->GetNumberOfTuples(); ++cell) {
            largest = std::max(largest, fluid->GetComponent(cell, 0));
        }
    }
    return largest;
}

/// The cells of a grid that are worth drawing.
vtkSmartPointer<vtkUnstructuredGrid> without_void(vtkUnstructuredGrid* grid, double heaviest)
{
    if (!(heaviest > 0) || !fluid_of(grid)) return grid;
    vtkNew<vtkThreshold> filled;
    filled->SetInputData(grid);
    filled->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "IntPtData");
    filled->SetSelectedComponent(0);
    filled->SetComponentModeToUseSelected();
    filled->SetThresholdFunction(vtkThreshold::THRESHOLD_UPPER);
    filled->SetUpperThreshold(lightest_share * heaviest);
    filled->Update();
    return filled->GetOutput();
}

/// Appends the outside of a grid that carries the values.
void append_outside(vtkUnstructuredGrid* grid, Surface& surface)
{
    vtkNew<vtkDataSetSurfaceFilter> filter;
    filter->SetInputData(grid);
    filter->Update();
    vtkPolyData* outside = filter->GetOutput();
    const int first = static_cast<int>(surface.points.size());
    vtkDataArray* point_values = outside->GetPointData()->GetArray(value_name);
    for (vtkIdType i = 0; i < outside->GetNumberOfPoints(); ++i) {
        const double* x = outside->GetPoint(i);
        surface.points.push_back(
            {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])});
        if (point_values) surface.point_values.push_back(static_cast<float>(point_values->GetTuple1(i)));
    }
    vtkDataArray* cell_values = outside->GetCellData()->GetArray(value_name);
    vtkDataArray* smoothing = smoothing_lengths(outside->GetCellData());
    vtkNew<vtkIdList> corners;
    for (vtkIdType i = 0; i < outside->GetNumberOfCells(); ++i) {
        outside->GetCellPoints(i, corners);
        if (corners->GetNumberOfIds() == 1 && smoothing) {
            vtkDataArray* values = point_values ? point_values : cell_values;
            const vtkIdType row = point_values ? corners->GetId(0) : i;
            append_particle(outside->GetPoint(corners->GetId(0)), radius_share * smoothing->GetTuple1(i),
                            values ? static_cast<float>(values->GetTuple1(row)) : 0, point_values != nullptr,
                            surface);
            continue;
        }
        std::vector<int>& polygon = surface.polygons.emplace_back();
        for (vtkIdType corner : *corners) {
            polygon.push_back(first + static_cast<int>(corner));
            surface.include(surface.points[polygon.back()]);
        }
        surface.bare.push_back(0);
        if (cell_values) surface.cell_values.push_back(static_cast<float>(cell_values->GetTuple1(i)));
    }
}

vtkSmartPointer<vtkUnstructuredGrid> read_vtu(const std::string& path)
{
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    if (reader->GetErrorCode() != 0) throw std::runtime_error("cannot be read: " + path);
    return reader->GetOutput();
}

} // namespace

struct RunResults::Source {
    std::vector<double> times;
    std::string title;
    virtual ~Source() = default;
    virtual Surface surface(std::size_t state, Quantity quantity) = 0;
};

struct RunResults::D3plotSource : RunResults::Source {
    vtkNew<vtkLSDynaReader> reader;
    vtkNew<vtkLSDynaReader>
        particle_reader; ///< VTK finds particles deleted at random: this one keeps all cells
    bool has_particles = false;

    explicit D3plotSource(const std::string& path)
    {
        reader->SetFileName(path.c_str());
        reader->UpdateInformation();
        reader->SetRemoveDeletedCells(true);
        particle_reader->SetFileName(path.c_str());
        particle_reader->UpdateInformation();
        particle_reader->SetRemoveDeletedCells(false);
        for (vtkIdType i = 0; i < reader->GetNumberOfTimeSteps(); ++i)
            times.push_back(reader->GetTimeValue(i));
        if (const char* text = reader->GetTitle()) title = text;
        title.erase(title.find_last_not_of(" \t") + 1);
    }

    Surface surface(std::size_t state, Quantity quantity) override
    {
        reader->SetTimeStep(static_cast<vtkIdType>(state));
        reader->Update();
        heaviest_ = heaviest_cell(reader->GetOutput());
        Surface surface;
        append_blocks(reader->GetOutput(), false, quantity, surface);
        if (!has_particles) return surface;
        particle_reader->SetTimeStep(static_cast<vtkIdType>(state));
        particle_reader->Update();
        append_blocks(particle_reader->GetOutput(), true, quantity, surface);
        return surface;
    }

    /// Appends the blocks of particles, or all others.
    void append_blocks(vtkMultiBlockDataSet* blocks, bool of_particles, Quantity quantity, Surface& surface)
    {
        for (unsigned i = 0; i < blocks->GetNumberOfBlocks(); ++i) {
            vtkDataObject* block = blocks->GetBlock(i);
            if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(block))
                append_blocks(inner, of_particles, quantity, surface);
            auto* grid = vtkUnstructuredGrid::SafeDownCast(block);
            if (!grid || grid->GetNumberOfCells() == 0) continue;
            const bool particles = smoothing_lengths(grid->GetCellData()) != nullptr;
            has_particles = has_particles || particles;
            if (particles != of_particles) continue;
            const auto cells = [&](const std::vector<std::string>& names, double (*measure)(const double*)) {
                add_values(grid->GetCellData(), grid->GetNumberOfCells(), names, measure);
            };
            const auto points = [&](const char* name) {
                add_values(grid->GetPointData(), grid->GetNumberOfPoints(), {name}, magnitude);
            };
            switch (quantity) {
            case Quantity::von_mises:
                cells({"Stress", "StressInnerSurf", "StressOuterSurf"}, von_mises);
                break;
            case Quantity::plastic_strain:
                cells({"EffPlastStrn", "EffPlastStrnInnerSurf", "EffPlastStrnOuterSurf"}, itself);
                break;
            case Quantity::pressure:
                cells({"Stress", "StressInnerSurf", "StressOuterSurf"}, pressure);
                break;
            case Quantity::velocity:
                points("Velocity");
                break;
            case Quantity::displacement:
                points("Deflection");
                break;
            }
            append_outside(without_void(grid, heaviest_), surface);
        }
    }

private:
    double heaviest_ = 0; ///< Eulerian cell of the state
};

struct RunResults::VtuSource : RunResults::Source {
    std::vector<std::string> files;

    explicit VtuSource(const std::string& directory)
    {
        std::ifstream index(directory + "/result.pvd");
        const std::regex entry(R"re(timestep="([^"]+)" part="0" file="([^"]+)")re");
        std::smatch match;
        for (std::string line; std::getline(index, line);) {
            if (!std::regex_search(line, match, entry)) continue;
            times.push_back(std::stod(match[1]));
            files.push_back(directory + "/" + match[2].str());
        }
    }

    Surface surface(std::size_t state, Quantity quantity) override
    {
        vtkNew<vtkThreshold> alive;
        alive->SetInputData(read_vtu(files.at(state)));
        alive->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "eroded");
        alive->SetThresholdFunction(vtkThreshold::THRESHOLD_LOWER);
        alive->SetLowerThreshold(0.5);
        alive->Update();
        vtkUnstructuredGrid* grid = alive->GetOutput();
        const auto cells = [&](const char* name) {
            add_values(grid->GetCellData(), grid->GetNumberOfCells(), {name}, itself);
        };
        const auto points = [&](const char* name) {
            add_values(grid->GetPointData(), grid->GetNumberOfPoints(), {name}, magnitude);
        };
        switch (quantity) {
        case Quantity::von_mises:
            cells("von_mises");
            break;
        case Quantity::plastic_strain:
            cells("plastic_strain");
            break;
        case Quantity::pressure:
            add_values(grid->GetCellData(), grid->GetNumberOfCells(), {"stress"}, pressure);
            break;
        case Quantity::velocity:
            points("velocity");
            break;
        case Quantity::displacement:
            points("displacement");
            break;
        }
        Surface surface;
        append_outside(grid, surface);
        return surface;
    }
};

RunResults::RunResults(const std::string& directory) : directory_(directory)
{
    if (fs::exists(fs::path(directory) / "d3plot")) {
        source_ = std::make_unique<D3plotSource>((fs::path(directory) / "d3plot").string());
    } else if (fs::exists(fs::path(directory) / "result.pvd")) {
        source_ = std::make_unique<VtuSource>(directory);
    } else {
        throw std::runtime_error(directory + " holds neither d3plot nor result.pvd; does the deck have "
                                             "*DATABASE_BINARY_D3PLOT, or was it run with --vtk?");
    }
    times_ = source_->times;
    title_ = source_->title;
    if (times_.empty()) throw std::runtime_error(directory + " holds no state yet");
}

RunResults::~RunResults() = default;

Surface RunResults::surface(std::size_t state, Quantity quantity)
{
    Surface surface = source_->surface(state, quantity);
    surface.time = times_.at(state);
    return surface;
}

std::vector<std::array<std::array<float, 3>, 4>> RunResults::walls() const
{
    const fs::path path = fs::path(directory_) / "walls.vtu";
    if (!fs::exists(path)) return {};
    const auto grid = read_vtu(path.string());
    std::vector<std::array<std::array<float, 3>, 4>> walls(grid->GetNumberOfCells());
    for (std::size_t wall = 0; wall < walls.size(); ++wall) {
        for (int corner = 0; corner < 4; ++corner) {
            const double* x = grid->GetPoint(static_cast<vtkIdType>(4 * wall + corner));
            for (int i = 0; i < 3; ++i) walls[wall][corner][i] = static_cast<float>(x[i]);
        }
    }
    return walls;
}

} // namespace plash
