#pragma once

#include "math/lanes.h"
#include "math/vector3.h"
#include "model/record.h"

namespace plash {

/// Four doubles in one register: a force and the stiffness that goes with it.
using Four = double __attribute__((vector_size(32)));

/// Points number[0] .. number[7] of a list, a lane each. Pairs of points as rows and a transposition:
/// gathering by component costs three times as much.
inline Vector3<Lanes> points_in_lanes(const Vec3* point, const Index* number)
{
    const auto row = [&](int lane) {
#if defined(__AVX512VL__)
        return Four(_mm256_maskz_loadu_pd(7, &point[number[lane]].x)); // nothing behind the last is read
#else
        const Vec3& p = point[number[lane]];
        return Four{p.x, p.y, p.z, 0};
#endif
    };
    const auto rows = [&](int lane) {
        return __builtin_shufflevector(row(lane), row(lane + 4), 0, 1, 2, 3, 4, 5, 6, 7);
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

/// The four values of each lane side by side.
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
