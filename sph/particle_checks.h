#pragma once

#include "core/state.h"
#include "model/model.h"
#include "sph/particle_body.h"

#include <string>
#include <vector>

/// What a deck with particles most likely did not mean: a line of text for each find.
namespace plash {

/// Parts whose particles are heavier or lighter by more than two than their density times the volume that
/// their spacing leaves them: a wrong unit, as a rule. The median particle decides. Too heavy is who would be
/// so by the cube on the distance to the sixth neighbour (the fourth in a plane: in a square lattice these
/// are at the spacing), too light who would be so by the nearest one; disordered particles and thin sheets
/// lie between the two.
std::vector<std::string> mass_notices(const Model& model, const std::vector<ParticlePart>& parts,
                                      int dimension);

/// Parts whose particles are in no contact although shells or solids stand closer to their box than it is
/// long, or come into it with the velocities of the start before the run ends. Eulerian cells and solids in
/// which particles wait are not in the way.
std::vector<std::string> contact_notices(const Model& model, const State& state,
                                         const std::vector<ParticlePart>& parts);

} // namespace plash
