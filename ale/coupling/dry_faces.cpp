#include "ale/coupling/dry_faces.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

/// How far the foremost corner of a face stands before the plane of a point [length].
double foremost(const Vec3& origin, const std::array<Vec3, 3>& edges, int face, const DryFaces::Point& point)
{
    double distance = dot(origin - point.position, point.normal);
    for (int axis = 0; axis < 3; ++axis) {
        const double along = dot(edges[axis], point.normal);
        distance += axis == face / 2 ? (face % 2) * along : std::max(along, 0.0);
    }
    return distance;
}

bool is_dry(const Vec3& origin, const std::array<Vec3, 3>& edges, int face,
            const std::vector<const DryFaces::Point*>& near)
{
    const double round_off = 1e-9 * norm(edges[face / 2]);
    const auto behind = [&](const DryFaces::Point* point) {
        return foremost(origin, edges, face, *point) < round_off;
    };
    return std::any_of(near.begin(), near.end(), [&](const DryFaces::Point* point) {
        if (!behind(point)) return false;
        return std::none_of(near.begin(), near.end(), [&](const DryFaces::Point* other) {
            return dot(other->position - point->position, point->normal) < -round_off && !behind(other);
        });
    });
}

} // namespace

double filled_share(const Fluid& fluid, std::ptrdiff_t place, unsigned fluids)
{
    double sum = 0;
    for (std::size_t g = 0; g < fluid.groups.size(); ++g) {
        const AlignedDoubles& fraction = fluid.fields.groups[g].fraction;
        if (fluids >> g & 1) sum += fraction.empty() ? 1 : fraction[place];
    }
    return sum;
}

void DryFaces::add_cell(const Fluid& fluid, const Point& point, unsigned fluids)
{
    const std::ptrdiff_t place = fluid.place_of(point.place);
    if (entry_[place] != none) return;
    const double own = filled_share(fluid, place, fluids);
    if (!(own > 0)) return;
    if (count_ == cells_.size()) cells_.emplace_back();
    Cell& cell = cells_[count_];
    bool any_open = false;
    for (int face = 0; face < 6; ++face) {
        const std::ptrdiff_t beyond = fluid.cell_beyond(point.place, face / 2, face % 2);
        cell.open[face] = beyond >= 0 && filled_share(fluid, beyond, fluids) < 0.5 * own;
        any_open = any_open || cell.open[face];
    }
    if (!any_open) return;
    cell.place = place;
    cell.origin = point.position;
    cell.edges = fluid.edges(point.place);
    cell.near.clear();
    for (int axis = 0; axis < 3; ++axis) cell.origin -= point.place.part[axis] * cell.edges[axis];
    entry_[place] = static_cast<Index>(count_++);
}

void DryFaces::add_to(std::ptrdiff_t place, const Point& point)
{
    if (place < 0 || entry_[place] == none) return;
    Cell& cell = cells_[entry_[place]];
    // Of points in one plane the first stands for all.
    const double round_off = 1e-6 * norm(cell.edges[0]);
    const auto same = [&](const Point* other) {
        return dot(point.normal, other->normal) > 1 - 1e-9 &&
               std::abs(dot(point.position - other->position, other->normal)) < round_off;
    };
    if (std::none_of(cell.near.begin(), cell.near.end(), same)) cell.near.push_back(&point);
}

void DryFaces::find(Fluid& fluid, const std::vector<Point>& points, unsigned fluids)
{
    count_ = 0;
    for (const Point& point : points) add_cell(fluid, point, fluids);
    if (count_ == 0) return;
    for (const Point& point : points) {
        add_to(fluid.place_of(point.place), point);
        for (int face = 0; face < 6; ++face)
            add_to(fluid.cell_beyond(point.place, face / 2, face % 2), point);
    }
    for (std::size_t number = 0; number < count_; ++number) {
        const Cell& cell = cells_[number];
        entry_[cell.place] = none;
        for (int face = 0; face < 6; ++face)
            if (cell.open[face] && is_dry(cell.origin, cell.edges, face, cell.near))
                fluid.dry_faces.push_back({cell.place, face / 2, face % 2, fluids});
    }
}

} // namespace plash
