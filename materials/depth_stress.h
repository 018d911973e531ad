#pragma once

#include "math/symmetric_tensor.h"
#include "model/model.h"

#include <vector>

namespace plash {

/// *INITIAL_STRESS_DEPTH, _SET: the stress of a part at the start that grows with the depth below a datum.
struct DepthStress {
    Index part = none;
    Location where;
    double slope = 0;   ///< weight by volume, RO_G [stress/length]
    double datum = 0;   ///< ZDATUM, where the stress is zero [length]
    double lateral = 0; ///< KFACT: x and y stress over the z stress [-]

    /// Along z, negative below the datum [stress].
    double vertical(double z) const { return slope * (z - datum); }
    SymmetricTensor<double> at(double z) const
    {
        const double stress = vertical(z);
        return {lateral * stress, lateral * stress, stress, 0, 0, 0};
    }
};

/// Those of a deck; a later card replaces an earlier one. DeckError for a part that has neither solids nor
/// particles.
std::vector<DepthStress> depth_stresses(const Model&);

} // namespace plash
