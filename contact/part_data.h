#pragma once

#include "model/measures.h"
#include "model/model.h"

namespace plash {

/// What contact needs to know of a part beside its mesh.
struct PartData {
    double density = 0;      ///< [density]
    double bulk_modulus = 0; ///< [stress]; 0: the material gives none that contact could use
    double thickness = 0;    ///< of shells by their section [length]; 0 for other parts
    double beam_radius = 0;  ///< of beams, half the outer diameter [length]
    double beam_area = 0;    ///< of beams [length^2]
    bool spot_weld = false;  ///< beams of ELFORM 9
    bool rigid = false;
};

/// Name of a contact's term, with the number by which the deck knows it.
std::string name_of(std::string_view kind, const Contact& contact);

/// Bulk modulus from E and PR (or what the law has in their place), else from the equation of state.
double bulk_modulus_of(const Model& model, const Part& part);

/// By part of the Model.
std::vector<PartData> part_data(const Model& model);

/// Mass of each node from density and volume of its elements (solids, shells, beams) [mass]. The State's
/// masses cannot serve for nodes of rigid bodies, whose mass the body carries.
std::vector<double> lumped_masses(const Model& model, const std::vector<PartData>& parts);

} // namespace plash
