#pragma once

#include "materials/left_cauchy_green.h"
#include "materials/parameters.h"
#include "math/lanes_math.h"

namespace plash {

/// *MAT_BLATZ-KO_RUBBER (007): polyurethane rubber with Poisson's ratio 0.463 and the strain energy by
/// reference volume G / 2 [I - 3 + (J^-2b - 1) / b], b = nu / (1 - 2 nu); Cauchy stress
/// G (F F^T / J - J^(-1 / (1 - 2 nu)) 1). Sources: Blatz & Ko (1962); Hallquist (2006), LS-DYNA theory
/// manual, material model 7.
struct BlatzKo {
    double density = 0;       ///< [mass/volume]
    double shear_modulus = 0; ///< G [stress]
    double poisson_ratio = 0.463;

    static BlatzKo from_record(const Record& record, const Model& model);

    /// Strain energy by reference volume [stress].
    template <class Lane>
    Lane energy(const Tensor3<Lane>& deformation) const
    {
        const LeftCauchyGreen<Lane> i = left_cauchy_green(deformation);
        const double b = poisson_ratio / (1 - 2 * poisson_ratio);
        return 0.5 * shear_modulus * (i.first - 3.0 + (1 / b) * (power(i.third, -b) - 1.0));
    }

    /// Cauchy stress of a deformation gradient [stress].
    template <class Lane>
    SymmetricTensor<Lane> stress(const Tensor3<Lane>& deformation) const
    {
        const LeftCauchyGreen<Lane> i = left_cauchy_green(deformation);
        const Lane factor = shear_modulus / sqrt(i.third);
        const Lane pressure = shear_modulus * power(i.third, -0.5 / (1 - 2 * poisson_ratio));
        const SymmetricTensor<Lane> s = factor * i.left;
        return {s.xx - pressure, s.yy - pressure, s.zz - pressure, s.xy, s.yz, s.zx};
    }

    /// Density times the square of the speed of the fastest compression wave along a principal direction,
    /// lambda^2 / J d2W/dlambda^2 [stress].
    template <class Lane>
    Lane wave_modulus(const Tensor3<Lane>& deformation) const
    {
        const LeftCauchyGreen<Lane> i = left_cauchy_green(deformation);
        const double b = poisson_ratio / (1 - 2 * poisson_ratio);
        return shear_modulus * (i.largest_square() + (1 + 2 * b) * power(i.third, -b)) / sqrt(i.third);
    }
};

} // namespace plash
