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

} // namespace plash
