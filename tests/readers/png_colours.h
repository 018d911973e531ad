#pragma once

#include <string>

namespace plash::testing {

struct PngFacts {
    int width = 0, height = 0;
    int colours = 0;           ///< how many different ones
    double coloured_share = 0; ///< of pixels that are neither white nor grey
};

PngFacts facts_of_png(const std::string& path);

} // namespace plash::testing
