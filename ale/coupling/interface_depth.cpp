#include "ale/coupling/interface_depth.h"

#include "ale/plane_in_cell.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace plash {

double length_along(const std::array<Vec3, 3>& edges, const Vec3& direction)
{
    return std::abs(dot(direction, edges[0])) + std::abs(dot(direction, edges[1])) +
           std::abs(dot(direction, edges[2]));
}

double share_before_plane(const std::array<Vec3, 3>& edges, const std::array<double, 3>& part,
                          const Vec3& normal)
{
    double along[3], slope[3], sum = 0, distance = 0;
    for (int axis = 0; axis < 3; ++axis) {
        along[axis] = dot(normal, edges[axis]);
        sum += slope[axis] = std::abs(along[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        slope[axis] /= sum;
        distance += slope[axis] * (along[axis] > 0 ? part[axis] : 1 - part[axis]);
    }
    return 1 - volume_below_plane(Vec3{slope[0], slope[1], slope[2]}, distance);
}

namespace {

using Point = DryFaces::Point;

/// Of the angle between the normal and the row: 53 degrees, for 45 and what round-off and bending add.
constexpr double least_cosine = 0.6;

/// Share of the cell before that of a point which the fluid must fill.
constexpr double least_full = 0.99;

/// The axis of the mesh that a surface lies across at a point, and how much of the normal is along it [-].
struct RowAxis {
    int axis = 0;
    double cosine = 0; ///< negative: against it
};
RowAxis row_axis(const std::array<Vec3, 3>& edges, const Vec3& normal)
{
    RowAxis row;
    for (int axis = 0; axis < 3; ++axis) {
        const double cosine = dot(normal, edges[axis]) / norm(edges[axis]);
        if (std::abs(cosine) > std::abs(row.cosine)) row = {axis, cosine};
    }
    return row;
}

bool tells(const RowAxis& row)
{
    return std::abs(row.cosine) >= least_cosine;
}

/// Whether the cell before that of a point is full.
bool full_before(const Fluid& fluid, const Point& point, const RowAxis& row, unsigned fluids)
{
    const std::ptrdiff_t before = fluid.cell_beyond(point.place, row.axis, row.cosine > 0 ? 1 : 0);
    return before >= 0 && filled_share(fluid, before, fluids) >= least_full;
}

/// How far the other point stands before the plane of a point [length].
double before_plane(const Point& point, const Vec3& other)
{
    return dot(other - point.position, point.normal);
}

/// Share of a cell that lies before a surface of one plane, or of several that each lie across an axis of
/// their own; negative where it is another one, or where planes bound neither an outer nor an inner corner.
double share_before(const Fluid& fluid, const Point* const* planes, int count)
{
    const std::array<Vec3, 3> edges = fluid.edges(planes[0]->place);
    if (count == 1) return share_before_plane(edges, planes[0]->place.part, planes[0]->normal);
    int outer = 0, inner = 0;
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b)
            if (a != b) ++(before_plane(*planes[a], planes[b]->position) < 0 ? outer : inner);
    if (outer > 0 && inner > 0) return -1;
    double product = 1; // of what lies behind each plane (before any), or before each (before all)
    unsigned axes = 0;  // across which they lie, where each lies across one of its own
    for (int a = 0; a < count; ++a) {
        const RowAxis row = row_axis(edges, planes[a]->normal);
        if (tells(row)) axes |= 1u << row.axis;
        const double share = share_before_plane(edges, planes[a]->place.part, planes[a]->normal);
        product *= outer > 0 ? 1 - share : share;
    }
    if (std::popcount(axes) != count) return -1;
    return outer > 0 ? 1 - product : product;
}

} // namespace

void InterfaceDepth::need(std::ptrdiff_t place)
{
    if (place < 0 || entry_[place] != none) return;
    entry_[place] = static_cast<Index>(cells_.size());
    places_.push_back(place);
    cells_.emplace_back();
}

void InterfaceDepth::collect(const Fluid& fluid, const std::vector<Point>& points,
                             const std::vector<Index>& asking, unsigned fluids)
{
    for (const std::ptrdiff_t place : places_) entry_[place] = none;
    places_.clear();
    cells_.clear();
    for (const Index number : asking) {
        const Point& point = points[number];
        need(fluid.place_of(point.place));
        const RowAxis row = row_axis(fluid.edges(point.place), point.normal);
        if (!tells(row) || !full_before(fluid, point, row, fluids)) continue;
        need(fluid.cell_beyond(point.place, row.axis, row.cosine > 0 ? 0 : 1));
    }
    if (cells_.empty()) return;
    for (const Index number : asking) {
        const Point& point = points[number];
        const Index entry = entry_[fluid.place_of(point.place)];
        if (entry == none) continue;
        Cell& cell = cells_[entry];
        if (cell.count > most_planes || plane_of(cell, point.normal) >= 0) continue;
        if (cell.count < most_planes) cell.planes[cell.count] = &point;
        ++cell.count;
    }
    for (Cell& cell : cells_) {
        if (cell.count == 0) continue;
        cell.before = cell.count > most_planes ? -1 : share_before(fluid, cell.planes.data(), cell.count);
    }
}

/// A surface that is bent a little is one plane. Negative: another one.
int InterfaceDepth::plane_of(const Cell& cell, const Vec3& normal)
{
    for (int plane = 0; plane < std::min(cell.count, most_planes); ++plane)
        if (dot(cell.planes[plane]->normal, normal) > 0.9) return plane;
    return -1;
}

void InterfaceDepth::count(const Fluid& fluid, const Point& point, const Spring& spring)
{
    const Index entry = entry_[fluid.place_of(point.place)];
    if (entry == none) return;
    Cell& cell = cells_[entry];
    const int plane = plane_of(cell, point.normal);
    if (plane < 0) return;
    cell.area[plane] += spring.area;
    cell.stiffness[plane] += spring.stiffness;
    cell.pressing[plane] += spring.stiffness * (spring.depth - spring.at_rest);
    cell.swept += spring.area * spring.depth;
}

std::optional<double> InterfaceDepth::even_depth(const Fluid& fluid, const Point& point) const
{
    const Cell* cell = cell_at(fluid.place_of(point.place));
    const int plane = cell ? plane_of(*cell, point.normal) : -1;
    if (plane < 0 || !(cell->stiffness[plane] > 0)) return {};
    return cell->pressing[plane] / cell->stiffness[plane];
}

std::optional<double> InterfaceDepth::mean_depth(std::ptrdiff_t place) const
{
    const Cell* cell = cell_at(place);
    if (!cell || cell->count != 1 || !(cell->area[0] > 0)) return {};
    return cell->swept / cell->area[0];
}

std::optional<double> InterfaceDepth::unknown(const Fluid& fluid, const Point& point, unsigned fluids) const
{
    const std::optional<double> own = behind(fluid, point, fluids);
    if (!own) return {};
    const Cell& cell = *cell_at(fluid.place_of(point.place));
    const double all = std::accumulate(cell.area.begin(), cell.area.end(), 0.0);
    const int plane = plane_of(cell, point.normal);
    if (plane < 0 || !(all > 0)) return {};
    return (cell.area[plane] * *own - cell.swept) / all;
}

/// At a point, as the volumes say, negative where the fluid has not come up to the surface [length].
std::optional<double> InterfaceDepth::behind(const Fluid& fluid, const Point& point, unsigned fluids) const
{
    if (cells_.empty()) return {};
    const std::array<Vec3, 3> edges = fluid.edges(point.place);
    const RowAxis row = row_axis(edges, point.normal);
    if (!tells(row)) return {};
    const int axis = row.axis;
    double along[3];
    for (int a = 0; a < 3; ++a) along[a] = dot(point.normal, edges[a]);
    const int ahead = along[axis] > 0 ? 1 : 0;
    const std::ptrdiff_t place = fluid.place_of(point.place);
    const std::ptrdiff_t before = fluid.cell_beyond(point.place, axis, ahead);
    const std::ptrdiff_t beyond = fluid.cell_beyond(point.place, axis, 1 - ahead);
    if (before < 0) return {};
    // What dry faces keep back in the cell before stands behind other planes.
    const double full = std::min(filled_share(fluid, before, fluids), 1.0);
    if (full < least_full) return {};
    const Cell& own = *cell_at(place);
    const Cell* last = cell_at(beyond);
    if (last && last->count == 0) last = nullptr; // no plane passes there
    if (own.before < 0 || (last && last->before < 0)) return {};
    const double in_last = beyond < 0 ? 0 : filled_share(fluid, beyond, fluids);
    const double wanted_in_last = last ? last->before : 0;
    if (in_last - wanted_in_last > 0.1) return {}; // fluid stands there for other reasons
    double wanted = own.before + wanted_in_last;
    const bool one_plane =
        own.count == 1 && (!last || (last->count == 1 && dot(last->planes[0]->normal, point.normal) > 0.9));
    if (one_plane) {
        // One plane may pass any of the three cells: where it crosses the middle of the row.
        double part = point.place.part[axis];
        for (int a = 0; a < 3; ++a)
            if (a != axis) part -= along[a] * (0.5 - point.place.part[a]) / along[axis];
        wanted = ahead == 1 ? 1 - part : part;
    }
    const double held = full - 1 + filled_share(fluid, place, fluids) + in_last;
    return (held - wanted) * std::abs(along[axis]);
}

} // namespace plash
