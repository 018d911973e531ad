#pragma once

#include "materials/depth_stress.h"
#include "solver/fluids/new_water.h"

/// How water that the deck has at rest is at rest in another form.
namespace plash {

/// *INITIAL_HYDROSTATIC_ALE: water that is no mesh rests where the static start puts it
/// (*CONTROL_DYNAMIC_RELAXATION IDRFLG = 5), with the loads of the frame that act in the run. A deck that
/// asks for a phase of its own keeps it.
void rest_as_elements(Model& model, std::vector<std::string>& lines);

/// *INITIAL_STRESS_DEPTH of the water, as `stresses` have it: the mesh begins at rest below its datum under
/// the gravity of its weight (*INITIAL_HYDROSTATIC_ALE). DeckError where the parts of the water have several.
void rest_in_mesh(Model& model, const Water& water, const std::vector<DepthStress>& stresses,
                  const NewWater& made, std::vector<std::string>& lines);

} // namespace plash
