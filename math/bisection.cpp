#include "math/bisection.h"

#include <algorithm>
#include <utility>

namespace plash {

void bisect(std::span<std::int32_t> order, std::span<const Vec3> center, std::size_t length)
{
    if (order.size() <= length) {
        std::sort(order.begin(), order.end());
        return;
    }
    Vec3 low = center[order[0]], high = low;
    for (std::int32_t item : order) {
        const Vec3& c = center[item];
        low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
        high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
    }
    const Vec3 side = high - low;
    double Vec3::*axis = &Vec3::x;
    if (side.y > side.*axis) axis = &Vec3::y;
    if (side.z > side.*axis) axis = &Vec3::z;
    const std::size_t runs = (order.size() + length - 1) / length;
    const std::size_t half = runs / 2 * length;
    std::nth_element(order.begin(), order.begin() + half, order.end(), [&](std::int32_t a, std::int32_t b) {
        return std::pair(center[a].*axis, a) < std::pair(center[b].*axis, b);
    });
    bisect(order.first(half), center, length);
    bisect(order.subspan(half), center, length);
}

} // namespace plash
