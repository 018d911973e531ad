#include "ale/box_fluid.h"

#include "ale/grid_point.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plash {

BoxFluid::BoxFluid(BoxGrid box, std::vector<FluidGroup> all_groups, LagrangeSettings settings)
    : Fluid(all_groups, settings,
            box_fields(box, static_cast<int>(all_groups.size()),
                       settings.void_allowed || all_groups.size() > 1, settings.viscous)),
      grid(std::move(box)),
      contents(grid, settings.void_allowed || groups.size() > 1),
      scratch_(grid, static_cast<int>(groups.size()))
{}

/// The pressure on the sides into the ghosts, which evaluate_state overwrites in part.
void BoxFluid::press()
{
    press_on_sides(grid, fields, outside_pressure);
    pressed_ = outside_pressure;
}

double BoxFluid::accelerate(double step)
{
    if (outside_pressure != pressed_) press();
    if (cut) cut->before_forces();
    return plash::accelerate(grid, fields, contents, step, gravity);
}

void BoxFluid::deform(double step)
{
    plash::deform(grid, fields, contents, step, lagrange.mesh_velocity);
    if (cut) book_cut_work(cut->deform(step));
}

double BoxFluid::work_on_sides(double) const
{
    return plash::work_on_sides(grid, fields, contents, outside_pressure);
}

double BoxFluid::sweep()
{
    double left = 0;
    for (int position = 0; position < 3; ++position) {
        const int axis = swept_direction(steps_done(), position, 3);
        find_outflow_shares(grid, fields, contents, axis);
        for (const DryFace& face : dry_faces)
            if (face.axis == axis) close(face);
        if (cut) cut->share_outflow(axis);
        sweep_cells(grid, fields, contents, scratch_, axis, order);
        if (open_sides) left += motion_through_sides(grid, fields, axis);
        sweep_momentum(grid, fields, contents, scratch_, axis, order, smooth_square);
        contents.update(grid, fields);
    }
    return left;
}

double BoxFluid::return_lost_motion()
{
    return plash::return_lost_motion(grid, fields, contents);
}

void BoxFluid::find_node_masses()
{
    plash::find_node_masses(grid, fields, contents);
}

CrossingRate BoxFluid::evaluate(double last_step)
{
    if (cut) cut->keep();
    const CrossingRate limit = evaluate_state(grid, fields, contents, groups, lagrange, last_step);
    if (cut) cut->restore();
    if (outside_pressure != 0 || pressed_ != 0) press();
    return limit;
}

std::ptrdiff_t BoxFluid::number_of(std::ptrdiff_t place) const
{
    const std::ptrdiff_t offset = place - grid.at(0, 0, 0);
    if (offset < 0) return -1;
    const std::ptrdiff_t k = offset / grid.stride(2), j = offset % grid.stride(2) / grid.stride(1),
                         i = offset % grid.stride(2) % grid.stride(1);
    const bool inside = i < grid.cells(0) && j < grid.cells(1) && k < grid.cells(2);
    return inside ? i + grid.cells(0) * (j + grid.cells(1) * k) : -1;
}

double BoxFluid::kinetic_energy() const
{
    return plash::kinetic_energy(grid, fields, contents);
}

double BoxFluid::internal_energy(int group) const
{
    return plash::internal_energy(grid, fields, contents, group);
}

double BoxFluid::total_mass(int group) const
{
    double sum = 0;
    for (int k = 0; k < grid.cells(2); ++k) {
        for (int j = 0; j < grid.cells(1); ++j) {
            for (int i = 0; i < grid.cells(0); ++i) sum += fields.groups[group].mass[grid.at(i, j, k)];
        }
    }
    return sum;
}

std::array<double, 3> BoxFluid::momentum() const
{
    std::array<double, 3> sum{};
    for (int k = 0; k <= grid.cells(2); ++k) {
        for (int j = 0; j <= grid.cells(1); ++j) {
            for (int i = 0; i <= grid.cells(0); ++i) {
                const std::ptrdiff_t place = grid.at(i, j, k);
                for (int axis = 0; axis < 3; ++axis) {
                    sum[axis] += fields.node_mass[place] * fields.velocity[axis][place];
                }
            }
        }
    }
    return sum;
}

std::size_t BoxFluid::node_count() const
{
    return std::size_t(grid.cells(0) + 1) * (grid.cells(1) + 1) * (grid.cells(2) + 1);
}

FluidCell BoxFluid::cell(std::size_t number) const
{
    const int nx = grid.cells(0), ny = grid.cells(1);
    const int i = static_cast<int>(number % nx), j = static_cast<int>(number / nx % ny),
              k = static_cast<int>(number / nx / ny);
    FluidCell cell;
    cell.place = grid.at(i, j, k);
    cell.volume = grid.volume(i, j, k);
    for (int corner = 0; corner < 8; ++corner) {
        const int a = i + (corner & 1), b = j + (corner >> 1 & 1), c = k + (corner >> 2);
        cell.corners[corner] = grid.at(a, b, c);
        cell.points[corner] = {grid.planes(0)[a], grid.planes(1)[b], grid.planes(2)[c]};
    }
    return cell;
}

