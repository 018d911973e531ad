#pragma once

#include "math/aligned.h"
#include "math/lanes.h"
#include "math/vector3.h"

#include <cstdint>

/// Loading and adding 3-vectors of eight corners at once from arrays with four doubles a node.
namespace plash {

/// A node's entry: x, y, z and padding.
using FourDoubles [[gnu::may_alias]] = double __attribute__((vector_size(32)));

/// The vectors that stand at values[offset[lane]] ... values[offset[lane] + 2].
template <class Lane>
inline Vector3<Lane> load_corner(const double* values, const std::uint16_t* offset)
{
    Vector3<Lane> result;
    for (int lane = 0; lane < lanes_in<Lane>; ++lane) {
        const double* node = values + offset[lane];
        set_lane(result.x, lane, node[0]);
        set_lane(result.y, lane, node[1]);
        set_lane(result.z, lane, node[2]);
    }
    return result;
}

/// Adds a vector of each of the first `active` lanes to values[offset[lane]] ... in lane order.
template <class Lane>
inline void add_corner(double* values, const std::uint16_t* offset, const Vector3<Lane>& vector, int active)
{
    for (int lane = 0; lane < active; ++lane) {
        double* node = values + offset[lane];
        node[0] += lane_of(vector.x, lane);
        node[1] += lane_of(vector.y, lane);
        node[2] += lane_of(vector.z, lane);
    }
}

template <>
inline Vector3<Lanes> load_corner<Lanes>(const double* values, const std::uint16_t* offset)
{
    // Row r holds lanes r and r + 4 as (x y z -), so that every shuffle stays a cheap one.
    const auto row = [&](int lane) {
        const auto low = *reinterpret_cast<const FourDoubles*>(values + offset[lane]);
        const auto high = *reinterpret_cast<const FourDoubles*>(values + offset[lane + 4]);
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const Lanes row0 = row(0), row1 = row(1), row2 = row(2), row3 = row(3);
    const Lanes xz01 = __builtin_shufflevector(row0, row1, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes y01 = __builtin_shufflevector(row0, row1, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes xz23 = __builtin_shufflevector(row2, row3, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes y23 = __builtin_shufflevector(row2, row3, 1, 9, 3, 11, 5, 13, 7, 15);
    return {__builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(y01, y23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15)};
}

template <>
inline void add_corner<Lanes>(double* values, const std::uint16_t* offset, const Vector3<Lanes>& vector,
                              int active)
{
    const Lanes zero{};
    const Lanes xy_even = __builtin_shufflevector(vector.x, vector.y, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes xy_odd = __builtin_shufflevector(vector.x, vector.y, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes z_even = __builtin_shufflevector(vector.z, zero, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes z_odd = __builtin_shufflevector(vector.z, zero, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes pairs[4] = {
        __builtin_shufflevector(xy_even, z_even, 0, 1, 8, 9, 2, 3, 10, 11),   // lanes 0 and 2
        __builtin_shufflevector(xy_odd, z_odd, 0, 1, 8, 9, 2, 3, 10, 11),     // 1 and 3
        __builtin_shufflevector(xy_even, z_even, 4, 5, 12, 13, 6, 7, 14, 15), // 4 and 6
        __builtin_shufflevector(xy_odd, z_odd, 4, 5, 12, 13, 6, 7, 14, 15),   // 5 and 7
    };
    const auto add = [&](int lane) {
        const Lanes pair = pairs[(lane & 1) + (lane >> 2) * 2];
        const FourDoubles row = (lane & 2) ? __builtin_shufflevector(pair, pair, 4, 5, 6, 7)
                                           : __builtin_shufflevector(pair, pair, 0, 1, 2, 3);
        *reinterpret_cast<FourDoubles*>(values + offset[lane]) += row;
    };
    if (active == lane_count) {
        for (int lane = 0; lane < lane_count; ++lane) add(lane);
    } else {
        for (int lane = 0; lane < active; ++lane) add(lane);
    }
}

} // namespace plash
