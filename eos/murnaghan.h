#pragma once

#include "eos/response.h"
#include "math/lanes_math.h"
#include "model/record.h"

namespace plash {

/// *EOS_MURNAGHAN (019): p = K0 (compression^gamma - 1), water made compressible enough to be computed with
/// (weakly compressible flow): with K0 = rho0 c^2 / gamma the sound speed is c at reference density, and
/// gamma = 7 is Tait's water (Monaghan 1994). Pressure does not depend on the internal energy.
/// Source: Murnaghan (1944); LS-DYNA keyword manual, volume II, *EOS_019.
struct Murnaghan {
    double gamma = 7;
    double stiffness = 0;       ///< K0 [stress]
    double energy = 0;          ///< always zero: the card has no E0 [stress]
    double relative_volume = 1; ///< V0
    double bulk_modulus = 0;    ///< gamma K0 [stress]

    static Murnaghan from_record(const Record& record, double density);

    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        const Lane raised = gamma == 7 ? seventh(compression) : power(compression, gamma);
        return {stiffness * (raised - 1.0), Lane{}, bulk_modulus * raised / compression, Lane{}};
    }

private:
    template <class Lane>
    static Lane seventh(const Lane& a)
    {
        const Lane cube = a * a * a;
        return cube * cube * a;
    }
};

} // namespace plash
