#pragma once

#include "model/model.h"

#include <string>
#include <string_view>

/// The common pieces of LS-DYNA's ASCII result files.
namespace plash {

/// Appends `value` in `width` columns with `digits` decimals as Fortran's 1PEw.d prints it: right-aligned,
/// the E left out where the exponent needs three figures.
void append_scientific(std::string& text, double value, int width, int digits);

/// Of the program, as written into result files.
std::string_view plash_version();

/// The two lines that open every ASCII file: the deck's title and the program with its version.
std::string ascii_heading(const Model&);

/// The block that names entities; `entries` comes from legend_entry.
std::string ascii_legend(std::string_view entries);

/// One line of a legend: number and title, padded to the width the file has (80 in nodout, 72 in matsum).
std::string legend_entry(Id id, std::string_view title, int title_width);

} // namespace plash
