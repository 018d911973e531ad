#pragma once

#include "picture/plots.h"

#include <string>
#include <vector>

namespace plash {

/// Reads diagrams from a text file, one word group a line, groups divided by tabs:
///     plot    TITLE   X_LABEL   Y_LABEL
///     line    NAME    [markers]
///     X       Y
/// Lines get distinct colours in the order of their names, and the same one in every diagram of the file.
/// Throws std::runtime_error with the line that does not fit.
std::vector<Plot> read_diagrams(const std::string& path);

} // namespace plash
