#pragma once

#include "math/lanes.h"
#include "math/symmetric_tensor.h"

#include <cmath>

namespace plash {

/// A spring with a dashpot behind it (Maxwell's element), for the deviator: the stress s obeys
/// ds/dt + decay s = 2 modulus de/dt. Sums of them are Prony series.
struct MaxwellElement {
    double modulus = 0; ///< shear modulus of the spring [stress]
    double decay = 0;   ///< 1 / relaxation time [1/time]

    /// Factors of a step at a constant strain rate, for which they are exact: s_new = keep s + gain de.
    struct Step {
        double keep, gain;
    };
    Step step(double time_step) const
    {
        const double x = decay * time_step;
        const double share = x > 1e-8 ? -std::expm1(-x) / x : 1 - 0.5 * x;
        return {std::exp(-x), 2 * modulus * share};
    }
};

} // namespace plash
