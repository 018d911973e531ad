#pragma once

#include "elements/solid_group.h"

#include <memory>
#include <span>
#include <vector>

namespace plash {

/// Groups of all deformable solids of a Model, in the order of its parts; adds their masses to state.mass.
/// A part whose mesh holds wedges, pyramids or tetrahedra gets a group for each of these shapes. Parts of
/// *MAT_RIGID have no group (solid_masses). DeckError when formulation, material, equation of state or
/// hourglass type is not there, or when an element has no positive volume.
std::vector<std::unique_ptr<SolidGroup>> make_solid_groups(const Model&, State&);

/// Masses of the solids and thick shells of a part as lumped to its nodes: entry i belongs to nodes[i]. For
/// rigid parts, which need no elements.
struct SolidMasses {
    double total = 0;
    std::vector<Index> nodes; ///< in rising order
    std::vector<double> mass; ///< of each of `nodes`
};
SolidMasses solid_masses(const Model&, Index part);

/// The material records that solids can have, by canonical keyword.
std::vector<std::string_view> solid_material_keywords();

} // namespace plash
