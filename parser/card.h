#pragma once

#include "parser/layout.h"

#include <string>
#include <string_view>
#include <vector>

namespace plash {

/// How a line was cut into fields.
enum class Cut {
    fixed,     ///< by columns
    free,      ///< by commas
    surplus,   ///< by commas, with values behind those of the last field
    by_blanks, ///< numbers do not stand in their columns: read as they are separated by blanks
    shifted    ///< all columns stand a little to the right of their place
};

/// For the report: what was done with a line whose numbers do not stand in their columns or are too many;
/// empty for the others.
std::string_view to_warning(Cut cut);

/// Columns that a field takes in a format: `minimum_width` 0 small, 10 I10, 20 long (where texts double).
int field_width(const FieldLayout& field, int minimum_width);

/// Cuts data lines into fields.
class CardCutter {
public:
    /// The text of each field of `fields`, untrimmed; empty where the line ends before. The views live until
    /// the next call or as long as `line`, whichever ends first.
    Cut cut(std::string_view line, const std::vector<FieldLayout>& fields, int minimum_width,
            std::vector<std::string_view>& tokens);

private:
    std::string expanded_; ///< the line without tabs
};

} // namespace plash
