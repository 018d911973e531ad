#pragma once

#include "model/displacement.h"
#include "model/model.h"

#include <string>

namespace plash {

/// Reads the file of a prescribed geometry (*CONTROL_DYNAMIC_RELAXATION IDRFLG = 2; LS-DYNA's m= on the
/// command line) of a deck: a line for each node with its number, displacements along x, y and z and,
/// if wanted, rotations about them [radian], in columns of 8 and six times 15 characters or apart by blanks
/// or commas. Lines that begin with $ are comments. RunError with file and line; also when the deck has
/// another IDRFLG, or when it has 2 and no path is given.
std::vector<NodeDisplacement> read_prescribed_geometry(const std::string& path, const Model& model);

} // namespace plash
