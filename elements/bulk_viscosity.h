#pragma once

#include "math/lanes.h"

namespace plash {

/// Artificial bulk viscosity of solids (von Neumann & Richtmyer 1950, Landshoff 1955; LS-DYNA's TYPE 1).
struct BulkViscosity {
    double quadratic = 1.5; ///< Q1
    double linear = 0.06;   ///< Q2

    /// Pressure q [stress], zero in expansion.
    /// density      current [mass/volume]
    /// length       cube root of the volume [length]
    /// sound_speed  [velocity]
    /// rate         trace of the strain rate [1/time]
    template <class Lane>
    Lane pressure(const Lane& density, const Lane& length, const Lane& sound_speed, const Lane& rate) const
    {
        const Lane squeeze = min(rate, Lane{});
        return density * length * squeeze * (quadratic * length * squeeze - linear * sound_speed);
    }

    /// Stable step of an element: crossing / (Q + sqrt(Q^2 + c^2)) (Hallquist 2006, 'Time step calculations
    /// for solid elements'). There Q has the crossing for its length; here it has the length that `pressure`
    /// really works with, since flat elements, where the two differ, blow up otherwise. The same for cubes.
    /// crossing  shortest way of a wave through the element [length]
    /// length    as given to `pressure`
    template <class Lane>
    Lane stable_step(const Lane& crossing, const Lane& length, const Lane& sound_speed,
                     const Lane& rate) const
    {
        const Lane squeeze = min(rate, Lane{});
        const Lane push = linear * sound_speed - quadratic * length * squeeze;
        const Lane q = squeeze < 0.0 ? length * push : Lane{};
        const Lane c = crossing * sound_speed;
        return crossing * crossing / (q + sqrt(q * q + c * c));
    }
};

} // namespace plash
