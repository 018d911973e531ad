#include "ale/hex/hex_locator.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

Vec3 lowest(const Vec3& a, const Vec3& b)
{
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

Vec3 highest(const Vec3& a, const Vec3& b)
{
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// Calls visit(bin) for the bins from `low` to `high`.
template <class Visit>
void for_bins(const std::array<int, 3>& bins, const std::array<int, 3>& low, const std::array<int, 3>& high,
              Visit&& visit)
{
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i)
                visit(i + std::size_t(bins[0]) * (j + std::size_t(bins[1]) * k));
}

constexpr double tolerance = 1e-9; ///< by which a point may lie beyond a face and still be in a cell

} // namespace

bool find_in_cell(const HexMesh& mesh, Index cell, const Vec3& point, std::array<double, 3>& part)
{
    const HexCorners& corners = mesh.corners[cell];
    const auto& edge = mesh.edge[cell];
    const double size = norm(edge[0]) + norm(edge[1]) + norm(edge[2]);
    part = {0.5, 0.5, 0.5};
    for (int round = 0; round < 20; ++round) {
        Vec3 at{}, slope[3]{};
        for (int corner = 0; corner < 8; ++corner) {
            double factor[3], sign[3];
            for (int axis = 0; axis < 3; ++axis) {
                const bool upper = corner >> axis & 1;
                factor[axis] = upper ? part[axis] : 1 - part[axis];
                sign[axis] = upper ? 1 : -1;
            }
            const Vec3& x = mesh.position[corners[corner]];
            at += (factor[0] * factor[1] * factor[2]) * x;
            slope[0] += (sign[0] * factor[1] * factor[2]) * x;
            slope[1] += (factor[0] * sign[1] * factor[2]) * x;
            slope[2] += (factor[0] * factor[1] * sign[2]) * x;
        }
        const Vec3 miss = point - at;
        const Vec3 across[3] = {cross(slope[1], slope[2]), cross(slope[2], slope[0]),
                                cross(slope[0], slope[1])};
        const double determinant = dot(slope[0], across[0]);
        if (determinant == 0) return false;
        for (int axis = 0; axis < 3; ++axis) part[axis] += dot(miss, across[axis]) / determinant;
        // Far outside the map need not be invertible.
        for (const double value : part)
            if (!(std::abs(value) < 10)) return false;
        if (norm(miss) < 1e-12 * size) break;
    }
    for (double& value : part) {
        if (value < -tolerance || value > 1 + tolerance) return false;
        value = std::clamp(value, 0.0, 1.0);
    }
    return true;
}

HexLocator::HexLocator(const HexMesh& mesh)
{
    low_ = high_ = mesh.position.front();
    for (const Vec3& point : mesh.position) {
        low_ = lowest(low_, point);
        high_ = highest(high_, point);
    }
    const Vec3 reach = high_ - low_;
    // About one cell a bin.
    const double size = std::cbrt(reach.x * reach.y * reach.z / mesh.cells());
    bins_ = {std::clamp(static_cast<int>(reach.x / size), 1, 512),
             std::clamp(static_cast<int>(reach.y / size), 1, 512),
             std::clamp(static_cast<int>(reach.z / size), 1, 512)};
    std::vector<std::pair<std::array<int, 3>, std::array<int, 3>>> range;
    first_.assign(std::size_t(bins_[0]) * bins_[1] * bins_[2] + 1, 0);
    const Vec3 margin = 1e-6 * reach;
    for (const HexCorners& corners : mesh.corners) {
        Vec3 low = mesh.position[corners[0]], high = low;
        for (Index node : corners) {
            low = lowest(low, mesh.position[node]);
            high = highest(high, mesh.position[node]);
        }
        range.emplace_back(bin_of(low - margin), bin_of(high + margin));
        for_bins(bins_, range.back().first, range.back().second, [&](std::size_t bin) { ++first_[bin + 1]; });
    }
    for (std::size_t bin = 0; bin + 1 < first_.size(); ++bin) first_[bin + 1] += first_[bin];
    cells_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t cell = 0; cell < range.size(); ++cell)
        for_bins(bins_, range[cell].first, range[cell].second,
                 [&](std::size_t bin) { cells_[next[bin]++] = static_cast<Index>(cell); });
}

std::array<int, 3> HexLocator::bin_of(const Vec3& point) const
{
    const auto along = [](double value, double low, double high, int bins) {
        return high > low ? std::clamp(static_cast<int>((value - low) / (high - low) * bins), 0, bins - 1)
                          : 0;
    };
    return {along(point.x, low_.x, high_.x, bins_[0]), along(point.y, low_.y, high_.y, bins_[1]),
            along(point.z, low_.z, high_.z, bins_[2])};
}

HexLocator::Found HexLocator::operator()(const HexMesh& mesh, const Vec3& point, Index guess) const
{
    Found found;
    if (point.x < low_.x || point.y < low_.y || point.z < low_.z || point.x > high_.x || point.y > high_.y ||
        point.z > high_.z)
        return found;
    if (guess >= 0 && guess < static_cast<Index>(mesh.cells()) &&
        find_in_cell(mesh, guess, point, found.part)) {
        found.cell = guess;
        return found;
    }
    const std::array<int, 3> at = bin_of(point);
    const std::size_t bin = at[0] + std::size_t(bins_[0]) * (at[1] + std::size_t(bins_[1]) * at[2]);
    for (std::size_t i = first_[bin]; i < first_[bin + 1]; ++i) {
        if (!find_in_cell(mesh, cells_[i], point, found.part)) continue;
        found.cell = cells_[i];
        return found;
    }
    return found;
}

} // namespace plash
