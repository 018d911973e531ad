#pragma once

#include "elements/solid_group.h"
#include "elements/thick_shell_step.h"

#include <span>

namespace plash {

/// *SECTION_TSHELL of a part, or its *PART_COMPOSITE_TSHELL. DeckError when there is neither.
const Record& thick_shell_section(const Model& model, const Part& part);

/// Plies of an element: its own (_COMPOSITE), else those of its part (*PART_COMPOSITE_TSHELL), else none.
std::span<const Layer> thick_shell_layers(const Model& model, Index element);

/// Stress of the formulation (ELFORM): 1, 2 and 6 are shells, 3, 5 and 7 solids. DeckError for others.
ThickShellStress thick_shell_stress(const Model& model, const Part& part);

/// Elastic constants and density of the law of a part.
struct ThickShellElasticity {
    double density = 0, young_modulus = 0, poisson_ratio = 0;
};

/// Reads and checks what section, *HOURGLASS and controls say for the thick shells of a part; completes
/// density and bulk viscosity of the set-up's parameters.
/// plies  number of them; 0: the points are those of the section's rule
ThickShellSettings thick_shell_settings(const Model& model, const Part& part,
                                        const ThickShellElasticity& elastic, int plies,
                                        SolidParameters& parameters);

} // namespace plash
