#pragma once

#include "math/vector3.h"
#include "model/record.h"

namespace plash {

/// Where a node is to go before the run begins, from its place in the deck.
struct NodeDisplacement {
    Index node;
    Vec3 translation{}; ///< [length]
    Vec3 rotation{};    ///< about the global axes [radian]
};

} // namespace plash
