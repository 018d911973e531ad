#include "ale/coupling/coupling_points.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

CouplingPoints::Place place_in(std::size_t segment, double s, double t, double share)
{
    CouplingPoints::Place place{segment, {}, {}, {}, share};
    place.weight = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    place.along_s = {-(1 - t), 1 - t, t, -t};
    place.along_t = {-(1 - s), -s, s, 1 - s};
    return place;
}

/// How many points an edge of this length needs, and its opposite.
int points_along(double length, int least, double spacing)
{
    constexpr int most = 64;
    return std::clamp(static_cast<int>(std::ceil(length / spacing)), std::max(least, 1), most);
}

} // namespace

CouplingPoints::CouplingPoints(Surface surface, int per_edge,
                               const std::function<double(const Vec3&, const Vec3&)>& spacing,
                               const std::vector<Vec3>& position)
    : surface_(std::move(surface))
{
    for (std::size_t segment = 0; segment < surface_.segments.size(); ++segment) {
        first_.push_back(places_.size());
        const auto& nodes = surface_.segments[segment].nodes;
        const auto points_on = [&](int a, int b) {
            const Vec3 &from = position[nodes[a]], &to = position[nodes[b]];
            return points_along(norm(to - from), per_edge, spacing(from, to));
        };
        const int along_s = std::max(points_on(0, 1), points_on(2, 3));
        const int along_t = std::max(points_on(1, 2), points_on(3, 0));
        const double share = 1.0 / (along_s * along_t);
        for (int j = 0; j < along_t; ++j)
            for (int i = 0; i < along_s; ++i)
                places_.push_back(place_in(segment, (i + 0.5) / along_s, (j + 0.5) / along_t, share));
    }
    first_.push_back(places_.size());
}

CouplingPoints::Motion CouplingPoints::motion(std::size_t point, const State& state) const
{
    const Place& place = places_[point];
    const auto& corner = nodes(point);
    Motion motion{};
    Vec3 s{}, t{};
    for (int n = 0; n < 4; ++n) {
        const Vec3& position = state.position[corner[n]];
        motion.position += place.weight[n] * position;
        motion.velocity += place.weight[n] * state.velocity[corner[n]];
        s += place.along_s[n] * position;
        t += place.along_t[n] * position;
    }
    motion.area = place.share * cross(s, t);
    return motion;
}

} // namespace plash
