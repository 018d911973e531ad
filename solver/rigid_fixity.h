#pragma once

#include "model/model.h"

namespace plash {

/// Freedoms that *MAT_RIGID holds (CMO, CON1, CON2): CMO = 1 by codes along the global axes, CMO = -1 by six
/// digits along the axes of the coordinate system CON1. DeckError for codes that are neither.
BodyFixity fixity_of_part(const Model& model, Index part);

/// Local axes of a rigid part: the coordinate system LCO, or the vectors A and V, or the global axes.
std::array<Vec3, 3> local_axes_of_part(const Model& model, Index part);

} // namespace plash
