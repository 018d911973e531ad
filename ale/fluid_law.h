#pragma once

#include "eos/gruneisen.h"
#include "eos/linear_polynomial.h"
#include "eos/murnaghan.h"

#include <variant>

namespace plash {

using CellLaw = std::variant<Gruneisen, LinearPolynomial, Murnaghan>;

/// A group of *ALE_MULTI-MATERIAL_GROUP as the Eulerian fluid sees it.
struct FluidGroup {
    CellLaw law;
    double reference_density; ///< [density]
    double tension_limit = 0; ///< lowest pressure before the liquid tears and leaves void, <= 0 [pressure]
    double viscosity = 0;     ///< dynamic [pressure time]
};

/// Answer of an equation of state at a batch of points.
template <class Lane>
struct FluidState {
    Lane pressure;  ///< [pressure]
    Lane stiffness; ///< density times the square of the speed of sound, > 0 [pressure]
};

/// density [density], energy per mass [energy/mass]
template <class Lane>
inline FluidState<Lane> fluid_state(const FluidGroup& group, Lane density, Lane energy)
{
    const Lane compression = (1 / group.reference_density) * density;
    const Lane by_volume = group.reference_density * energy;
    return std::visit(
        [&](const auto& law) -> FluidState<Lane> {
            const auto response = law.evaluate(compression);
            const Lane pressure = response.pressure(by_volume);
            const Lane stiffness = compression * response.stiffness(compression, pressure, by_volume);
            return {pressure, max(stiffness, broadcast<Lane>(1e-300))};
        },
        group.law);
}

} // namespace plash
