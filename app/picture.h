#pragma once

#include <string>

namespace plash {

/// Draws picture.png into the result directory of a run by the drawing program; false when that failed (it
/// has then said why).
bool draw_picture(const std::string& directory);

/// Draws a file of diagrams (picture/diagram_file.h) into a PNG file by the drawing program; false when that
/// failed.
bool draw_diagrams(const std::string& file, const std::string& png);

} // namespace plash
