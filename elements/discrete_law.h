#pragma once

#include "math/curve.h"
#include "model/model.h"

namespace plash {

/// Force of a spring or damper over its deflection and rate (*MAT_SPRING_..., *MAT_DAMPER_...: S01 to S08).
/// Moment and angle take the place of force and deflection in torsional ones. Source: LS-DYNA keyword manual,
/// volume II, *MAT_S01 to *MAT_S08.
struct DiscreteLaw {
    enum class Kind {
        elastic,           ///< S01: K
        viscous,           ///< S02: DC
        elastoplastic,     ///< S03: K, KT, FY with isotropic hardening
        nonlinear,         ///< S04: LCD, times LCR over the rate
        nonlinear_viscous, ///< S05: LCDR
        general,           ///< S06: loads along LCDL, unloads along LCDU once it has yielded
        maxwell,           ///< S07: KI + (K0 - KI) exp(-BETA t)
        inelastic,         ///< S08: LCFD, unloading with KU, one sense only (CTF)
    };
    Kind kind = Kind::elastic;
    double stiffness = 0;                            ///< K, K0 or KU [force/length]
    double tangent = 0;                              ///< KT or KI [force/length]
    double yield_force = 0;                          ///< FY [force]
    double damping = 0;                              ///< DC [force time/length]
    double decay = 0;                                ///< BETA [1/time]
    double sense = 1;                                ///< S08: 1 carries compression only, -1 tension only
    Curve force;                                     ///< over deflection or rate
    Curve rate_factor;                               ///< LCR; no points: 1
    Curve unloading;                                 ///< S06: LCDU
    double tensile_yield = 0, compressive_yield = 0; ///< S06: TYI and CYI (below 0) [force]
    /// S06, BETA: what yielding on one side does to the yield force of the other.
    enum class Hardening { independent, isotropic, kinematic };
    Hardening rule = Hardening::independent;
    double largest_stiffness = 0; ///< for the stable step [force/length]

    static DiscreteLaw from_record(const Record& material, const Model& model);

    /// What a spring remembers.
    struct State {
        double deflection = 0;
        double force = 0;
        double hardening = 0; ///< S03: plastic way so far; S07: force of the relaxing part
        // S06
        bool yielded = false;
        int side = 0; ///< 1, -1: on the loading curve in tension, compression
        int left = 0; ///< the side that unloading has come from
        double loading_shift = 0, unloading_shift = 0; ///< of the curves along the deflection
        double upper = 0, lower = 0;                   ///< forces at which the spring yields again
    };

    /// Force at a new deflection; `state` is advanced.
    double advance(State& state, double deflection, double rate, double time_step) const;

private:
    double general_force(State& state, double deflection, double last) const;
    void harden(State& state) const;
};

} // namespace plash
