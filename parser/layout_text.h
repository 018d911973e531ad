#pragma once

#include "parser/layout.h"

namespace plash {

/// Reads the layouts of one text; later `like NAME` lines may name keywords of `known` and of the text
/// itself. Throws std::runtime_error naming the line for a mistake.
void parse_layouts(std::string_view text, std::vector<std::unique_ptr<KeywordLayout>>& known);

} // namespace plash
