#include "ale/lagrange.h"

#include "ale/cell_motion.h"
#include "ale/cell_state.h"
#include "ale/sheets.h"

namespace plash {

namespace {

/// The four rows of cells around a row of nodes: which way they lie, and the areas of their faces.
struct CellRowsAroundNodes {
    std::ptrdiff_t offset[4]; ///< to cell (i, j - 1 or j, k - 1 or k)
    double width_y[4], width_z[4];

    CellRowsAroundNodes(const BoxGrid& grid, int j, int k)
    {
        for (int row = 0; row < 4; ++row) {
            const int dj = row % 2 - 1, dk = row / 2 - 1;
            offset[row] = dj * grid.stride(1) + dk * grid.stride(2);
            width_y[row] = grid.width(1, j + dj);
            width_z[row] = grid.width(2, k + dk);
        }
    }
};

/// Cell values before and after a batch of nodes along the row.
struct SideValues {
    Lanes before, after;
};

SideValues around(const double* cell)
{
    return {load<Lanes>(cell - 1), load<Lanes>(cell)};
}

Lanes node_mass(const CellRowsAroundNodes& rows, const double* cell_mass)
{
    Lanes sum{};
    for (int row = 0; row < 4; ++row) {
        const SideValues mass = around(cell_mass + rows.offset[row]);
        sum += mass.before + mass.after;
    }
    return 0.125 * sum;
}

/// Force on a batch of nodes by the pressure of the cells around them at half step [force].
struct NodeForce {
    Lanes x, y, z;
};

NodeForce pressure_force(const CellRowsAroundNodes& rows, const double* pressure, const double* rate,
                         double half_step, Lanes width_before, Lanes width_after)
{
    Lanes weighted[4];
    NodeForce force{};
    for (int row = 0; row < 4; ++row) {
        SideValues p = around(pressure + rows.offset[row]);
        const SideValues r = around(rate + rows.offset[row]);
        p.before += half_step * r.before;
        p.after += half_step * r.after;
        force.x += (rows.width_y[row] * rows.width_z[row]) * (p.before - p.after);
        weighted[row] = width_before * p.before + width_after * p.after;
    }
    force.y = rows.width_z[0] * (weighted[0] - weighted[1]) + rows.width_z[2] * (weighted[2] - weighted[3]);
    force.z = rows.width_y[0] * (weighted[0] - weighted[2]) + rows.width_y[1] * (weighted[1] - weighted[3]);
    force.x *= 0.25;
    force.y *= 0.25;
    force.z *= 0.25;
    return force;
}

/// Adds what the viscous stress of the cells does. A face sums stress times its area vector.
void add_viscous_force(NodeForce& force, const CellRowsAroundNodes& rows, const FluidFields& fields,
                       std::ptrdiff_t place, Lanes width_before, Lanes width_after)
{
    // Components in the order xx yy zz xy yz zx; row r lies at (j - 1 or j, k - 1 or k).
    for (int row = 0; row < 4; ++row) {
        const double area_x = 0.25 * rows.width_y[row] * rows.width_z[row];
        const double sign_y = row % 2 == 0 ? -1 : 1, sign_z = row / 2 == 0 ? -1 : 1;
        const double side_y = 0.25 * sign_y * rows.width_z[row], side_z = 0.25 * sign_z * rows.width_y[row];
        const auto stress = [&](int component) {
            return around(&fields.viscous[component][place + rows.offset[row]]);
        };
        const auto across = [&](const SideValues& s) { return s.after - s.before; };
        const auto summed = [&](const SideValues& s) {
            return width_before * s.before + width_after * s.after;
        };
        const SideValues xx = stress(0), yy = stress(1), zz = stress(2), xy = stress(3), yz = stress(4),
                         zx = stress(5);
        force.x += area_x * across(xx) + side_y * summed(xy) + side_z * summed(zx);
        force.y += area_x * across(xy) + side_y * summed(yy) + side_z * summed(yz);
        force.z += area_x * across(zx) + side_y * summed(yz) + side_z * summed(zz);
    }
}

double sum_of_lanes(Lanes value)
{
    double sum = 0;
    for (int lane = 0; lane < lane_count; ++lane) sum += value[lane];
    return sum;
}

double accelerate_row(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents, double step,
                      const std::array<double, 3>& gravity, int j, int k)
{
    const CellRowsAroundNodes rows(grid, j, k);
    const bool viscous = !fields.viscous[0].empty();
    const double* mass = fields.total_mass().data();
    Lanes work{};
    for (int batch = 0; batch < grid.node_batches(); ++batch) {
        const std::ptrdiff_t place = grid.at(batch * lane_count, j, k);
        if (BoxContents::nothing(contents.near_nodes(place))) continue;
        const Lanes width_before = load<Lanes>(grid.widths(0) + batch * lane_count - 1);
        const Lanes width_after = load<Lanes>(grid.widths(0) + batch * lane_count);
        const Lanes own_mass = node_mass(rows, mass + place);
        NodeForce force = pressure_force(rows, &fields.pressure[place], &fields.pressure_rate[place],
                                         0.5 * step, width_before, width_after);
        if (viscous) add_viscous_force(force, rows, fields, place, width_before, width_after);
        const auto has = own_mass > 0.0;
        const Lanes per_mass = has ? step / own_mass : Lanes{};
        store(&fields.node_mass[place], own_mass);
        const Lanes gains[3] = {per_mass * force.x, per_mass * force.y, per_mass * force.z};
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes fall = has ? broadcast<Lanes>(step * gravity[axis]) : Lanes{};
            const Lanes before = load<Lanes>(&fields.velocity[axis][place]);
            const Lanes gain = gains[axis] + fall;
            const Lanes mean = before + 0.5 * gain;
            store(&fields.velocity[axis][place], has ? before + gain : Lanes{});
            store(&fields.mean_velocity[axis][place], has ? mean : Lanes{});
            work += own_mass * fall * mean;
        }
    }
    return sum_of_lanes(work);
}

/// Volumes through the lower faces of a batch of cells along one axis.
Lanes lower_flux(const double* mean_velocity, std::ptrdiff_t a, std::ptrdiff_t b, Lanes area_times_step)
{
    return area_times_step * ((load<Lanes>(mean_velocity) + load<Lanes>(mean_velocity + a)) +
                              (load<Lanes>(mean_velocity + b) + load<Lanes>(mean_velocity + a + b)));
}

/// Work of the viscous stress on the motion of a batch of cells; it ends as heat [energy].
Lanes viscous_work(const BoxGrid& grid, const FluidFields& fields, std::ptrdiff_t place, Lanes width, int j,
                   int k, double step)
{
    const Lanes inverse[3] = {0.25 / width, broadcast<Lanes>(0.25 / grid.width(1, j)),
                              broadcast<Lanes>(0.25 / grid.width(2, k))};
    const auto gradient = [&](int component, int axis) {
        const auto sums = face_sums<Lanes>(&fields.mean_velocity[component][place], grid.stride(axis),
                                           grid.stride((axis + 1) % 3), grid.stride((axis + 2) % 3));
        return (sums.high - sums.low) * inverse[axis];
    };
    Lanes power{};
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3;
        power += load<Lanes>(&fields.viscous[axis][place]) * gradient(axis, axis);
        power +=
            load<Lanes>(&fields.viscous[3 + axis][place]) * (gradient(axis, next) + gradient(next, axis));
    }
    return power * width * (grid.width(1, j) * grid.width(2, k) * step);
}

