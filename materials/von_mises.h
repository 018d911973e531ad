#pragma once

#include "math/lanes.h"
#include "math/symmetric_tensor.h"

/// Radial return on the von Mises surface, in three dimensions and in plane stress, over one step in which
/// yield stress and back stress grow linearly.
namespace plash {

/// Hooke's law: adds the stress of a strain increment.
template <class Lane>
inline void add_elastic_stress(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                               double shear_modulus, double lame_modulus)
{
    const Lane pressure = lame_modulus * trace(increment);
    const double g = 2 * shear_modulus;
    stress.xx += pressure + g * increment.xx;
    stress.yy += pressure + g * increment.yy;
    stress.zz += pressure + g * increment.zz;
    stress.xy += g * increment.xy;
    stress.yz += g * increment.yz;
    stress.zx += g * increment.zx;
}

/// Hooke's law in plane stress; transverse shear is taken as it comes.
template <class Lane>
inline void add_plane_elastic_stress(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                                     double young_modulus, double poisson_ratio)
{
    const double plane = young_modulus / (1 - poisson_ratio * poisson_ratio);
    const double g = young_modulus / (1 + poisson_ratio);
    stress.xx += plane * (increment.xx + poisson_ratio * increment.yy);
    stress.yy += plane * (increment.yy + poisson_ratio * increment.xx);
    stress.xy += g * increment.xy;
    stress.yz += g * increment.yz;
    stress.zx += g * increment.zx;
}

/// Return to the von Mises surface in plane stress (Simo & Taylor 1986). Plastic strain flows along the
/// deviator, so each of the two eigenmodes of the elastic law shrinks by its own factor of the multiplier m,
/// plastic strain increment = m * deviator of the relative stress at the end of the step.
template <class Lane>
struct PlaneStressPath {
    double slow, fast;             ///< q(m)^2 = slow_square / (1 + slow m)^2 + fast_square / (1 + fast m)^2
    Lane slow_square, fast_square; ///< of the equivalent stress q at m = 0

    /// relative   trial stress less back stress in plane-stress form (zz = 0)
    /// kinematic  growth of the back stress (Prager) with effective plastic strain [stress]
    PlaneStressPath(const SymmetricTensor<Lane>& relative, double kinematic, double young_modulus,
                    double poisson_ratio)
        : slow(young_modulus / (3 * (1 - poisson_ratio)) + kinematic * 2 / 3),
          fast(young_modulus / (1 + poisson_ratio) + kinematic * 2 / 3)
    {
        const Lane sum = relative.xx + relative.yy, difference = relative.xx - relative.yy;
        slow_square = 0.25 * sum * sum;
        fast_square =
            0.75 * difference * difference +
            3.0 * (relative.xy * relative.xy + relative.yz * relative.yz + relative.zx * relative.zx);
    }

    /// From the squares of the equivalent stress in the two modes and how fast they shrink.
    PlaneStressPath(double slow_rate, double fast_rate, const Lane& slow_part, const Lane& fast_part)
        : slow(slow_rate), fast(fast_rate), slow_square(slow_part), fast_square(fast_part)
    {}

    /// Multiplier that brings q to the yield stress at the end of the step; zero inside the surface.
    /// yield      yield stress at the start of the step
    /// isotropic  its growth with effective plastic strain [stress]
    Lane multiplier(const Lane& yield, const Lane& isotropic) const
    {
        Lane m{};
        const MaskOf<Lane> yielding = slow_square + fast_square > yield * yield;
        if (!any(yielding)) return m;
        // q(m) (1 - growth m) = yield. Newton's iteration on yield / q, which is nearly linear in m, ends in
        // three or four rounds.
        const Lane growth = (2.0 / 3) * isotropic;
        for (int round = 0; round < 12; ++round) {
            const Lane u = 1.0 / (1.0 + slow * m), w = 1.0 / (1.0 + fast * m);
            const Lane slow_part = slow_square * u * u, fast_part = fast_square * w * w;
            const Lane inverse_square = 1.0 / (slow_part + fast_part);
            const Lane ratio = yield * sqrt(inverse_square);
            const Lane slope = ratio * inverse_square * (slow * slow_part * u + fast * fast_part * w);
            const Lane error = yielding ? ratio - 1.0 + growth * m : Lane{};
            // Lanes without any stress have no slope.
            m = yielding ? m - error / (slope + growth) : m;
            if (!any(abs(error) > 1e-13)) break;
        }
        return m;
    }

    /// Shrinks the relative stress by a multiplier; returns the increment of the effective plastic strain.
    Lane shrink(SymmetricTensor<Lane>& relative, const Lane& m) const
    {
        const Lane u = 1.0 / (1.0 + slow * m), w = 1.0 / (1.0 + fast * m);
        const Lane sum = relative.xx + relative.yy, difference = relative.xx - relative.yy;
        relative.xx = 0.5 * (u * sum + w * difference);
        relative.yy = 0.5 * (u * sum - w * difference);
        relative.xy *= w;
        relative.yz *= w;
        relative.zx *= w;
        return (2.0 / 3) * m * sqrt(slow_square * u * u + fast_square * w * w);
    }
};

} // namespace plash
