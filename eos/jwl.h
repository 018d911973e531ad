#pragma once

#include "eos/response.h"
#include "math/lanes_math.h"
#include "model/record.h"

namespace plash {

/// *EOS_JWL (002), the products of explosives: with the relative volume V = 1 / compression,
/// p = A (1 - w / (R1 V)) exp(-R1 V) + B (1 - w / (R2 V)) exp(-R2 V) + w E / V, w = OMEG.
/// Sources: Jones & Wilkins, in Lee, Hornig & Kury (1968), UCRL-50422; Hallquist (2006), LS-DYNA theory
/// manual, equation of state form 2.
struct Jwl {
    double a = 0, b = 0;        ///< A, B [stress]
    double r1 = 1, r2 = 1;      ///< R1, R2
    double omega = 0;           ///< OMEG
    double energy = 0;          ///< E0 [stress]
    double relative_volume = 1; ///< VO
    double bulk_modulus = 0;    ///< slope of the pressure at V = 1 without energy [stress]

    static Jwl from_record(const Record& record, double density);

    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        const Lane volume = 1.0 / compression, square = volume * volume;
        const Lane first = a * exp(Lane{-r1 * volume}), second = b * exp(Lane{-r2 * volume});
        const Lane one = 1.0 - (omega / r1) * compression, two = 1.0 - (omega / r2) * compression;
        return {first * one + second * two, omega * compression,
                first * (r1 * one * square - omega / r1) + second * (r2 * two * square - omega / r2),
                broadcast<Lane>(omega)};
    }
};

} // namespace plash
