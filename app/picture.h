#pragma once

#include <string>

namespace plash {

/// Draws picture.png into the result directory of a run by the drawing program; false when that failed (it
/// has then said why).
bool draw_picture(const std::string& directory);

} // namespace plash
