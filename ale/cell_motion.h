#pragma once

#include "ale/box_grid.h"
#include "math/lanes.h"

#include <array>

namespace plash {

/// Mean velocity of the two faces across one axis of each cell of a batch.
template <class Lane>
struct FaceMeans {
    Lane low, high;
};

/// Sum over the four nodes of the lower and of the upper face of a cell along an axis of one velocity
/// component.
template <class Lane>
inline FaceMeans<Lane> face_sums(const double* component, std::ptrdiff_t along, std::ptrdiff_t a,
                                 std::ptrdiff_t b)
{
    const auto sum = [&](const double* corner) {
        return (load<Lane>(corner) + load<Lane>(corner + a)) +
               (load<Lane>(corner + b) + load<Lane>(corner + a + b));
    };
    return {sum(component), sum(component + along)};
}

} // namespace plash
