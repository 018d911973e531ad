#pragma once

#include "math/lane_lines.h"

#include <cstddef>
#include <type_traits>

/// Two batches at once. Where one batch is a long chain of operations that wait for each other, the processor
/// has nothing to do meanwhile; a loop that takes two batches side by side gives it the other chain. The
/// texts of passes are the same for one and two.
namespace plash {

/// Sixteen values: those of two batches. Arithmetic is that of Lanes, twice.
struct LanePair {
    Lanes first, second;
};

inline LanePair operator-(LanePair a)
{
    return {-a.first, -a.second};
}
inline LanePair operator+(LanePair a, LanePair b)
{
    return {a.first + b.first, a.second + b.second};
}
inline LanePair operator-(LanePair a, LanePair b)
{
    return {a.first - b.first, a.second - b.second};
}
inline LanePair operator*(LanePair a, LanePair b)
{
    return {a.first * b.first, a.second * b.second};
}
inline LanePair operator+(LanePair a, double b)
{
    return {a.first + b, a.second + b};
}
inline LanePair operator+(double a, LanePair b)
{
    return {a + b.first, a + b.second};
}
inline LanePair operator-(double a, LanePair b)
{
    return {a - b.first, a - b.second};
}
inline LanePair operator*(double a, LanePair b)
{
    return {a * b.first, a * b.second};
}
inline LanePair min(LanePair a, LanePair b)
{
    return {min(a.first, b.first), min(a.second, b.second)};
}
inline LanePair max(LanePair a, LanePair b)
{
    return {max(a.first, b.first), max(a.second, b.second)};
}
inline LanePair reciprocal(LanePair a)
{
    return {reciprocal(a.first), reciprocal(a.second)};
}
inline LanePair reciprocal_root(LanePair a)
{
    return {reciprocal_root(a.first), reciprocal_root(a.second)};
}

/// The same value for all of a wider type: of a particle whose neighbours come in two batches.
template <class Wide, class Lane>
inline Wide widened(Lane a)
{
    if constexpr (std::is_same_v<Wide, Lane>) {
        return a;
    } else {
        return {a, a};
    }
}

/// What both batches add up to in each lane.
template <class Lane>
inline Lane in_one_batch(Lane a)
{
    return a;
}
inline Lanes in_one_batch(LanePair a)
{
    return a.first + a.second;
}

/// load(first value of the batch, batch) for both batches.
template <std::size_t count, class Load>
inline void load_both(LanePair (&value)[count], Load&& load)
{
    Lanes first[count], second[count];
    load(0, first);
    load(lane_count, second);
    for (std::size_t k = 0; k < count; ++k) value[k] = {first[k], second[k]};
}

template <class Place>
inline void load_lines(const double* records, const Place* place, LanePair (&value)[8])
{
    load_both(value, [&](int from, Lanes(&batch)[8]) { load_lines(records, place + from, batch); });
}

template <class Place>
inline void load_half_lines(const double* records, const Place* place, LanePair (&value)[4])
{
    load_both(value, [&](int from, Lanes(&batch)[4]) { load_half_lines(records, place + from, batch); });
}

template <class Place>
inline void subtract_from_lines(double* records, const Place* place, const LanePair (&value)[8])
{
    Lanes first[8], second[8];
    for (int k = 0; k < 8; ++k) {
        first[k] = value[k].first;
        second[k] = value[k].second;
    }
    subtract_from_lines(records, place, first);
    subtract_from_lines(records, place + lane_count, second);
}

template <class Place>
inline void add_to_places(double* values, const Place* place, LanePair a)
{
    add_to_places(values, place, a.first);
    add_to_places(values, place + lane_count, a.second);
}

} // namespace plash
