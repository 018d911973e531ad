#pragma once

#include "math/lanes.h"
#include "math/vector3.h"

/// Points that stand as rows of four doubles (x y z and one more) go into lanes, and back: a transposition in
/// registers, three times as fast as gathering by component.
namespace plash {

/// A row in one register.
using Four [[gnu::may_alias]] = double __attribute__((vector_size(32)));

/// The first three values of eight rows. row(lane)  gives the row of a lane as Four
template <class Row>
inline Vector3<Lanes> lanes_of_fours(Row&& row)
{
    // Lanes l and l + 4 share a register, so that every shuffle stays a cheap one.
    const auto rows = [&](int lane) {
        const Four low = row(lane), high = row(lane + 4);
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const Lanes a = rows(0), b = rows(1), c = rows(2), d = rows(3);
    const Lanes ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14); // x0 x1 z0 z1 x4 x5 z4 z5
    const Lanes cd = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes y_ab = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes y_cd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    return {__builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(y_ab, y_cd, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15)};
}

/// The values of each lane, `w` behind the vector, as rows.
inline void lanes_to_fours(const Vector3<Lanes>& v, const Lanes& w, Four (&four)[lane_count])
{
    const auto put = [&](int lane, const Lanes& xy, const Lanes& zw) {
        const Lanes near = __builtin_shufflevector(xy, zw, 0, 1, 8, 9, 2, 3, 10, 11);
        const Lanes far = __builtin_shufflevector(xy, zw, 4, 5, 12, 13, 6, 7, 14, 15);
        four[lane] = __builtin_shufflevector(near, near, 0, 1, 2, 3);
        four[lane + 2] = __builtin_shufflevector(near, near, 4, 5, 6, 7);
        four[lane + 4] = __builtin_shufflevector(far, far, 0, 1, 2, 3);
        four[lane + 6] = __builtin_shufflevector(far, far, 4, 5, 6, 7);
    };
    put(0, __builtin_shufflevector(v.x, v.y, 0, 8, 2, 10, 4, 12, 6, 14),
        __builtin_shufflevector(v.z, w, 0, 8, 2, 10, 4, 12, 6, 14));
    put(1, __builtin_shufflevector(v.x, v.y, 1, 9, 3, 11, 5, 13, 7, 15),
        __builtin_shufflevector(v.z, w, 1, 9, 3, 11, 5, 13, 7, 15));
}

} // namespace plash
