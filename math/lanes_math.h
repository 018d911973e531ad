#pragma once

#include "math/lanes.h"

#include <numbers>

/// Exponential and logarithm of lanes, written once for eight lanes and for one double, so that both give the
/// same value. Accurate to a few units in the last place over the range of normal numbers.
namespace plash {

/// The integer lane type of a lane type, for bit patterns and table positions.
template <class Lane>
struct IntegerLaneOf {
    using type = std::int64_t;
};
template <>
struct IntegerLaneOf<Lanes> {
    using type = LaneMask;
};
template <class Lane>
using IntegerLane = typename IntegerLaneOf<Lane>::type;

template <class To, class From>
inline To bits_as(const From& from)
{
    static_assert(sizeof(To) == sizeof(From));
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

/// Nearest whole number of |a| < 2^51 as integer.
template <class Lane>
inline IntegerLane<Lane> nearest_integer(Lane a)
{
    // Adding 1.5 * 2^52 leaves the whole number in the lower bits of the mantissa.
    const Lane shifter = broadcast<Lane>(6755399441055744.0);
    return bits_as<IntegerLane<Lane>>(a + shifter) - bits_as<IntegerLane<Lane>>(shifter);
}

/// The whole number `a` (|a| < 2^51) as lanes.
template <class Lane>
inline Lane lanes_of_integer(IntegerLane<Lane> a)
{
    const Lane shifter = broadcast<Lane>(6755399441055744.0);
    return bits_as<Lane>(a + bits_as<IntegerLane<Lane>>(shifter)) - shifter;
}

/// Natural logarithm of positive normal numbers: log(m 2^k) = k log 2 + 2 artanh((m - 1) / (m + 1)) with m
/// between sqrt(1/2) and sqrt(2), the series cut where its next term is below 1e-16.
template <class Lane>
inline Lane log(Lane a)
{
    using Integer = IntegerLane<Lane>;
    const Integer bits = bits_as<Integer>(a);
    const Integer sqrt_half = bits_as<Integer>(broadcast<Lane>(0.70710678118654752));
    const Integer exponent = (bits - sqrt_half) >> 52;
    const Lane mantissa = bits_as<Lane>(bits - (exponent << 52));
    const Lane s = (mantissa - 1.0) / (mantissa + 1.0);
    const Lane square = s * s;
    Lane series = broadcast<Lane>(1.0 / 21);
    for (int odd = 19; odd >= 3; odd -= 2) series = series * square + 1.0 / odd;
    return lanes_of_integer<Lane>(exponent) * std::numbers::ln2 + 2.0 * (s + s * square * series);
}

/// Exponential: 2^k times the Taylor series of the rest, |rest| <= log(2) / 2. It stays at its values for
/// -708 and 709, the last that are normal numbers: beyond them the exponent bits would wrap round.
template <class Lane>
inline Lane exp(Lane any)
{
    using Integer = IntegerLane<Lane>;
    const Lane a = min(max(any, broadcast<Lane>(-708.0)), broadcast<Lane>(709.0));
    const Integer power = nearest_integer<Lane>(a * std::numbers::log2e);
    // log 2 in two parts, so that the rest keeps its digits.
    const Lane rounded = lanes_of_integer<Lane>(power);
    const Lane rest = (a - rounded * 0.693147180369123816490) - rounded * 1.90821492927058770002e-10;
    Lane series = broadcast<Lane>(1.0);
    for (int term = 13; term >= 1; --term) series = series * rest * (1.0 / term) + 1.0;
    return bits_as<Lane>(bits_as<Integer>(series) + (power << 52));
}

/// a^exponent for a >= 0; numbers below 1e-300 count as zero.
template <class Lane>
inline Lane power(Lane a, double exponent)
{
    const Lane result = exp(log(max(a, broadcast<Lane>(1e-300))) * exponent);
    return a > 1e-300 ? result : Lane{};
}

} // namespace plash
