#include "picture/plots.h"

#include "picture/window.h"

#include <vtkAutoInit.h>
#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

VTK_MODULE_INIT(vtkRenderingContextOpenGL2);

namespace plash {

namespace {

void set_text(vtkTextProperty* look, int size, bool bold)
{
    look->SetFontSize(size);
    look->SetBold(bold);
    look->SetItalic(false);
    look->SetColor(0.1, 0.1, 0.1);
}

vtkSmartPointer<vtkDoubleArray> array_of(const std::string& name, const std::vector<double>& values)
{
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(name.c_str());
    for (double value : values) array->InsertNextValue(value);
    return array;
}

void add_line(vtkChartXY* chart, const PlotLine& line)
{
    vtkNew<vtkTable> table;
    table->AddColumn(array_of("x", line.x));
    table->AddColumn(array_of(line.name, line.y));
    vtkPlot* plot = chart->AddPlot(line.markers ? vtkChart::POINTS : vtkChart::LINE);
    plot->SetInputData(table, 0, 1);
    plot->SetColor(line.colour[0], line.colour[1], line.colour[2]);
    plot->SetWidth(line.markers ? 5.0f : 2.0f);
    if (line.markers) vtkPlotPoints::SafeDownCast(plot)->SetMarkerStyle(vtkPlotPoints::CIRCLE);
}

/// Where the legend covers the fewest points.
std::pair<int, int> emptiest_corner(const Plot& plot)
{
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const PlotLine& line : plot.lines) {
        for (std::size_t i = 0; i < line.x.size(); ++i) {
            const double place[2] = {line.x[i], line.y[i]};
            for (int axis = 0; axis < 2; ++axis) {
                low[axis] = std::min(low[axis], place[axis]);
                high[axis] = std::max(high[axis], place[axis]);
            }
        }
    }
    int covered[2][2] = {{0, 0}, {0, 0}}; // right?, top?
    for (const PlotLine& line : plot.lines) {
        for (std::size_t i = 0; i < line.x.size(); ++i) {
            const double x = (line.x[i] - low[0]) / (high[0] - low[0]),
                         y = (line.y[i] - low[1]) / (high[1] - low[1]);
            if ((x < 0.35 || x > 0.65) && (y < 0.25 || y > 0.75)) ++covered[x > 0.5][y > 0.5];
        }
    }
    int right = 0, top = 1;
    for (int r : {0, 1}) {
        for (int t : {1, 0}) {
            if (covered[r][t] >= covered[right][top]) continue;
            right = r;
            top = t;
        }
    }
    return {right ? vtkChartLegend::RIGHT : vtkChartLegend::LEFT,
            top ? vtkChartLegend::TOP : vtkChartLegend::BOTTOM};
}

void add_plot(vtkRenderer* renderer, const Plot& plot)
{
    vtkNew<vtkChartXY> chart;
    chart->SetTitle(plot.title);
    set_text(chart->GetTitleProperties(), 17, true);
    chart->SetShowLegend(true);
    set_text(chart->GetLegend()->GetLabelProperties(), 14, false);
    const auto [horizontal, vertical] = emptiest_corner(plot);
    chart->GetLegend()->SetHorizontalAlignment(horizontal);
    chart->GetLegend()->SetVerticalAlignment(vertical);
    for (const auto& [side, label] :
         {std::pair{vtkAxis::BOTTOM, plot.x_label}, {vtkAxis::LEFT, plot.y_label}}) {
        vtkAxis* axis = chart->GetAxis(side);
        axis->SetTitle(label);
        set_text(axis->GetTitleProperties(), 15, false);
        set_text(axis->GetLabelProperties(), 13, false);
        axis->GetGridPen()->SetColor(225, 225, 230);
    }
    for (const PlotLine& line : plot.lines) add_line(chart, line);
    vtkNew<vtkContextActor> actor;
    actor->GetScene()->AddItem(chart);
    actor->GetScene()->SetRenderer(renderer);
    renderer->AddActor(actor);
}

} // namespace

void draw_plots(const std::vector<Plot>& plots, int columns, int width, const std::string& path)
{
    const int plot_width = width / columns, plot_height = plot_width * 3 / 4;
    const int rows = (static_cast<int>(plots.size()) + columns - 1) / columns;
    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(8);
    window->SetSize(width, rows * plot_height);
    for (std::size_t i = 0; i < plots.size(); ++i) {
        const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
        add_plot(pane(window, column * plot_width, (rows - 1 - row) * plot_height, plot_width, plot_height),
                 plots[i]);
    }
    window->Render();
    save_window(window, path);
}

} // namespace plash
