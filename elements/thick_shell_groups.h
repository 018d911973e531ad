#pragma once

#include "elements/solid_group.h"

#include <memory>
#include <vector>

namespace plash {

/// Groups of all deformable thick shells of a Model (*ELEMENT_TSHELL), in the order of its parts; adds their
/// masses to state.mass. DeckError for what a part asks that is not supported.
std::vector<std::unique_ptr<SolidGroup>> make_thick_shell_groups(const Model&, State&);

/// Makes the groups of a part of one law.
using ThickShellMaker = std::unique_ptr<SolidGroup>(const Record& material, SolidSetup, State&);

ThickShellMaker make_elastic_thick_shells;
ThickShellMaker make_plastic_kinematic_thick_shells;
ThickShellMaker make_piecewise_linear_thick_shells;
ThickShellMaker make_johnson_cook_thick_shells;
ThickShellMaker make_damaged_plasticity_thick_shells;
ThickShellMaker make_compression_tension_thick_shells;
ThickShellMaker make_crushable_foam_thick_shells;

/// Plies of their own materials, or points of an orthotropic material; `elements` have the same sequence.
std::unique_ptr<SolidGroup> make_laminate_thick_shells(SolidSetup, State&);

} // namespace plash
