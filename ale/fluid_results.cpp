#include "ale/fluid_term.h"

#include <algorithm>

namespace plash {

/// Parts carry the sums of the group that begins with them; groups without a part those of the mesh.
Index EulerianFluid::part_of_group(const DeckGroup& group) const
{
    return group.parts.empty() ? model_.solids.part[block_.solids.front()] : group.parts.front();
}

void EulerianFluid::collect(const State&, ElementResults& results) const
{
    collect_cells(results);
    if (!results.material_velocity.empty()) collect_nodes(results);
    if (!results.part_motion.empty()) collect_parts(results);
    if (!results.fluid_cells.empty()) collect_cell_sums(results);
    for (ElementResults::FluidRegion& region : results.fluid_regions) collect_region(region);
}

/// Kinetic energy of a cell by mass, where its nodes have an eighth of each of their cells [energy/mass].
double EulerianFluid::kinetic_per_mass(const FluidCell& cell) const
{
    double sum = 0;
    for (const std::ptrdiff_t node : cell.corners)
        for (const AlignedDoubles& component : fluid_->fields.velocity)
            sum += 0.0625 * component[node] * component[node];
    return sum;
}

void EulerianFluid::collect_cell_sums(ElementResults& results) const
{
    for (std::size_t number = 0; number < fluid_->cell_count(); ++number) {
        const FluidCell cell = fluid_->cell(number);
        ElementResults::FluidCellSum& sum = results.fluid_cells[block_.solids[number]];
        sum.volume = cell.volume;
        sum.mass = fluid_->fields.total_mass()[cell.place];
        for (const GroupFields& group : fluid_->fields.groups) sum.internal += group.energy[cell.place];
        sum.kinetic = sum.mass * kinetic_per_mass(cell);
        sum.pressure = sum.mass > 0 ? fluid_->fields.pressure[cell.place] : 0;
    }
}

/// Void takes what the fluids leave of a cell.
void EulerianFluid::collect_region(ElementResults::FluidRegion& region) const
{
    const FluidFields& fields = fluid_->fields;
    const int empty = groups_.vacuum();
    for (std::size_t number = 0; number < fluid_->cell_count(); ++number) {
        if (!region.solids.empty() && !region.solids[block_.solids[number]]) continue;
        const FluidCell cell = fluid_->cell(number);
        const double kinetic = kinetic_per_mass(cell), pressure = fields.pressure[cell.place];
        double left = cell.volume;
        for (std::size_t g = 0; g < groups_.groups.size(); ++g) {
            if (groups_.groups[g].fluid == none) continue;
            const GroupFields& own = fields.groups[groups_.groups[g].fluid];
            const double mass = own.mass[cell.place];
            if (!(mass > 0)) continue;
            ElementResults::FluidSum& sum = region.groups[g];
            const double volume = (own.fraction.empty() ? 1 : own.fraction[cell.place]) * cell.volume;
            sum.lowest_pressure = sum.mass > 0 ? std::min(sum.lowest_pressure, pressure) : pressure;
            sum.highest_pressure = sum.mass > 0 ? std::max(sum.highest_pressure, pressure) : pressure;
            sum.volume += volume;
            sum.mass += mass;
            sum.internal += own.energy[cell.place];
            sum.kinetic += mass * kinetic;
            for (int axis = 0; axis < 3; ++axis)
                for (const std::ptrdiff_t node : cell.corners)
                    sum.momentum[axis] += 0.125 * mass * fields.velocity[axis][node];
            left -= volume;
        }
        if (empty != none) region.groups[empty].volume += std::max(left, 0.0);
    }
}

void EulerianFluid::collect_cells(ElementResults& results) const
{
    if (results.solid_stress.empty() && results.solid_density.empty() && results.solid_fraction.empty())
        return;
    const FluidFields& fields = fluid_->fields;
    const bool mixed = !fields.groups[0].fraction.empty();
    for (std::size_t cell = 0; cell < fluid_->cell_count(); ++cell) {
        const Index solid = block_.solids[cell], row = results.row_of_solid(solid);
        if (row == none) continue;
        const FluidCell own = fluid_->cell(cell);
        const std::ptrdiff_t place = own.place;
        if (!results.solid_stress.empty()) {
            ElementResults::Stress stress{};
            const bool filled = fields.total_mass()[place] > 0;
            if (filled) stress.xx = stress.yy = stress.zz = -fields.pressure[place];
            if (filled && !fields.viscous[0].empty()) {
                stress.xx += fields.viscous[0][place];
                stress.yy += fields.viscous[1][place];
                stress.zz += fields.viscous[2][place];
                stress.xy = fields.viscous[3][place];
                stress.yz = fields.viscous[4][place];
                stress.zx = fields.viscous[5][place];
            }
            results.solid_stress[row] = stress;
        }
        if (!results.solid_density.empty())
            results.solid_density[row] = fields.total_mass()[place] / own.volume;
        if (results.solid_fraction.empty()) continue;
        double filled = 0;
        const std::size_t count = groups_.groups.size();
        for (std::size_t g = 0; g < count; ++g) {
            const int number = groups_.groups[g].fluid;
            if (number == none) continue;
            const double share = mixed ? fields.groups[number].fraction[place] : 1;
            filled += share;
            if (g < results.solid_fraction.size()) results.solid_fraction[g][row] = share;
        }
        const int empty = groups_.vacuum();
        if (empty != none && empty < static_cast<int>(results.solid_fraction.size()))
            results.solid_fraction[empty][row] = std::max(1 - filled, 0.0);
    }
}

void EulerianFluid::collect_nodes(ElementResults& results) const
{
    const auto& v = fluid_->fields.velocity;
    for (std::size_t number = 0; number < block_.nodes.size(); ++number) {
        const std::ptrdiff_t place = fluid_->node_place(number);
        results.material_velocity[block_.nodes[number]] = {v[0][place], v[1][place], v[2][place]};
    }
}

/// Mass, momentum and kinetic energy of the groups: a node has an eighth of each of its cells.
void EulerianFluid::collect_parts(ElementResults& results) const
{
    const auto& v = fluid_->fields.velocity;
    for (const DeckGroup& group : groups_.groups) {
        if (group.fluid == none) continue;
        ElementResults::PartMotion& sum = results.part_motion[part_of_group(group)];
        sum.outside_state = true;
        for (std::size_t number = 0; number < fluid_->cell_count(); ++number) {
            const FluidCell cell = fluid_->cell(number);
            const double mass = fluid_->fields.groups[group.fluid].mass[cell.place];
            if (mass == 0) continue;
            sum.mass += mass;
            for (const std::ptrdiff_t node : cell.corners) {
                for (int axis = 0; axis < 3; ++axis) {
                    sum.momentum[axis] += 0.125 * mass * v[axis][node];
                    sum.kinetic += 0.0625 * mass * v[axis][node] * v[axis][node];
                }
            }
        }
    }
}

} // namespace plash
