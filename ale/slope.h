#pragma once

#include "math/lanes.h"

namespace plash {

/// Limited difference of a cell average across its cell: the central difference, cut so that the linear
/// profile stays between the neighbours' averages, and zero at an extremum. This is the monotonicity
/// condition of van Leer (1977), J. Comput. Phys. 23, 276-299, with which Benson (1992), Comput. Methods
/// Appl. Mech. Engrg. 99, 235-394, section 3, builds his MUSCL step. before   value minus the value of the
/// cell before after    value of the cell after minus value central  central estimate of the difference
/// across the cell
template <class Lane>
inline Lane limited_difference(Lane before, Lane after, Lane central)
{
    const Lane zero{};
    const Lane twice_before = before + before, twice_after = after + after;
    const Lane rising = min(min(twice_before, twice_after), central);
    const Lane falling = max(max(twice_before, twice_after), central);
    return max(rising, zero) + min(falling, zero);
}

/// Mean, over the part of a cell that leaves it through one face, of a quantity that varies linearly across
/// the cell: value + (1 - part) / 2 * difference, the difference taken towards the face.
template <class Lane>
inline Lane mean_of_outflow(Lane value, Lane difference, Lane part)
{
    return value + 0.5 * (1.0 - part) * difference;
}

/// Weight of the difference over distance `near` in the central difference across a zone of width `zone`,
/// when the other neighbour is `far` away: the parabola through three points.
inline double parabola_weight(double zone, double near, double far)
{
    const double weight = zone * far / (near * (near + far));
    return abs(weight - 0.5) < 1e-12 ? 0.5 : weight;
}

} // namespace plash
