#pragma once

#include "core/state.h"
#include "core/term.h"
#include "elements/beam_store.h"

#include <memory>
#include <vector>

namespace plash {

/// Groups of all deformable beams of a Model; adds their masses and rotary inertias to the state. Beams of
/// *MAT_NULL only have mass: contacts see them. DeckError when formulation or material is not there, or when
/// an element has no length or no direction.
std::vector<std::unique_ptr<Term>> make_beam_groups(const Model&, State&);

/// Adds the masses alone of the beams of a part: of *MAT_NULL, or of a rigid part. Half of each to either
/// end; discrete beams (ELFORM 6) have that of their VOL. DeckError as above.
void add_beam_masses(const BeamPart&, State&);

/// Makes the group of a part with one law; one .cpp file a law.
using BeamGroupMaker = std::unique_ptr<Term>(const BeamPart&, BeamSettings, State&);
BeamGroupMaker make_elastic_beams;
BeamGroupMaker make_piecewise_linear_beams;
BeamGroupMaker make_plastic_kinematic_beams;
BeamGroupMaker make_spot_weld_beams;

} // namespace plash
