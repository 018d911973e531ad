#pragma once

#include <array>
#include <string>
#include <vector>

namespace plash {

/// One curve of a diagram.
struct PlotLine {
    std::string name;
    std::vector<double> x, y;
    std::array<double, 3> colour{0.13, 0.35, 0.70}; ///< red, green, blue
    bool markers = false;                           ///< circles instead of a line
};

/// One diagram.
struct Plot {
    std::string title, x_label, y_label;
    std::vector<PlotLine> lines;
};

/// Draws diagrams in rows of `columns` into a PNG file of `width` pixels. Needs a display (VirtualDisplay).
/// Throws std::runtime_error when the file cannot be written.
void draw_plots(const std::vector<Plot>& plots, int columns, int width, const std::string& path);

} // namespace plash