void deform_row(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents, double step,
                const std::array<double, 3>& mesh, int j, int k)
{
    const std::ptrdiff_t sy = grid.stride(1), sz = grid.stride(2);
    const double quarter = 0.25 * step;
    const double area_x = quarter * grid.width(1, j) * grid.width(2, k);
    const bool cells = j < grid.cells(1) && k < grid.cells(2);
    for (int batch = 0; batch < grid.node_batches(); ++batch) {
        const std::ptrdiff_t place = grid.at(batch * lane_count, j, k);
        if (BoxContents::nothing(contents.near_nodes(place))) {
            continue;
        }
        const Lanes width = load<Lanes>(grid.widths(0) + batch * lane_count);
        const Lanes area_y = (quarter * grid.width(2, k)) * width,
                    area_z = (quarter * grid.width(1, j)) * width;
        const double* u[3] = {&fields.mean_velocity[0][place], &fields.mean_velocity[1][place],
                              &fields.mean_velocity[2][place]};
        const Lanes low_x = lower_flux(u[0], sy, sz, broadcast<Lanes>(area_x));
        const Lanes low_y = lower_flux(u[1], 1, sz, area_y), low_z = lower_flux(u[2], 1, sy, area_z);
        // Each of the four nodes of a face is seen from the moving box; growth does not depend on it.
        store(&fields.volume_flux[0][place], low_x - 4 * mesh[0] * area_x);
        store(&fields.volume_flux[1][place], low_y - 4 * mesh[1] * area_y);
        store(&fields.volume_flux[2][place], low_z - 4 * mesh[2] * area_z);
        if (!cells) continue;
        const Lanes high_x = lower_flux(u[0] + 1, sy, sz, broadcast<Lanes>(area_x));
        const Lanes high_y = lower_flux(u[1] + sy, 1, sz, area_y),
                    high_z = lower_flux(u[2] + sz, 1, sy, area_z);
        const Lanes growth = (high_x - low_x) + (high_y - low_y) + (high_z - low_z);
        const Lanes volume = width * (grid.width(1, j) * grid.width(2, k));
        store(&fields.volume[place], volume + growth);
        const Lanes pressure =
            load<Lanes>(&fields.pressure[place]) + (0.5 * step) * load<Lanes>(&fields.pressure_rate[place]);
        Lanes work = pressure * growth;
        if (!fields.viscous[0].empty()) work -= viscous_work(grid, fields, place, width, j, k, step);
        const BoxContents::Mask mask = contents.of_cells(place);
        if (BoxContents::nothing(mask)) continue;
        const int only = BoxContents::pure(mask) ? BoxContents::only_group(mask) : -1;
        deform_cells(fields, place, only, volume, growth, work);
    }
}

} // namespace

