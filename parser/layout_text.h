#pragma once

#include "parser/layout.h"

#include <functional>

namespace plash {

/// Keywords of a layout text that share a body: their heads with the body.
struct LayoutBlock {
    std::vector<std::vector<std::string_view>> heads; ///< of each keyword its name and its aliases
    std::string_view text;
    int line = 0; ///< where it begins
};

/// Takes a text apart without reading bodies.
std::vector<LayoutBlock> layout_blocks(std::string_view text);

/// Reads the layouts of a text, or of a block of it that begins at `line`; `like NAME` takes the cards of
/// what `find` gives. Throws std::runtime_error naming the line for a mistake.
std::vector<std::unique_ptr<KeywordLayout>>
parse_layouts(std::string_view text, int line,
              const std::function<const KeywordLayout*(std::string_view)>& find);

} // namespace plash