double BoxFluid::volume_of(std::ptrdiff_t place) const
{
    const std::ptrdiff_t number = number_of(place);
    const int nx = grid.cells(0), ny = grid.cells(1);
    return grid.volume(static_cast<int>(number % nx), static_cast<int>(number / nx % ny),
                       static_cast<int>(number / nx / ny));
}

std::ptrdiff_t BoxFluid::node_place(std::size_t number) const
{
    const int nx = grid.cells(0) + 1, ny = grid.cells(1) + 1;
    return grid.at(static_cast<int>(number % nx), static_cast<int>(number / nx % ny),
                   static_cast<int>(number / nx / ny));
}

std::vector<OuterNode> BoxFluid::outer_nodes() const
{
    std::vector<OuterNode> nodes;
    const std::size_t nx = grid.cells(0) + 1, ny = grid.cells(1) + 1;
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        int index[3];
        for (int side = 0; side < 2; ++side) {
            index[axis] = side * grid.cells(axis);
            for (index[b] = 0; index[b] <= grid.cells(b); ++index[b])
                for (index[a] = 0; index[a] <= grid.cells(a); ++index[a])
                    nodes.push_back({index[0] + nx * (index[1] + ny * index[2]), axis});
        }
    }
    return nodes;
}

void BoxFluid::shift(const std::array<double, 3>& distance)
{
    for (int axis = 0; axis < 3; ++axis)
        if (distance[axis] != 0) grid.shift(axis, distance[axis]);
}

void BoxFluid::move_nodes(std::vector<Vec3>, double)
{
    throw std::logic_error("a box of cells does not deform; its mesh should have been one of hexahedra");
}

MeshPoint BoxFluid::locate(const Vec3& point, const std::array<int, 3>& guess) const
{
    return plash::locate(grid, point, guess);
}

std::ptrdiff_t BoxFluid::place_of(const MeshPoint& point) const
{
    return grid.at(point.cell[0], point.cell[1], point.cell[2]);
}

std::ptrdiff_t BoxFluid::cell_beyond(const MeshPoint& point, int axis, int side) const
{
    const int next = point.cell[axis] + (side == 0 ? -1 : 1);
    if (next < 0 || next >= grid.cells(axis)) return -1;
    return place_of(point) + (side == 0 ? -1 : 1) * grid.stride(axis);
}

PlaceWeights BoxFluid::node_weights(const MeshPoint& point) const
{
    return plash::node_weights(grid, point);
}

PlaceWeights BoxFluid::cell_weights(const MeshPoint& point) const
{
    return plash::cell_weights(grid, point);
}

std::array<Vec3, 3> BoxFluid::edges(const MeshPoint& point) const
{
    return {Vec3{grid.width(0, point.cell[0]), 0, 0}, Vec3{0, grid.width(1, point.cell[1]), 0},
            Vec3{0, 0, grid.width(2, point.cell[2])}};
}

bool BoxFluid::dry_around(const Vec3& low, const Vec3& high, const std::array<int, 3>& guess,
                          unsigned fluids) const
{
    const double from[3] = {low.x, low.y, low.z}, to[3] = {high.x, high.y, high.z};
    int first[3], last[3];
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double>& planes = grid.planes(axis);
        first[axis] = interval_of(planes, from[axis], guess[axis]);
        last[axis] = interval_of(planes, to[axis], guess[axis]);
        double widest = 0;
        for (int cell = first[axis]; cell <= last[axis]; ++cell)
            widest = std::max(widest, grid.width(axis, cell));
        square += widest * widest;
    }
    const double reach = 0.5 * std::sqrt(square); // half a diagonal of the largest cell
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double>& planes = grid.planes(axis);
        while (first[axis] > 0 && planes[first[axis]] > from[axis] - reach) --first[axis];
        while (last[axis] < grid.cells(axis) - 1 && planes[last[axis] + 1] < to[axis] + reach) ++last[axis];
    }
    for (int k = first[2]; k <= last[2]; ++k)
        for (int j = first[1]; j <= last[1]; ++j)
            for (int i = first[0] / lane_count * lane_count; i <= last[0]; i += lane_count)
                if (!BoxContents::nothing(contents.near_cells(grid.at(i, j, k)) & fluids)) return false;
    return true;
}

double BoxFluid::point_spacing(const Vec3&, const Vec3&) const
{
    return 0.5 * std::min({grid.smallest_width(0), grid.smallest_width(1), grid.smallest_width(2)});
}

void BoxFluid::serialise(Archive& archive)
{
    Fluid::serialise(archive);
    std::array<std::vector<double>, 3> planes{grid.planes(0), grid.planes(1), grid.planes(2)};
    archive(contents, planes);
    if (archive.loading()) grid.set_planes(std::move(planes));
}

} // namespace plash
