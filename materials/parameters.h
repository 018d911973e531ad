#pragma once

#include "model/model.h"
#include "model/record.h"

#include <string>
#include <string_view>

/// Reading the numbers of a law with the checks that every law needs.
namespace plash {

/// Throws a DeckError that names keyword and field: "*MAT_ELASTIC, field E: -3 is not positive (Young's
/// modulus)".
[[noreturn]] void reject_field(const Record&, std::string_view field, std::string_view complaint);

/// Value of a field that must be above zero. `meaning` is for the message.
double positive(const Record&, std::string_view field, std::string_view meaning);

/// Poisson's ratio "PR", which must lie in (-1, 0.5).
double poisson_ratio_of(const Record&);

/// The curve that a field names by its id; throws when there is none of that id.
const NamedCurve& curve_of(const Record&, std::string_view field, const Model&);

} // namespace plash
