#pragma once

#include "math/lanes.h"
#include "math/symmetric_tensor.h"
#include "model/model.h"

#include <map>
#include <vector>

namespace plash {

/// Stress of one point at the start, in global axes [stress].
struct InitialStressPoint {
    double place = 0; ///< shells: through the thickness, -1 bottom to 1 top
    SymmetricTensor<double> stress;
    double plastic_strain = 0;
};

/// Stresses of an element at the start (*INITIAL_STRESS_SOLID, _SHELL).
struct InitialStress {
    Location where;
    std::vector<InitialStressPoint> points; ///< as the deck lists them
};

/// By element of the Model; a later card replaces an earlier one.
using InitialStresses = std::map<Index, InitialStress>;

/// *INITIAL_STRESS_SOLID (_SET), *INITIAL_STRESS_SHELL (_SET) and *INITIAL_STRESS_TSHELL.
InitialStresses initial_solid_stresses(const Model&);
InitialStresses initial_shell_stresses(const Model&);
InitialStresses initial_thick_shell_stresses(const Model&);

/// *INITIAL_STRAIN_SOLID (_SET), _SHELL (_SET) and _TSHELL, with strains in place of stresses: where the
/// strains that result files show begin. Empty unless these are wanted (STRFLG).
InitialStresses initial_solid_strains(const Model&);
InitialStresses initial_shell_strains(const Model&);
InitialStresses initial_thick_shell_strains(const Model&);

/// Stress and plastic strain at a place through the thickness of column `column` of the points in a plane, by
/// lines between the places that the deck gives; beyond the outermost ones their line goes on.
InitialStressPoint through_thickness(const InitialStress&, double place, int column);

/// Mean of all points.
InitialStressPoint mean_of(const InitialStress&);

/// Writes a tensor into one lane of six values.
inline void put_stress(const SymmetricTensor<double>& stress, Lanes* values, int lane)
{
    const double components[] = {stress.xx, stress.yy, stress.zz, stress.xy, stress.yz, stress.zx};
    for (int i = 0; i < 6; ++i) values[i][lane] = components[i];
}

} // namespace plash
