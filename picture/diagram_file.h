#pragma once

#include "picture/plots.h"

#include <string>
#include <vector>

namespace plash {

/// Reads diagrams from a text file, one word group a line, groups divided by tabs:
///     plot    TITLE   X_LABEL   Y_LABEL
///     line    NAME    [markers]
///     X       Y
/// Lines get distinct colours in their order. Throws std::runtime_error with the line that does not fit.
std::vector<Plot> read_diagrams(const std::string& path);

} // namespace plash
