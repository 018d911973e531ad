#pragma once

#include "math/lane_rows.h"
#include "model/record.h"

namespace plash {

/// Points number[0] .. number[7] of a list, a lane each.
inline Vector3<Lanes> points_in_lanes(const Vec3* point, const Index* number)
{
    return lanes_of_fours([&](int lane) {
#if defined(__AVX512VL__)
        return Four(_mm256_maskz_loadu_pd(7, &point[number[lane]].x)); // nothing behind the last is read
#else
        const Vec3& p = point[number[lane]];
        return Four{p.x, p.y, p.z, 0};
#endif
    });
}

} // namespace plash
