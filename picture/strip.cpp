#include "picture/strip.h"

#include "picture/window.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingFreeType);

namespace plash {

namespace {

using Wall = std::array<std::array<float, 3>, 4>;
using Triple = std::array<double, 3>;

constexpr int title_height = 56; // [pixel]
constexpr int bar_height = 96;   // colour bar below the pictures
constexpr int label_height = 34; // time above each picture
constexpr int largest_height = 1500;

double dot(const Triple& a, const Triple& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Triple cross(const Triple& a, const Triple& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Triple unit(const Triple& a)
{
    const double length = std::sqrt(dot(a, a));
    return {a[0] / length, a[1] / length, a[2] / length};
}

/// The eye's axes and the window of the model that all pictures share.
struct View {
    Triple back, up, right;
    std::array<double, 3> low, high; ///< extent along right, up, back
};

/// z points up unless the eye looks along it.
View view_of(const std::vector<Surface>& surfaces, const Triple& from)
{
    View view;
    view.back = unit(from);
    const Triple z = {0, 0, 1}, y = {0, 1, 0};
    view.right = unit(cross(std::abs(view.back[2]) > 0.99 ? y : z, view.back));
    view.up = cross(view.back, view.right);
    view.low.fill(1e300);
    view.high.fill(-1e300);
    for (const Surface& surface : surfaces) {
        for (const auto& point : surface.points) {
            const Triple x = {point[0], point[1], point[2]};
            const Triple place = {dot(x, view.right), dot(x, view.up), dot(x, view.back)};
            for (int i = 0; i < 3; ++i) {
                view.low[i] = std::min(view.low[i], place[i]);
                view.high[i] = std::max(view.high[i], place[i]);
            }
        }
    }
    // A margin, and something to look at when the model is a line or a point from here.
    const double size = std::max({view.high[0] - view.low[0], view.high[1] - view.low[1], 1e-30});
    for (int i = 0; i < 2; ++i) {
        const double margin = 0.06 * size + std::max(0.0, 0.1 * size - 0.5 * (view.high[i] - view.low[i]));
        view.low[i] -= margin;
        view.high[i] += margin;
    }
    return view;
}

/// Rows and columns of pictures, and the size of one [pixel].
struct Grid {
    int rows = 1, columns = 1, width = 0, height = 0;
};

Grid arrange(int count, double aspect, int total_width)
{
    Grid best;
    double best_area = 0;
    for (int rows = 1; rows <= count; ++rows) {
        const int columns = (count + rows - 1) / rows;
        double width = static_cast<double>(total_width) / columns, height = width / aspect;
        const double limit = static_cast<double>(largest_height) / rows - label_height;
        if (height > limit) {
            height = limit;
            width = height * aspect;
        }
        if (width * height <= best_area * 1.05) continue;
        best_area = width * height;
        best = {rows, columns, total_width / columns, static_cast<int>(height) + label_height};
    }
    return best;
}

/// Its polygons that have edges to show, or those that have not.
vtkSmartPointer<vtkPolyData> poly_data(const Surface& surface, bool bare)
{
    vtkNew<vtkPoints> points;
    for (const auto& point : surface.points) points->InsertNextPoint(point.data());
    vtkNew<vtkCellArray> polygons;
    vtkNew<vtkFloatArray> values;
    for (float value : surface.point_values) values->InsertNextValue(value);
    for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
        if ((surface.bare[i] != 0) != bare) continue;
        const std::vector<int>& polygon = surface.polygons[i];
        polygons->InsertNextCell(static_cast<int>(polygon.size()));
        for (int corner : polygon) polygons->InsertCellPoint(corner);
        if (surface.point_values.empty()) values->InsertNextValue(surface.cell_values[i]);
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(polygons);
    if (surface.point_values.empty()) {
        data->GetCellData()->SetScalars(values);
    } else {
        data->GetPointData()->SetScalars(values);
    }
    return data;
}

/// From zero, because every quantity is a magnitude, to the largest value, or to one that only the share
/// `beyond` of what some state shows exceeds.
std::array<double, 2> range_of(const std::vector<Surface>& surfaces, double beyond)
{
    double end = 0;
    for (const Surface& surface : surfaces) {
        std::vector<float> values = surface.values();
        std::erase_if(values, [](float value) { return !(std::isfinite(value) && value > 0); });
        if (values.empty()) continue;
        const auto excess = static_cast<std::size_t>(beyond * static_cast<double>(values.size()));
        const auto place = values.end() - 1 - static_cast<std::ptrdiff_t>(excess);
        std::nth_element(values.begin(), place, values.end());
        end = std::max<double>(end, *place);
    }
    return {0, end > 0 ? end : 1};
}

/// Pale where nothing happens, so that the edges of elements stay visible, then blue, green, yellow, red.
vtkSmartPointer<vtkColorTransferFunction> colours(const std::array<double, 2>& range)
{
    const double stops[][3] = {{0.86, 0.89, 0.94}, {0.60, 0.75, 0.93}, {0.30, 0.56, 0.89}, {0.15, 0.60, 0.75},
                               {0.20, 0.70, 0.50}, {0.52, 0.80, 0.32}, {0.87, 0.85, 0.22}, {0.98, 0.70, 0.18},
                               {0.95, 0.48, 0.15}, {0.83, 0.22, 0.15}, {0.60, 0.05, 0.16}};
    constexpr int last = 10;
    auto function = vtkSmartPointer<vtkColorTransferFunction>::New();
    for (int i = 0; i <= last; ++i) {
        const double value = range[0] + (range[1] - range[0]) * i / last;
        function->AddRGBPoint(value, stops[i][0], stops[i][1], stops[i][2]);
    }
    return function;
}

void add_text(vtkRenderer* renderer, const std::string& text, int x, int y, int size, bool bold, bool centred)
{
    vtkNew<vtkTextActor> actor;
    actor->SetInput(text.c_str());
    vtkTextProperty* look = actor->GetTextProperty();
    look->SetFontSize(size);
    look->SetBold(bold);
    look->SetColor(0.1, 0.1, 0.1);
    if (centred) look->SetJustificationToCentered();
    actor->SetPosition(x, y);
    renderer->AddViewProp(actor);
}

/// A grey square with a border, so that it is seen as a line from the side; translucent from behind.
void add_wall(vtkRenderer* renderer, const Wall& wall, const Triple& from)
{
    vtkNew<vtkPoints> points;
    for (const auto& corner : wall) points->InsertNextPoint(corner.data());
    vtkNew<vtkCellArray> square, border;
    square->InsertNextCell({0, 1, 2, 3});
    border->InsertNextCell({0, 1, 2, 3, 0});
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(square);
    data->SetLines(border);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty* look = actor->GetProperty();
    look->SetColor(0.70, 0.72, 0.75);
    look->LightingOff();
    look->SetLineWidth(2);
    Triple a{}, b{};
    for (int k = 0; k < 3; ++k) {
        a[k] = wall[1][k] - wall[0][k];
        b[k] = wall[3][k] - wall[0][k];
    }
    if (dot(cross(a, b), from) < 0) look->SetOpacity(0.3);
    renderer->AddActor(actor);
}

void add_polygons(vtkRenderer* renderer, vtkPolyData* polygons, vtkColorTransferFunction* colours, bool edges)
{
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(polygons);
    mapper->SetLookupTable(colours);
    mapper->UseLookupTableScalarRangeOn();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty* look = actor->GetProperty();
    look->SetInterpolationToFlat();
    look->SetAmbient(0.55);
    look->SetDiffuse(0.5);
    look->SetSpecular(0.05);
    if (edges) {
        look->EdgeVisibilityOn();
        look->SetEdgeColor(0.12, 0.12, 0.14);
        look->SetLineWidth(1);
    }
    renderer->AddActor(actor);
}

void add_model(vtkRenderer* renderer, const Surface& surface, vtkColorTransferFunction* colours, bool edges)
{
    add_polygons(renderer, poly_data(surface, false), colours, edges);
    add_polygons(renderer, poly_data(surface, true), colours, false);
}

void aim(vtkRenderer* renderer, const View& view, double picture_aspect)
{
    Triple middle{}, size{};
    for (int i = 0; i < 3; ++i) {
        middle[i] = 0.5 * (view.low[i] + view.high[i]);
        size[i] = view.high[i] - view.low[i];
    }
    const double distance = size[2] + size[0] + size[1] + 1e-30;
    Triple focus{}, eye{};
    for (int i = 0; i < 3; ++i) {
        focus[i] = middle[0] * view.right[i] + middle[1] * view.up[i] + middle[2] * view.back[i];
        eye[i] = focus[i] + distance * view.back[i];
    }
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetFocalPoint(focus.data());
    camera->SetPosition(eye.data());
    camera->SetViewUp(view.up.data());
    camera->SetParallelScale(0.5 * std::max(size[1], size[0] / picture_aspect));
    renderer->ResetCameraClippingRange();
}

void add_colour_bar(vtkRenderer* renderer, vtkColorTransferFunction* colours, const std::string& legend)
{
    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(colours);
    bar->SetOrientationToHorizontal();
    bar->SetNumberOfLabels(6);
    bar->SetMaximumNumberOfColors(512);
    bar->SetLabelFormat("%.3g");
    bar->SetTitle((legend + "\n ").c_str());
    bar->UnconstrainedFontSizeOn();
    bar->SetPosition(0.2, 0.06);
    bar->SetWidth(0.6);
    bar->SetHeight(0.9);
    bar->SetBarRatio(0.22);
    for (vtkTextProperty* look : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
        look->SetColor(0.1, 0.1, 0.1);
        look->SetFontSize(18);
        look->ItalicOff();
        look->BoldOff();
        look->ShadowOff();
    }
    renderer->AddActor2D(bar);
}

} // namespace

void draw_strip(const std::vector<Surface>& surfaces, const std::vector<Wall>& walls, const StripStyle& style,
                const std::string& path)
{
    const View view = view_of(surfaces, style.from);
    const double aspect = (view.high[0] - view.low[0]) / (view.high[1] - view.low[1]);
    const Grid grid = arrange(static_cast<int>(surfaces.size()), aspect, style.width);
    const int pictures_height = grid.rows * grid.height;
    const auto colouring = colours(style.range.value_or(range_of(surfaces, style.beyond)));

    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(8);
    window->SetSize(style.width, pictures_height + title_height + bar_height);

    const auto title = pane(window, 0, bar_height + pictures_height, style.width, title_height);
    add_text(title, style.title, style.width / 2, title_height / 3, 24, true, true);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const int row = static_cast<int>(i) / grid.columns, column = static_cast<int>(i) % grid.columns;
        const int x = column * grid.width;
        const int y = bar_height + pictures_height - (row + 1) * grid.height;
        const int height = grid.height - label_height;
        const auto picture = pane(window, x, y, grid.width, height);
        for (const Wall& wall : walls) add_wall(picture, wall, style.from);
        add_model(picture, surfaces[i], colouring, style.edges);
        aim(picture, view, static_cast<double>(grid.width) / height);
        const auto label = pane(window, x, y + height, grid.width, label_height);
        char text[64];
        std::snprintf(text, sizeof text, "t = %.5g", surfaces[i].time);
        add_text(label, text, grid.width / 2, 8, 19, false, true);
    }
    const auto bar = pane(window, 0, 0, style.width, bar_height);
    add_colour_bar(bar, colouring, style.legend);
    window->Render();
    save_window(window, path);
}

} // namespace plash
