#include "conditions/segment_forces.h"

#include "core/parallel.h"

#include <algorithm>

namespace plash {

std::array<Vec3, 4> unit_pressure_forces(const SegmentNodes& segment, std::span<const Vec3> position)
{
    const Vec3 &p0 = position[segment[0]], &p1 = position[segment[1]], &p2 = position[segment[2]],
               &p3 = position[segment[3]];
    if (segment[2] == segment[3]) {
        const Vec3 third = (1.0 / 6) * cross(p1 - p0, p2 - p0);
        return {third, third, third, Vec3{}};
    }
    const Vec3 a = 0.25 * (p1 + p2 - p0 - p3), b = 0.25 * (p2 + p3 - p0 - p1),
               twist = 0.25 * (p0 + p2 - p1 - p3);
    const Vec3 mean = cross(a, b), along_xi = (1.0 / 3) * cross(a, twist),
               along_eta = (1.0 / 3) * cross(twist, b);
    return {mean - along_xi - along_eta, mean + along_xi - along_eta, mean + along_xi + along_eta,
            mean - along_xi + along_eta};
}

double segment_area(const SegmentNodes& segment, std::span<const Vec3> position)
{
    const Vec3 diagonal = position[segment[2]] - position[segment[0]];
    const Vec3 other = segment[2] == segment[3] ? position[segment[1]] - position[segment[0]]
                                                : position[segment[3]] - position[segment[1]];
    return 0.5 * norm(cross(diagonal, other));
}

CornerSum::CornerSum(std::span<const SegmentNodes> segments) : force(segments.size()), last_(segments.size())
{
    std::vector<std::pair<Index, Index>> corners;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const int count = segments[i][2] == segments[i][3] ? 3 : 4;
        for (int c = 0; c < count; ++c) corners.emplace_back(segments[i][c], static_cast<Index>(4 * i) + c);
    }
    std::sort(corners.begin(), corners.end());
    for (const auto& [node, corner] : corners) {
        if (node_.empty() || node_.back() != node) {
            node_.push_back(node);
            begin_.push_back(static_cast<Index>(corner_.size()));
        }
        corner_.push_back(corner);
    }
    begin_.push_back(static_cast<Index>(corner_.size()));
}

Vec3 CornerSum::sum_at(std::size_t place) const
{
    Vec3 sum{};
    for (Index k = begin_[place]; k < begin_[place + 1]; ++k) sum += force[corner_[k] / 4][corner_[k] % 4];
    return sum;
}

void CornerSum::add_to(std::vector<Vec3>& nodal_force) const
{
    for_chunks(node_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) nodal_force[node_[i]] += sum_at(i);
    });
}

double CornerSum::square_over_mass(const std::vector<double>& mass) const
{
    return sum_chunks(node_.size(), [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3 force_here = sum_at(i);
            if (mass[node_[i]] > 0) sum += dot(force_here, force_here) / mass[node_[i]];
        }
        return sum;
    });
}

} // namespace plash
