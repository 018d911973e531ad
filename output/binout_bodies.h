#pragma once

#include "output/binout.h"

namespace plash {

/// Sections of rbdout, jntforc and swforc; null for other files.
std::unique_ptr<BinoutSection> make_body_section(const std::string& file_name, const Model& model);

/// Resultants and points of some beams as elout has them; nothing where all have gone.
void put_elout_beams(const Snapshot&, ArrayFile&, const std::vector<Index>& beams, const std::string& folder);

} // namespace plash