double accelerate(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents, double step,
                  const std::array<double, 3>& gravity)
{
    return sum_sheets<double>(grid, grid.cells(2) + 1, [&](int k) {
        double work = 0;
        for (int j = 0; j <= grid.cells(1); ++j) {
            work += accelerate_row(grid, fields, contents, step, gravity, j, k);
        }
        return work;
    });
}

void deform(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents, double step,
            const std::array<double, 3>& mesh)
{
    for_sheets(grid, grid.cells(2) + 1, [&](int k) {
        for (int j = 0; j <= grid.cells(1); ++j) deform_row(grid, fields, contents, step, mesh, j, k);
    });
}

double kinetic_energy(const BoxGrid& grid, const FluidFields& fields, const BoxContents& contents)
{
    return sum_sheets<double>(grid, grid.cells(2) + 1, [&](int k) {
        Lanes sum{};
        for (int j = 0; j <= grid.cells(1); ++j) {
            for (int batch = 0; batch < grid.node_batches(); ++batch) {
                const std::ptrdiff_t place = grid.at(batch * lane_count, j, k);
                if (BoxContents::nothing(contents.near_nodes(place))) continue;
                const Lanes x = load<Lanes>(&fields.velocity[0][place]),
                            y = load<Lanes>(&fields.velocity[1][place]),
                            z = load<Lanes>(&fields.velocity[2][place]);
                sum += load<Lanes>(&fields.node_mass[place]) * (x * x + y * y + z * z);
            }
        }
        return 0.5 * sum_of_lanes(sum);
    });
}

void find_node_masses(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents)
{
    for_sheets(grid, grid.cells(2) + 1, [&](int k) {
        for (int j = 0; j <= grid.cells(1); ++j) {
            const CellRowsAroundNodes rows(grid, j, k);
            for (int batch = 0; batch < grid.node_batches(); ++batch) {
                const std::ptrdiff_t place = grid.at(batch * lane_count, j, k);
                if (BoxContents::nothing(contents.near_nodes(place))) continue;
                store(&fields.node_mass[place], node_mass(rows, fields.total_mass().data() + place));
            }
        }
    });
}

double internal_energy(const BoxGrid& grid, const FluidFields& fields, const BoxContents& contents, int group)
{
    const double* energy = fields.groups[group].energy.data();
    return sum_sheets<double>(grid, grid.cells(2), [&](int k) {
        Lanes sum{};
        for (int j = 0; j < grid.cells(1); ++j) {
            for (int batch = 0; batch < grid.cell_batches(); ++batch) {
                const std::ptrdiff_t place = grid.at(batch * lane_count, j, k);
                if (BoxContents::nothing(contents.of_cells(place))) continue;
                const int lanes = grid.cells(0) - batch * lane_count;
                if (lanes >= lane_count)
                    sum += load<Lanes>(energy + place);
                else // ghosts have no mass, but an outside pressure works on them
                    for (int lane = 0; lane < lanes; ++lane) sum[lane] += energy[place + lane];
            }
        }
        return sum_of_lanes(sum);
    });
}

} // namespace plash
