#pragma once

#include "ale/slope.h"

/// What passes a face between two cells in one sweep, as inline functions over the lane type.
namespace plash {

/// Four values in a line across a face: of the second and the first cell below it, and of the first and
/// second above.
template <class Lane>
struct Line {
    Lane far_below, below, above, far_above;
};

/// Weights of the central difference in the cells below and above a face (BoxGrid::cell_weights).
template <class Lane>
struct LineWeights {
    Lane below_lower, below_upper, above_lower, above_upper;
};

/// Value that the flow carries through the face: the mean of what leaves the donor.
/// upward  the flow goes from below to above
/// part    share of the donor that leaves it
template <bool second_order, class Lane, class Mask>
inline Lane carried_value(const Line<Lane>& line, Mask upward, Lane part, const LineWeights<Lane>& weights)
{
    const Lane donor = upward ? line.below : line.above;
    if constexpr (!second_order) return donor;
    const Lane receiver = upward ? line.above : line.below;
    const Lane upstream = upward ? line.far_below : line.far_above;
    const Lane weight_before = upward ? weights.below_lower : weights.above_upper;
    const Lane weight_after = upward ? weights.below_upper : weights.above_lower;
    const Lane before = donor - upstream, after = receiver - donor;
    const Lane central = weight_before * before + weight_after * after;
    return mean_of_outflow(donor, limited_difference(before, after, central), part);
}

/// Nodes without mass repeat the donor: what they hold is no velocity.
template <class Lane, class Mask>
inline void repeat_donor(Line<Lane>& velocity, const Line<Lane>& mass, Mask upward)
{
    const Lane donor = upward ? velocity.below : velocity.above;
    velocity.far_below = mass.far_below > 0.0 ? velocity.far_below : donor;
    velocity.below = mass.below > 0.0 ? velocity.below : donor;
    velocity.above = mass.above > 0.0 ? velocity.above : donor;
    velocity.far_above = mass.far_above > 0.0 ? velocity.far_above : donor;
}

/// Velocities that the flow carries along an edge between two nodes, by axis. The limiter of van Leer takes
/// what lies in a layer of two or three nodes for a jump and flattens it: a viscous one most of all. Where
/// the differences d to both sides of the donor are small against a speed e, as those of no shock are, the
/// slope is the central one (Fromm 1968, J. Comput. Phys. 3, 176-189) by the share e^2 / (e^2 + d^2), and
/// limited by the rest.
/// smooth_square  e^2 [velocity^2]; 0: limited everywhere
template <bool second_order, class Lane, class Mask>
inline void carried_velocities(const Line<Lane> (&line)[3], Mask upward, Lane part,
                               const LineWeights<Lane>& weights, double smooth_square, Lane (&carried)[3])
{
    if (!second_order || smooth_square == 0) {
        for (int axis = 0; axis < 3; ++axis) {
            carried[axis] = carried_value<second_order>(line[axis], upward, part, weights);
        }
        return;
    }
    const Lane weight_before = upward ? weights.below_lower : weights.above_upper;
    const Lane weight_after = upward ? weights.below_upper : weights.above_lower;
    Lane limited[3], central[3], jumps = broadcast<Lane>(smooth_square);
    for (int axis = 0; axis < 3; ++axis) {
        const Line<Lane>& v = line[axis];
        carried[axis] = upward ? v.below : v.above;
        const Lane before = carried[axis] - (upward ? v.far_below : v.far_above);
        const Lane after = (upward ? v.above : v.below) - carried[axis];
        central[axis] = weight_before * before + weight_after * after;
        limited[axis] = limited_difference(before, after, central[axis]);
        jumps += before * before + after * after;
    }
    const Lane smooth = smooth_square / jumps;
    for (int axis = 0; axis < 3; ++axis) {
        const Lane difference = limited[axis] + smooth * (central[axis] - limited[axis]);
        carried[axis] = mean_of_outflow(carried[axis], difference, part);
    }
}

/// What one group has in the four cells of a line.
template <class Lane>
struct GroupLine {
    Line<Lane> density;              ///< [density]
    Line<Lane> energy;               ///< per mass [energy/mass]
    Line<Lane> mass, inverse_mass;   ///< zero where there is none
    Lane volume_below, volume_above; ///< of the group in the cells beside the face [volume]
};

/// The fraction of a full cell that a dry face closes (ale/fluid.h): so little void tells it from one that
/// gives whatever leaves it, and is gone again with the first fluid that comes in.
inline constexpr double marked_full = 1 - 5e-13;

/// Fraction of a group after a sweep, without the round-off of what should be full. Only fluid that a dry
/// face has kept in its cell takes more than the cell's volume.
/// before  the fraction before the sweep
template <class Lane>
inline Lane settled_fraction(Lane before, Lane after)
{
    const auto kept = (before >= marked_full) & (before != 1.0) & (after > 1 + 1e-13);
    return (after > 1 - 1e-13) & !kept ? broadcast<Lane>(1) : after;
}

/// What passes a face of a group, positive upward.
template <class Lane>
struct GroupFlux {
    Lane volume, mass, energy;
};

/// Of cells that are not all full of the group. In a line, cells without the group repeat the donor's value,
/// and donors that hold an interface are taken as uniform.
/// flux      volume of all that passes, positive upward
/// fraction  of the group in the donor
/// cut       the group's share in what leaves the donor where that holds an interface
template <bool second_order, class Lane>
inline GroupFlux<Lane> partial_flux(const GroupLine<Lane>& line, Lane flux, Lane fraction, Lane cut,
                                    const LineWeights<Lane>& weights)
{
    const auto upward = flux > 0.0;
    const auto interface = (fraction > 0.0) & (fraction != 1.0);
    const Lane share = interface ? cut : fraction;
    const Lane available = upward ? line.volume_below : line.volume_above;
    const Lane donor_mass = upward ? line.mass.below : line.mass.above;
    const Lane wanted = abs(flux) * share;
    // What would leave next to nothing behind takes all.
    const auto everything = wanted > available * (1 - 1e-10);
    const Lane out = everything ? available : wanted;
    const Lane sign = upward ? broadcast<Lane>(1) : broadcast<Lane>(-1);
    const Lane part = available > 0.0 ? out / available : Lane{};
    const auto known = [&](const Line<Lane>& values) {
        const Lane donor = upward ? values.below : values.above;
        const auto pick = [&](Lane value, Lane own_mass) {
            return interface ? donor : own_mass > 0.0 ? value : donor;
        };
        return Line<Lane>{pick(values.far_below, line.mass.far_below), pick(values.below, line.mass.below),
                          pick(values.above, line.mass.above), pick(values.far_above, line.mass.far_above)};
    };
    const Lane carried = carried_value<second_order>(known(line.density), upward, part, weights);
    const Lane of_mass = everything ? donor_mass : min(out * carried, donor_mass);
    const Lane mass_part = of_mass * (upward ? line.inverse_mass.below : line.inverse_mass.above);
    const Lane energies = carried_value<second_order>(known(line.energy), upward, mass_part, weights);
    const Lane signed_mass = sign * of_mass;
    return {sign * out, signed_mass, signed_mass * energies};
}

} // namespace plash
