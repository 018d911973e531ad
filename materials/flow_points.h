#pragma once

#include "math/curve.h"
#include "model/record.h"

namespace plash {

/// EPS1.. with ES1..: points of a flow curve over plastic strain, up to `most` of them; empty when the card
/// has none. The list ends with the first empty point behind the first one. DeckError for stresses that are
/// not positive and strains that do not rise.
Curve flow_points(const Record& record, int most);

} // namespace plash
