#pragma once

#include "eos/response.h"
#include "model/record.h"

namespace plash {

/// *EOS_LINEAR_POLYNOMIAL (001): p = C0 + C1 mu + C2 mu^2 + C3 mu^3 + (C4 + C5 mu + C6 mu^2) E with
/// mu = compression - 1; the terms of C2 and C6 are left out in expansion (mu < 0). An ideal gas has
/// C4 = C5 = gamma - 1. Source: Hallquist (2006), LS-DYNA theory manual, equation of state form 1.
struct LinearPolynomial {
    double c0 = 0, c1 = 0, c2 = 0, c3 = 0; ///< [stress]
    double c4 = 0, c5 = 0, c6 = 0;
    double energy = 0;          ///< E0 [stress]
    double relative_volume = 1; ///< V0
    double bulk_modulus = 0;    ///< C1

    static LinearPolynomial from_record(const Record& record, double density);

    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        const Lane mu = compression - 1.0;
        const Lane squeezed = max(mu, Lane{});
        return {c0 + mu * (c1 + mu * mu * c3) + c2 * squeezed * squeezed,
                c4 + c5 * mu + c6 * squeezed * squeezed, c1 + 3 * c3 * mu * mu + 2 * c2 * squeezed,
                c5 + 2 * c6 * squeezed};
    }
};

} // namespace plash
