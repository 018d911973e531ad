#pragma once

#include "math/lanes.h"

namespace plash {

/// What is known on the way back to the yield surface at one value of its parameter.
/// Derivatives by the parameter come multiplied by the von Mises stress, which saves quotients.
template <class Lane>
struct ReturnPoint {
    Lane equivalent;            ///< von Mises stress q [stress]
    Lane equivalent_rate_times; ///< q dq/dparameter, negative
    Lane plastic;               ///< increment of plastic strain [-]
    Lane plastic_rate_times;    ///< q d(plastic)/dparameter
    Lane yield;                 ///< yield stress there [stress]
    Lane yield_rate;            ///< its derivative by the plastic increment [stress]
};

/// Step of Newton's method on equivalent - yield = 0.
template <class Lane>
inline Lane return_step(const ReturnPoint<Lane>& point)
{
    return (point.yield - point.equivalent) * point.equivalent /
           (point.equivalent_rate_times - point.yield_rate * point.plastic_rate_times);
}

/// Parameter at which von Mises stress and yield stress meet, for the lanes in `yielding`; zero elsewhere.
/// at(parameter) gives a ReturnPoint. At parameter zero the von Mises stress lies above the yield stress, and
/// it falls with the parameter, so Newton's method is kept inside the bracket found so far. It converges
/// quadratically: a step that begins within `near` ends at round-off and needs no look back.
/// start  first guess, >= 0
template <class Lane, class At>
inline Lane return_parameter(MaskOf<Lane> yielding, Lane start, At&& at)
{
    constexpr int most_iterations = 60;
    constexpr double near = 1e-7; // of the yield stress
    const Lane unbounded = broadcast<Lane>(1e300);
    Lane low{}, high = unbounded, parameter = yielding ? start : Lane{};
    MaskOf<Lane> open = yielding;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        const ReturnPoint<Lane> point = at(parameter);
        const Lane excess = point.equivalent - point.yield;
        const MaskOf<Lane> above = excess > 0.0;
        low = above ? parameter : low;
        high = above ? high : parameter;
        const Lane newton = parameter + return_step(point);
        const Lane middle = high < unbounded ? 0.5 * (low + high) : 2.0 * parameter + 1e-300;
        const MaskOf<Lane> inside = (newton >= low) & (newton <= high);
        const Lane next = inside ? newton : middle;
        parameter = open ? next : parameter;
        open = open & (MaskOf<Lane>(!inside) | (abs(excess) > near * point.yield));
        if (!any(open)) break;
    }
    return parameter;
}

} // namespace plash
