#pragma once

#include "math/aligned.h"
#include "math/lane_rows.h"

#include <cstdint>

/// Loading and adding 3-vectors of eight corners at once from arrays with four doubles a node.
namespace plash {

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
    return lanes_of_fours([&](int lane) { return *reinterpret_cast<const Four*>(values + offset[lane]); });
}

template <>
inline void add_corner<Lanes>(double* values, const std::uint16_t* offset, const Vector3<Lanes>& vector,
                              int active)
{
    Four row[lane_count];
    lanes_to_fours(vector, Lanes{}, row);
    const auto add = [&](int lane) { *reinterpret_cast<Four*>(values + offset[lane]) += row[lane]; };
    if (active == lane_count) {
        for (int lane = 0; lane < lane_count; ++lane) add(lane);
    } else {
        for (int lane = 0; lane < active; ++lane) add(lane);
    }
}

} // namespace plash
