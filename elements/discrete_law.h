#pragma once

#include "math/curve.h"
#include "model/model.h"

namespace plash {

/// Force of a spring or damper over its deflection and rate (*MAT_SPRING_..., *MAT_DAMPER_...: S01 to S05,
/// S07, S08). Moment and angle take the place of force and deflection in torsional ones. Source: LS-DYNA
/// keyword manual, volume II, *MAT_S01 to *MAT_S08.
struct DiscreteLaw {
    enum class Kind {
        elastic,           ///< S01: K
        viscous,           ///< S02: DC
        elastoplastic,     ///< S03: K, KT, FY with isotropic hardening
        nonlinear,         ///< S04: LCD, times LCR over the rate
        nonlinear_viscous, ///< S05: LCDR
        maxwell,           ///< S07: KI + (K0 - KI) exp(-BETA t)
        inelastic,         ///< S08: LCFD, unloading with KU, one sense only (CTF)
    };
    Kind kind = Kind::elastic;
    double stiffness = 0;         ///< K, K0 or KU [force/length]
    double tangent = 0;           ///< KT or KI [force/length]
    double yield_force = 0;       ///< FY [force]
    double damping = 0;           ///< DC [force time/length]
    double decay = 0;             ///< BETA [1/time]
    double sense = 1;             ///< S08: 1 carries compression only, -1 tension only
    Curve force;                  ///< over deflection or rate
    Curve rate_factor;            ///< LCR; no points: 1
    double largest_stiffness = 0; ///< for the stable step [force/length]

    static DiscreteLaw from_record(const Record& material, const Model& model);

    /// What a spring remembers.
    struct State {
        double deflection = 0;
        double force = 0;
        double hardening = 0; ///< S03: plastic way so far; S07: force of the relaxing part
    };

    /// Force at a new deflection; `state` is advanced.
    double advance(State& state, double deflection, double rate, double time_step) const;
};

} // namespace plash
