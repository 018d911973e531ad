#pragma once

#include "materials/left_cauchy_green.h"
#include "materials/parameters.h"
#include "math/lanes.h"
#include "math/tensor3.h"

namespace plash {

/// *MAT_MOONEY-RIVLIN_RUBBER (027): hyperelastic rubber with the strain energy by reference volume
///   W = A (I - 3) + B (II - 3) + C (III^-2 - 1) + D (III - 1)^2,
///   C = A / 2 + B,  D = (A (5 nu - 2) + B (11 nu - 5)) / (2 (1 - 2 nu)),
/// of the invariants of the right Cauchy-Green tensor; 2 (A + B) is the shear modulus at small strains.
/// Source: Hallquist (2006), LS-DYNA theory manual, material model 27 (Mooney 1940, Rivlin 1948).
struct MooneyRivlin {
    double density = 0;       ///< [mass/volume]
    double a = 0, b = 0;      ///< [stress]
    double poisson_ratio = 0; ///< [-]

    /// Constants from the card, or from its tension test: force (LCID) over the change of the gauge length
    /// SGL of a strip of width SW and thickness ST, fitted by least squares as incompressible.
    static MooneyRivlin from_record(const Record& record, const Model& model);

    double c() const { return 0.5 * a + b; }
    double d() const
    {
        return (a * (5 * poisson_ratio - 2) + b * (11 * poisson_ratio - 5)) / (2 * (1 - 2 * poisson_ratio));
    }
    double shear_modulus() const { return 2 * (a + b); }

    /// Strain energy by reference volume [stress].
    template <class Lane>
    Lane energy(const Tensor3<Lane>& deformation) const
    {
        const LeftCauchyGreen<Lane> i = left_cauchy_green(deformation);
        const Lane volumetric = i.third - 1.0;
        return a * (i.first - 3.0) + b * (i.second - 3.0) + c() * (1.0 / (i.third * i.third) - 1.0) +
               d() * volumetric * volumetric;
    }

    /// Cauchy stress of a deformation gradient [stress].
    template <class Lane>
    SymmetricTensor<Lane> stress(const Tensor3<Lane>& deformation) const
    {
        const LeftCauchyGreen<Lane> i = left_cauchy_green(deformation);
        const SymmetricTensor<Lane>& l = i.left;
        const Lane factor = 2.0 / sqrt(i.third);
        const Lane linear = factor * (a + b * i.first), square = -factor * b;
        const Lane pressure = factor * i.third * third_slope(i.third);
        return {linear * l.xx + square * (l.xx * l.xx + l.xy * l.xy + l.zx * l.zx) + pressure,
                linear * l.yy + square * (l.xy * l.xy + l.yy * l.yy + l.yz * l.yz) + pressure,
                linear * l.zz + square * (l.zx * l.zx + l.yz * l.yz + l.zz * l.zz) + pressure,
                linear * l.xy + square * (l.xx * l.xy + l.xy * l.yy + l.zx * l.yz),
                linear * l.yz + square * (l.xy * l.zx + l.yy * l.yz + l.yz * l.zz),
                linear * l.zx + square * (l.zx * l.xx + l.yz * l.xy + l.zz * l.zx)};
    }

    /// Density times the square of the speed of the fastest compression wave along a principal direction,
    /// from above; exact without deformation [stress].
    template <class Lane>
    Lane wave_modulus(const Tensor3<Lane>& deformation) const
    {
        const LeftCauchyGreen<Lane> i = left_cauchy_green(deformation);
        // lambda^2 / J d2W/dlambda^2 with the largest squared stretch s.
        const Lane s = i.largest_square();
        const Lane inner = min(s, Lane{0.5 * i.first});
        const Lane inverse = 1.0 / i.third, inverse2 = inverse * inverse;
        const Lane third_curvature = 6 * c() * inverse2 * inverse2 + 2 * d();
        return (2 * a * s + 2 * b * inner * (i.first - inner) + 4.0 * i.third * i.third * third_curvature +
                2.0 * i.third * third_slope(i.third)) /
               sqrt(i.third);
    }

private:
    /// dW/dIII.
    template <class Lane>
    Lane third_slope(const Lane& third) const
    {
        return 2 * d() * (third - 1.0) - 2 * c() / (third * third * third);
    }
};

} // namespace plash
