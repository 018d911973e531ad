#pragma once

#include <utility>

namespace plash {

/// The points through the thickness whose mean a result layer shows. As many layers as points: one each, from
/// the bottom; three layers: middle, innermost, outermost (*DATABASE_EXTENT_BINARY MAXINT = 3); otherwise the
/// first points. A layer without a point is empty (first > last).
inline std::pair<int, int> points_of_layer(int layer, int layers, int points)
{
    if (layers == 3 && points != 3) {
        if (layer == 0) return {(points - 1) / 2, points / 2};
        const int point = layer == 1 ? 0 : points - 1;
        return {point, point};
    }
    if (layers == 3) {
        constexpr int order[] = {1, 0, 2};
        return {order[layer], order[layer]};
    }
    return layer < points ? std::pair{layer, layer} : std::pair{0, -1};
}

} // namespace plash
