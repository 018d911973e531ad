#include "ale/box_boundary.h"

#include <map>

namespace plash {

OutsideWork push_nodes(FluidFields& fields, std::span<const NodeForceFromOutside> forces, double step,
                       double impulse_step, const std::array<double, 3>& gravity)
{
    OutsideWork work;
    for (const NodeForceFromOutside& outside : forces) {
        const std::ptrdiff_t node = outside.place;
        if (!(fields.node_mass[node] > 0)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            const double gain = outside.force[axis] * impulse_step / fields.node_mass[node];
            fields.velocity[axis][node] += gain;
            fields.mean_velocity[axis][node] += 0.5 * gain;
            work.gravity += fields.node_mass[node] * gravity[axis] * step * 0.5 * gain;
        }
    }
    return work;
}

double work_of_forces(const FluidFields& fields, std::span<const NodeForceFromOutside> forces,
                      double impulse_step)
{
    double work = 0;
    for (const NodeForceFromOutside& outside : forces) {
        for (int axis = 0; axis < 3; ++axis) {
            work += outside.force[axis] * impulse_step * fields.mean_velocity[axis][outside.place];
        }
    }
    return work;
}

OutsideWork apply_outside(FluidFields& fields, std::span<const NodeForceFromOutside> forces,
                          std::span<const HeldNode> held, std::span<const SlipNode> slipping, double step,
                          double impulse_step, const std::array<double, 3>& gravity)
{
    OutsideWork work = push_nodes(fields, forces, step, impulse_step, gravity);
    work.gravity -= slip_along(fields, slipping, step, gravity);
    for (const HeldNode& node : held) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(node.axes & (1u << axis))) continue;
            double& velocity = fields.velocity[axis][node.place];
            double& mean = fields.mean_velocity[axis][node.place];
            const double mass = fields.node_mass[node.place];
            const double held_mean = 0.5 * (node.before[axis] + node.after[axis]);
            const double impulse = mass * (node.after[axis] - velocity);
            work.driving += impulse * held_mean;
            work.gravity += mass * gravity[axis] * step * (held_mean - mean);
            velocity = mass > 0 ? node.after[axis] : 0;
            mean = mass > 0 ? held_mean : 0;
        }
    }
    // Forces work on what the node has in the end become.
    work.forces = work_of_forces(fields, forces, impulse_step);
    return work;
}

void hold_nodes(FluidFields& fields, std::span<const HeldNode> held)
{
    for (const HeldNode& node : held) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(node.axes & (1u << axis))) continue;
            double& velocity = fields.velocity[axis][node.place];
            const double after = node.after[axis];
            if (!fields.lost_motion.empty()) {
                fields.lost_motion[node.place] +=
                    0.5 * fields.node_mass[node.place] * (velocity * velocity - after * after);
            }
            velocity = after;
        }
    }
}

namespace {

/// Calls visit(storage place, side, axis) for each face between an outermost cell (or its edge neighbours,
/// when `rim` is 1) and the ghost beyond; side 0 is the lower one, and the place is that of the ghost.
template <class Visit>
void for_ghosts(const BoxGrid& grid, int rim, Visit&& visit)
{
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        int index[3];
        for (int side = 0; side < 2; ++side) {
            index[axis] = side == 0 ? -1 : grid.cells(axis);
            for (index[b] = -rim; index[b] < grid.cells(b) + rim; ++index[b])
                for (index[a] = -rim; index[a] < grid.cells(a) + rim; ++index[a])
                    visit(grid.at(index[0], index[1], index[2]), side, axis);
        }
    }
}

} // namespace

void press_on_sides(const BoxGrid& grid, FluidFields& fields, double pressure)
{
    for_ghosts(grid, 1, [&](std::ptrdiff_t ghost, int, int) {
        fields.pressure[ghost] = pressure;
        fields.pressure_rate[ghost] = 0;
    });
}

double work_on_sides(const BoxGrid& grid, const FluidFields& fields, const BoxContents& contents,
                     double pressure)
{
    double inward = 0;
    for_ghosts(grid, 0, [&](std::ptrdiff_t ghost, int side, int axis) {
        // The face below a cell carries the cell's place.
        const std::ptrdiff_t face = side == 0 ? ghost + grid.stride(axis) : ghost;
        if (BoxContents::nothing(contents.near_nodes(face))) return;
        inward += side == 0 ? fields.volume_flux[axis][face] : -fields.volume_flux[axis][face];
    });
    return pressure * inward;
}

double motion_through_sides(const BoxGrid& grid, const FluidFields& fields, int axis)
{
    const std::ptrdiff_t a = grid.stride((axis + 1) % 3), b = grid.stride((axis + 2) % 3);
    double outward = 0;
    for_ghosts(grid, 0, [&](std::ptrdiff_t ghost, int side, int across) {
        if (across != axis) return;
        const std::ptrdiff_t face = side == 0 ? ghost + grid.stride(axis) : ghost;
        const double mass = (side == 0 ? -1 : 1) * fields.mass_flux[axis][face];
        if (mass == 0) return;
        double squares = 0;
        for (const std::ptrdiff_t node : {face, face + a, face + b, face + a + b})
            for (const AlignedDoubles& component : fields.velocity)
                squares += component[node] * component[node];
        outward += 0.125 * mass * squares;
    });
    return outward;
}

std::vector<HeldNode> walls_of_box(const BoxGrid& grid, unsigned sides)
{
    std::map<std::ptrdiff_t, unsigned> axes;
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (int side = 0; side < 2; ++side) {
            if (!(sides & (1u << (2 * axis + side)))) continue;
            for (int ib = 0; ib <= grid.cells(b); ++ib) {
                for (int ia = 0; ia <= grid.cells(a); ++ia) {
                    int index[3];
                    index[axis] = side * grid.cells(axis);
                    index[a] = ia;
                    index[b] = ib;
                    axes[grid.at(index[0], index[1], index[2])] |= 1u << axis;
                }
            }
        }
    }
    std::vector<HeldNode> held;
    for (const auto& [place, mask] : axes) held.push_back({place, mask, {}, {}});
    return held;
}

} // namespace plash
