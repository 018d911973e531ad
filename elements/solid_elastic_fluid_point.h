#pragma once

#include "elements/solid_step.h"
#include "materials/elastic_fluid.h"
#include "math/lanes_math.h"

#include <cmath>

namespace plash {

/// Material point of an acoustic fluid (materials/elastic_fluid.h), whose viscosity needs the length of its
/// element.
struct ElasticFluidPoint {
    ElasticFluid fluid;

    static constexpr int history_size = 0;
    static constexpr int constant_size = 1; ///< length of the element at the start
    static constexpr bool modulus_changes = false;
    static constexpr bool can_fail = false;
    static constexpr int plastic_strain = -1;

    template <class Lane>
    void start(const SolidModes<Lane>& position, Lane*, Lane* constants) const
    {
        constants[point_constants] =
            1.0 / inverse_cube_root(gradient_of<SolidGradientRule::mean>(position).volume);
    }

    /// K / V, raised for the viscosity: a wave of the shortest length is damped by xi = 2/3 VC, and its
    /// stable step is sqrt(1 + xi^2) - xi of the undamped one (Hallquist 2006, 'Time step control').
    template <class Lane>
    Lane wave_modulus(const SolidMotion<Lane>& motion, HistoryView<Lane>) const
    {
        const double damping = 2.0 / 3 * fluid.viscosity;
        const double root = std::sqrt(1 + damping * damping) + damping;
        return (fluid.bulk_modulus * root * root) / motion.relative_volume;
    }

    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, HistoryView<Lane>, const SolidMotion<Lane>& motion) const
    {
        const Lane volume = motion.relative_volume;
        const Lane pressure =
            max(Lane{-fluid.bulk_modulus * log(volume)}, broadcast<Lane>(fluid.lowest_pressure));
        const double impedance = std::sqrt(fluid.bulk_modulus * fluid.density); // a rho0
        const double per_step = motion.time_step > 0 ? fluid.viscosity * impedance / motion.time_step : 0;
        // Length and density now: L0 V^(1/3) and rho0 / V.
        const Lane root = inverse_cube_root(volume);
        const Lane factor = per_step * motion.constants[0] * root * root;
        const SymmetricTensor<Lane> shear = factor * deviator(motion.increment);
        stress = {
            shear.xx - pressure, shear.yy - pressure, shear.zz - pressure, shear.xy, shear.yz, shear.zx};
    }
};

} // namespace plash
