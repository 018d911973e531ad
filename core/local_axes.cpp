#include "core/local_axes.h"

namespace plash {

std::array<Vec3, 3> axes_at(const CoordinateSystem& system, const State& state)
{
    if (system.nodes[0] == none) return system.axes;
    const Vec3& origin = state.position[system.nodes[0]];
    const Vec3 x = unit(state.position[system.nodes[1]] - origin);
    const Vec3 z = unit(cross(x, state.position[system.nodes[2]] - origin));
    return {x, cross(z, x), z};
}

} // namespace plash
