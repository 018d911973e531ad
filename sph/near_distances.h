#pragma once

#include "math/vector3.h"

#include <functional>
#include <vector>

namespace plash {

/// How near the neighbours of particles are: for each that is asked for, the squares of the distances to all
/// others within a radius that holds at least `count` of them, in no order [length^2]. Nobody is visited
/// where there are not more than `count` particles, or all stand in one place.
///
/// asked  by particle; 0: not asked for
/// take   may reorder the squares
void visit_near(const std::vector<Vec3>& positions, std::vector<char> asked, std::size_t count,
                const std::function<void(std::vector<double>& squares)>& take);

} // namespace plash
