#include "output/d3plot_values.h"

#include "output/nodal_motion.h"

#include <algorithm>

namespace plash {

namespace {

/// Zeroed entries, as many as asked for.
template <class T>
void clear(std::vector<T>& values, std::size_t count)
{
    values.assign(count, T{});
}

} // namespace

void D3plotValues::collect(const Snapshot& snapshot, const ElementRows& rows)
{
    ElementResults& r = results_;
    const std::size_t layers = layout_.layers;
    r.shell_layers = layout_.layers;
    if (layout_.shell_stress) clear(r.shell_stress, rows.shells * layers);
    if (layout_.shell_strain) clear(r.shell_plastic_strain, rows.shells * layers);
    if (layout_.shell_forces) clear(r.shell_resultants, rows.shells);
    if (layout_.shell_extra) clear(r.shell_thickness, rows.shells);
    if (layout_.shell_extra) clear(r.shell_internal_energy, rows.shells);
    r.shell_history_size = layout_.shell_variables;
    clear(r.shell_history, rows.shells * layers * layout_.shell_variables);
    if (layout_.strains) clear(r.shell_strain, rows.shells);
    clear(r.shell_deleted, rows.shells);
    clear(r.solid_stress, rows.solids);
    clear(r.solid_plastic_strain, rows.solids);
    r.solid_history_size = layout_.solid_variables;
    clear(r.solid_history, rows.solids * layout_.solid_variables);
    if (layout_.strains) clear(r.solid_strain, rows.solids);
    clear(r.solid_deleted, rows.solids);
    r.thick_shell_layers = layout_.layers;
    clear(r.thick_shell_stress, rows.thick_shells * layers);
    clear(r.thick_shell_plastic_strain, rows.thick_shells * layers);
    clear(r.thick_shell_history, rows.thick_shells * layers * layout_.shell_variables);
    if (layout_.strains) clear(r.thick_shell_strain, rows.thick_shells);
    clear(r.thick_shell_deleted, rows.thick_shells);
    clear(r.beams, rows.beams);
    clear(r.beam_deleted, rows.beams);
    r.beam_points = layout_.beam_points;
    clear(r.beam_stress, rows.beams * layout_.beam_points);
    clear(r.particles, rows.particles);
    if (layout_.fluid_groups > 0) clear(r.solid_density, rows.solids);
    r.solid_fraction.assign(layout_.fluid_groups,
                            std::vector<double>(layout_.fluid_groups > 0 ? rows.solids : 0));
    clear(r.part_motion, layout_.parts.size());
    r.walls.clear();
    r.rigid_mass = 0;
    r.rigid_momentum = {};
    snapshot.collect(r);
}

void D3plotValues::put(const Vec3& value)
{
    family_.put(value.x);
    family_.put(value.y);
    family_.put(value.z);
}

void D3plotValues::put(const SymmetricTensor<double>& value)
{
    for (double component : {value.xx, value.yy, value.zz, value.xy, value.yz, value.zx})
        family_.put(component);
}

void D3plotValues::put_globals(const Snapshot& snapshot, const NodalMotion& motion)
{
    const EnergyLedger& ledger = snapshot.ledger;
    family_.put(ledger.kinetic + ledger.eroded_kinetic);
    family_.put(ledger.internal + ledger.eroded_internal);
    family_.put(ledger.total());
    put(global_velocity(snapshot, motion, results_));
    const auto& parts = results_.part_motion;
    for (Index part : layout_.parts) family_.put(ledger.part_internal[part]);
    for (Index part : layout_.parts) family_.put(parts[part].kinetic);
    for (Index part : layout_.parts) {
        const double mass = parts[part].mass;
        for (double momentum : parts[part].momentum) family_.put(mass > 0 ? momentum / mass : 0);
    }
    for (Index part : layout_.parts) family_.put(parts[part].mass);
    for (Index part : layout_.parts) family_.put(ledger.part_hourglass[part]);
    for (const RigidWall& wall : snapshot.model.rigid_walls) {
        double force = 0;
        for (const auto& result : results_.walls) {
            if (result.wall == wall.id) force = result.normal;
        }
        family_.put(force);
    }
    for (const RigidWall& wall : snapshot.model.rigid_walls) {
        Vec3 place = wall.tail;
        for (const auto& result : results_.walls) {
            if (result.wall == wall.id) place += result.moved;
        }
        put(place);
    }
}

void D3plotValues::put_solid(Index row)
{
    const std::size_t variables = layout_.solid_variables, groups = layout_.fluid_groups;
    put(results_.solid_stress[row]);
    family_.put(results_.solid_plastic_strain[row]);
    // An Eulerian cell has no history of its own, and no other solid has a density or groups.
    for (std::size_t i = 0; i < layout_.solid_history(); ++i) {
        double value = i < variables ? results_.solid_history[row * variables + i] : 0;
        if (groups > 0 && i == 0) value += results_.solid_density[row];
        if (i > 0 && i <= groups) value += results_.solid_fraction[i - 1][row];
        family_.put(value);
    }
    if (layout_.strains) put(results_.solid_strain[row]);
}

/// One layer of a shell or thick shell.
void D3plotValues::put_point(std::size_t place, const std::vector<SymmetricTensor<double>>& stress,
                             const std::vector<double>& strain, const std::vector<double>& history)
{
    if (layout_.shell_stress) put(stress[place]);
    if (layout_.shell_strain) family_.put(strain[place]);
    const std::size_t variables = layout_.shell_variables;
    for (std::size_t i = 0; i < variables; ++i) family_.put(history[place * variables + i]);
}

/// The strains stand behind the third layer, whatever MAXINT says.
void D3plotValues::put_thick_shell(Index row)
{
    for (int layer = 0; layer < layout_.layers; ++layer) {
        put_point(static_cast<std::size_t>(row) * layout_.layers + layer, results_.thick_shell_stress,
                  results_.thick_shell_plastic_strain, results_.thick_shell_history);
        if (!layout_.strains || layer != std::min(2, layout_.layers - 1)) continue;
        for (const auto& strain : results_.thick_shell_strain[row]) put(strain);
    }
}

void D3plotValues::put_beam(Index row)
{
    const ElementResults::BeamState& state = results_.beams[row];
    for (double value :
         {state.axial, state.shear_s, state.shear_t, state.moment_s, state.moment_t, state.torsion})
        family_.put(value);
    for (int number = 0; number < layout_.beam_points; ++number) {
        const ElementResults::BeamPoint& point =
            results_.beam_stress[static_cast<std::size_t>(row) * layout_.beam_points + number];
        for (double value : {point.shear_rs, point.shear_tr, point.axial, point.plastic_strain})
            family_.put(value);
        family_.put(0); // axial strain, which no beam here keeps
    }
}

void D3plotValues::put_shell(Index row)
{
    for (int layer = 0; layer < layout_.layers; ++layer) {
        put_point(static_cast<std::size_t>(row) * layout_.layers + layer, results_.shell_stress,
                  results_.shell_plastic_strain, results_.shell_history);
    }
    if (layout_.shell_forces) {
        for (double component : results_.shell_resultants[row]) family_.put(component);
    }
    if (layout_.shell_extra) {
        family_.put(results_.shell_thickness[row]);
        family_.put(0); // two element dependent variables that no formulation here has
        family_.put(0);
    }
    if (layout_.strains) {
        for (const auto& strain : results_.shell_strain[row]) put(strain);
    }
    if (layout_.shell_extra) family_.put(results_.shell_internal_energy[row]);
}

} // namespace plash
