#pragma once

#include "output/binout.h"

namespace plash {

/// Sections of deforc, disbout, nodfor, trhist; null for other files.
std::unique_ptr<BinoutSection> make_discrete_section(const std::string& file_name, const Model& model);

} // namespace plash
