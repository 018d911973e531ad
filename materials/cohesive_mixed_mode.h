#pragma once

#include "materials/parameters.h"
#include "math/lanes_math.h"
#include "math/vector3.h"

#include <algorithm>

namespace plash {

/// *MAT_COHESIVE_MIXED_MODE (138): bilinear traction over separation with damage in mixed mode. With the
/// normal separation dI = max(dn, 0), the shear dII, dm = sqrt(dI^2 + dII^2) and the mode ratio b = dII / dI:
///   damage begins at  d0 = dI0 dII0 sqrt((1 + b^2) / (dII0^2 + (b dI0)^2)),   dI0 = T / EN, dII0 = S / ET
///   is complete at    dF, by the power law (XMU > 0)
///     dF = 2 (1 + b^2) / d0 [(EN / GIC)^XMU + (ET b^2 / GIIC)^XMU]^(-1 / XMU)
///   or by Benzeggagh & Kenane (XMU < 0), with g = GAMMA,
///     dF = 2 / (d0 [(EN^g + b^2 ET^g) / (1 + b^2)]^(1 / g)) [GIC + (GIIC - GIC) (b^2 ET / (EN + b^2
///     ET))^|XMU|]
/// and D = dF (dm - d0) / (dm (dF - d0)), which never falls. Tractions: (1 - D) E d, but EN dn in
/// compression. Sources: Camanho & Davila (2002), NASA/TM-2002-211737; Benzeggagh & Kenane (1996), Compos.
/// Sci. Technol. 56, 439-449; LS-DYNA keyword manual, volume II, *MAT_138.
struct CohesiveMixedMode {
    double density = 0;                               ///< [mass/volume], or [mass/area] with by_area
    bool by_area = false;                             ///< ROFLG = 1
    double normal_stiffness = 0, shear_stiffness = 0; ///< EN, ET [stress/length]
    double normal_energy = 0, shear_energy = 0;       ///< GIC, GIIC [energy/area]
    double normal_strength = 0, shear_strength = 0;   ///< T, S [stress]
    double exponent = 0;                              ///< XMU
    double mean_exponent = 1;                         ///< GAMMA
    int points_to_fail = 0;                           ///< |INTFAIL|: 0: elements are never deleted
    bool at_corners = true;                           ///< INTFAIL <= 0: Newton-Cotes, else Gauss points

    static CohesiveMixedMode from_record(const Record& record);

    /// Traction of a batch of points.
    /// separation  of the upper side from the lower one; x and y along the surface, z normal [length]
    /// damage      largest so far, in and out
    template <class Lane>
    Vector3<Lane> traction(const Vector3<Lane>& separation, Lane& damage) const
    {
        const Lane opening = max(separation.z, Lane{});
        const Lane normal = opening * opening;
        const Lane shear = separation.x * separation.x + separation.y * separation.y;
        const Lane mixed = normal + shear;
        // Shares of both modes in the square of the separation, instead of b^2, which may be infinite.
        const Lane per = 1.0 / max(mixed, broadcast<Lane>(1e-300));
        const Lane n = normal * per, s = shear * per;
        const double first_normal = normal_strength / normal_stiffness;
        const double first_shear = shear_strength / shear_stiffness;
        const Lane first = first_normal * first_shear /
                           sqrt(Lane{n * (first_shear * first_shear) + s * (first_normal * first_normal)});
        const Lane distance = sqrt(mixed);
        const Lane one = broadcast<Lane>(1);
        if (any(distance > first)) {
            const Lane last = complete(n, s, first);
            const Lane now = last * (distance - first) / (max(distance, first) * (last - first));
            damage = distance > first ? max(damage, min(now, one)) : damage;
        }
        const Lane left = one - damage;
        const Lane pressed = min(separation.z, Lane{});
        return {left * shear_stiffness * separation.x, left * shear_stiffness * separation.y,
                normal_stiffness * (left * opening + pressed)};
    }

private:
    /// Separation at which damage is complete, for shares n and s of the modes.
    template <class Lane>
    Lane complete(const Lane& n, const Lane& s, const Lane& first) const
    {
        if (exponent > 0) {
            const Lane sum = power_of(Lane{n * (normal_stiffness / normal_energy)}, exponent) +
                             power_of(Lane{s * (shear_stiffness / shear_energy)}, exponent);
            return 2.0 / (first * power_of(sum, 1 / exponent));
        }
        const double en = std::pow(normal_stiffness, mean_exponent);
        const double et = std::pow(shear_stiffness, mean_exponent);
        const Lane stiffness = power_of(Lane{n * en + s * et}, 1 / mean_exponent);
        const Lane share = s * shear_stiffness / (n * normal_stiffness + s * shear_stiffness);
        const Lane energy =
            normal_energy + (shear_energy - normal_energy) * power_of(share, std::abs(exponent));
        return 2.0 * energy / (first * stiffness);
    }

    /// A power of what is not negative.
    template <class Lane>
    static Lane power_of(const Lane& base, double to)
    {
        const Lane safe = max(base, broadcast<Lane>(1e-300));
        return base > 1e-300 ? power(safe, to) : Lane{};
    }
};

} // namespace plash
