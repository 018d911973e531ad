#include "ale/box_fluid.h"

namespace plash {

BoxFluid::BoxFluid(BoxGrid box, std::vector<FluidGroup> all_groups, LagrangeSettings settings)
    : grid(std::move(box)),
      groups(std::move(all_groups)),
      lagrange(settings),
      fields(grid, static_cast<int>(groups.size()), settings.void_allowed || groups.size() > 1,
             settings.viscous),
      contents(grid, settings.void_allowed || groups.size() > 1),
      scratch_(grid, static_cast<int>(groups.size()))
{}

void BoxFluid::fill_cell(int i, int j, int k, int group, double fraction, double density,
                         double energy_per_mass)
{
    const std::ptrdiff_t place = grid.at(i, j, k);
    const double mass = fraction * grid.volume(i, j, k) * density;
    fields.groups[group].mass[place] = mass;
    fields.groups[group].energy[place] = mass * energy_per_mass;
    if (!fields.groups[group].fraction.empty()) fields.groups[group].fraction[place] = fraction;
    if (groups.size() == 1) return;
    fields.mass_of_groups[place] = 0;
    for (const GroupFields& other : fields.groups) fields.mass_of_groups[place] += other.mass[place];
}

void BoxFluid::start()
{
    contents.update(grid, fields);
    hold_nodes(fields, held);
    evaluate(0);
    find_node_masses(grid, fields, contents);
    sum_energies();
}

void BoxFluid::evaluate(double last_step)
{
    limit_ = evaluate_state(grid, fields, contents, groups, lagrange, last_step);
    if (outside_pressure != 0) press_on_sides(grid, fields, outside_pressure);
}

void BoxFluid::sum_energies()
{
    energies_.kinetic = kinetic_energy(grid, fields, contents);
    energies_.internal = 0;
    energies_.group_internal.resize(groups.size());
    for (int group = 0; group < static_cast<int>(groups.size()); ++group) {
        energies_.group_internal[group] = internal_energy(grid, fields, contents, group);
        energies_.internal += energies_.group_internal[group];
    }
}

double BoxFluid::sum_internal() const
{
    double sum = 0;
    for (int group = 0; group < static_cast<int>(groups.size()); ++group)
        sum += internal_energy(grid, fields, contents, group);
    return sum;
}

void BoxFluid::remap()
{
    // The order of the axes goes round so that none is favoured, forth and back for second order (Strang
    // 1968).
    static constexpr int orders[6][3] = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {0, 2, 1}, {2, 0, 1}, {1, 0, 2}};
    const double before = open_sides ? sum_internal() : 0;
    for (const int axis : orders[steps_ % 6]) {
        find_outflow_shares(grid, fields, contents, axis);
        sweep_cells(grid, fields, contents, scratch_, axis, order);
        sweep_momentum(grid, fields, contents, scratch_, axis, order);
        contents.update(grid, fields);
    }
    hold_nodes(fields, held);
    if (open_sides) energies_.outflow += before - sum_internal();
    if (!fields.lost_motion.empty()) energies_.advection_loss -= return_lost_motion(grid, fields, contents);
}

void BoxFluid::conserve_total_energy()
{
    fields.lost_motion.assign(grid.storage(), 0.0);
}

void BoxFluid::advance(double step, double impulse_step)
{
    const double gravity_work = accelerate(grid, fields, contents, step, gravity);
    const OutsideWork outside = apply_outside(fields, outside_forces, held, step, impulse_step, gravity);
    energies_.outside_work += gravity_work + outside.gravity + outside.driving;
    energies_.coupling_work += outside.forces;
    deform(grid, fields, contents, step, lagrange.mesh_velocity);
    if (outside_pressure != 0)
        energies_.outside_work += work_on_sides(grid, fields, contents, outside_pressure);
    const double before = kinetic_energy(grid, fields, contents);
    remap();
    ++steps_;
    evaluate(step);
    sum_energies();
    energies_.advection_loss += before - energies_.kinetic;
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

} // namespace plash
