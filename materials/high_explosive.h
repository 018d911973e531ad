#pragma once

#include "materials/parameters.h"

#include <vector>

namespace plash {

/// *MAT_HIGH_EXPLOSIVE_BURN (008): an explosive whose products' pressure is that of its equation of state
/// times the burnt share F = min(1, max(F1, F2)), which never falls:
///   F1 = 2/3 (t - t_light) D A / v   programmed burn; A / v largest side over volume of the element
///   F2 = (1 - V) / (1 - V_CJ)        beta burn, by compression; V_CJ = 1 - PCJ / (rho0 D^2)
/// BETA = 0: both, 1: F2, 2: F1. What has not burnt bears K (1/V - 1) and, up to SIGY, shear, each times 1 -
/// F (the manual gives K, G, SIGY a meaning with BETA = 2 only). Sources: Wilkins (1964), 'Calculation of
/// elastic-plastic flow'; Giroux (1971), HEMP user's manual; Hallquist (2006), LS-DYNA theory manual,
/// material model 8.
struct HighExplosive {
    double density = 0;           ///< [mass/volume]
    double detonation_speed = 0;  ///< D [velocity]
    double burnt_compression = 0; ///< 1 - V_CJ
    bool by_program = true;       ///< F1
    bool by_compression = true;   ///< F2
    double bulk_modulus = 0;      ///< K, before it burns [stress]
    double shear_modulus = 0;     ///< G [stress]
    double yield_stress = 0;      ///< SIGY [stress]

    static HighExplosive from_record(const Record& record);
};

/// A point from which an explosive is lit (*INITIAL_DETONATION).
struct Detonator {
    Vec3 place{};
    double time = 0; ///< LT [time]
};

/// The detonators of a part; one that names no part lights them all. DeckError for acoustic boundaries (PID <
/// 0).
std::vector<Detonator> detonators_of(const Model&, const Part&);

/// Time at which a point is reached by the front of the first detonator; 0 without any, as in LS-DYNA.
double lighting_time(const std::vector<Detonator>&, const Vec3& point, double detonation_speed);

} // namespace plash
