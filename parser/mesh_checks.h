#pragma once

#include "model/model.h"
#include "parser/report.h"

namespace plash {

/// Faults of the mesh and of units that only the whole Model shows: elements without volume or area or turned
/// inside out, corners that repeat where no shape allows it, materials whose density and stiffness belong to
/// no consistent set of units.
void check_mesh(const Model& model, Report& report);
void check_units(const Model& model, Report& report);

} // namespace plash
