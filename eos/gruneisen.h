#pragma once

#include "eos/response.h"
#include "model/record.h"

namespace plash {

/// *EOS_GRUNEISEN (004) with a cubic shock velocity. With mu = compression - 1, in compression
///   p = rho0 C^2 mu [1 + (1 - gamma0 / 2) mu - a / 2 mu^2]
///       / [1 - (S1 - 1) mu - S2 mu^2 / (mu + 1) - S3 mu^3 / (mu + 1)^2]^2 + (gamma0 + a mu) E,
/// in expansion p = rho0 C^2 mu + (gamma0 + a mu) E.
/// Source: Hallquist (2006), LS-DYNA theory manual, equation of state form 4.
///
/// The denominator has a zero where the shock velocity of the fit becomes infinite; behind it the formula
/// would give pressures that fall again. From `largest` on, where the shock is ten times as fast as sound
/// (far outside of any fit), the pressure goes on along its tangent.
struct Gruneisen {
    double s1 = 0, s2 = 0, s3 = 0;
    double gamma = 0;           ///< GAMMA0
    double a = 0;               ///< first-order volume correction of gamma
    double energy = 0;          ///< E0 [stress]
    double relative_volume = 1; ///< V0
    double bulk_modulus = 0;    ///< rho0 C^2 [stress]
    double largest = 1e300;     ///< mu from which the tangent takes over

    static Gruneisen from_record(const Record& record, double density);

    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        const Lane mu = compression - 1.0;
        const Lane squeezed = min(max(mu, Lane{}), broadcast<Lane>(largest));
        // In powers of z = mu / (mu + 1): denominator = 1 - (S1 - 1) mu - mu (S2 z + S3 z^2).
        const Lane inverse = 1.0 / (1.0 + squeezed);
        const Lane z = squeezed * inverse, z_slope = inverse * inverse;
        const Lane denominator = 1.0 - squeezed * ((s1 - 1) + z * (s2 + s3 * z));
        const Lane denominator_slope =
            -((s1 - 1) + z * (s2 + s3 * z)) - squeezed * z_slope * (s2 + 2 * s3 * z);
        const Lane numerator = squeezed * (1.0 + squeezed * ((1 - 0.5 * gamma) - 0.5 * a * squeezed));
        const Lane numerator_slope = 1.0 + squeezed * (2 * (1 - 0.5 * gamma) - 1.5 * a * squeezed);
        const Lane per = 1.0 / denominator, per_square = per * per;
        const MaskOf<Lane> expanded = mu < 0.0;
        const Lane slope = (numerator_slope - 2.0 * numerator * per * denominator_slope) * per_square;
        const Lane beyond = max(mu - largest, Lane{});
        return {bulk_modulus * (expanded ? mu : numerator * per_square + slope * beyond), gamma + a * mu,
                bulk_modulus * slope, broadcast<Lane>(a)};
    }
};

} // namespace plash
