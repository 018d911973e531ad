#pragma once

#include "picture/surface.h"

#include <optional>
#include <string>
#include <vector>

namespace plash {

/// How a strip of pictures looks.
struct StripStyle {
    std::string title;
    std::string legend;                         ///< of the colour bar
    std::array<double, 3> from{1, -1.6, 0.9};   ///< where the eye is, seen from the model
    std::optional<std::array<double, 2>> range; ///< of the colours; otherwise that of all values
    double beyond = 0;                          ///< share of values that may exceed that range
    int width = 1800;                           ///< [pixel]
    bool edges = true;                          ///< draw the edges of the elements
};

/// Draws the surfaces side by side in one view, with times, walls and a colour bar, and writes a PNG file.
/// Needs a display (VirtualDisplay). Throws std::runtime_error when the file cannot be written.
void draw_strip(const std::vector<Surface>& surfaces,
                const std::vector<std::array<std::array<float, 3>, 4>>& walls, const StripStyle& style,
                const std::string& path);

} // namespace plash
