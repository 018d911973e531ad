#include "model/measures.h"

#include <cmath>

namespace plash {

double solid_volume(const std::array<Index, 8>& nodes, const std::vector<Vec3>& position)
{
    const auto p = [&](int corner) { return position[nodes[corner]]; };
    if (nodes[4] == nodes[3] && nodes[5] == nodes[3]) { // tetrahedron as 1 2 3 4 4 4 4 4
        return std::abs(dot(p(1) - p(0), cross(p(2) - p(0), p(3) - p(0)))) / 6;
    }
    const Vec3 a = (p(6) - p(1)) + (p(7) - p(0)), b = (p(6) - p(3)) + (p(5) - p(0));
    const Vec3 c = (p(6) - p(4)) + (p(2) - p(0));
    return std::abs(dot(a, cross(p(6) - p(3), p(2) - p(0))) + dot(p(7) - p(0), cross(b, p(6) - p(4))) +
                    dot(p(6) - p(1), cross(p(5) - p(0), c))) /
           12;
}

double segment_area(const std::array<Index, 4>& nodes, const std::vector<Vec3>& position)
{
    const Vec3 first = position[nodes[2]] - position[nodes[0]];
    const Vec3 second = nodes[3] == nodes[2] ? position[nodes[1]] - position[nodes[0]]
                                             : position[nodes[3]] - position[nodes[1]];
    return 0.5 * norm(cross(first, second));
}

} // namespace plash
