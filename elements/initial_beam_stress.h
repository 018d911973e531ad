#pragma once

#include "model/model.h"

#include <map>
#include <vector>

namespace plash {

/// Stresses of a beam at the start (*INITIAL_STRESS_BEAM), in its own axes.
struct InitialBeamStress {
    struct Point {
        double axial = 0, shear_rs = 0, shear_tr = 0; ///< SIG11, SIG12, SIG31 [stress]
        double plastic_strain = 0;                    ///< EPS
    };
    Location where;
    std::vector<Point> points; ///< as the deck lists them; empty: resultants
    double axial = 0;          ///< F11 [force]
    double torsion = 0;        ///< T11 [moment]
};

/// By element of the Model; a later card replaces an earlier one. DeckError for what is not supported: global
/// axes (LOCAL = 0) with shear stresses, bending resultants.
std::map<Index, InitialBeamStress> initial_beam_stresses(const Model&);

} // namespace plash
