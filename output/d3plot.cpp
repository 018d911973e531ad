#include "output/d3plot.h"

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

void put(D3plotFamily& family, const Vec3& value)
{
    family.put(value.x);
    family.put(value.y);
    family.put(value.z);
}

void put(D3plotFamily& family, const SymmetricTensor<double>& value)
{
    for (double component : {value.xx, value.yy, value.zz, value.xy, value.yz, value.zx})
        family.put(component);
}

} // namespace

D3plotRecorder::D3plotRecorder(const Model& model, Schedule schedule, const ResultPath& path,
                               std::size_t words_per_file)
    : ScheduledRecorder(std::move(schedule)),
      layout_(model),
      family_(path, words_per_file, layout_.one_state_per_file)
{
    family_.write_geometry(d3plot_geometry(model, layout_));
}

void D3plotRecorder::write_state(const Snapshot& snapshot)
{
    const std::size_t shells = layout_.shells.size(), solids = layout_.solids.size();
    const std::size_t beams = layout_.beams.size();
    const NodalMotion motion(snapshot, false);
    ElementResults& r = results_;
    r.shell_layers = layout_.layers;
    if (layout_.shell_stress) clear(r.shell_stress, shells * layout_.layers);
    if (layout_.shell_strain) clear(r.shell_plastic_strain, shells * layout_.layers);
    if (layout_.shell_forces) clear(r.shell_resultants, shells);
    if (layout_.shell_extra) clear(r.shell_thickness, shells);
    if (layout_.shell_extra) clear(r.shell_internal_energy, shells);
    r.shell_history_size = layout_.shell_variables;
    clear(r.shell_history, shells * layout_.layers * layout_.shell_variables);
    if (layout_.strains) clear(r.shell_strain, shells);
    clear(r.shell_deleted, shells);
    clear(r.solid_stress, solids);
    clear(r.solid_plastic_strain, solids);
    r.solid_history_size = layout_.solid_variables;
    clear(r.solid_history, solids * layout_.solid_variables);
    if (layout_.strains) clear(r.solid_strain, solids);
    clear(r.solid_deleted, solids);
    const std::size_t thick_shells = layout_.thick_shells.size();
    r.thick_shell_layers = layout_.layers;
    clear(r.thick_shell_stress, thick_shells * layout_.layers);
    clear(r.thick_shell_plastic_strain, thick_shells * layout_.layers);
    clear(r.thick_shell_history, thick_shells * layout_.layers * layout_.shell_variables);
    if (layout_.strains) clear(r.thick_shell_strain, thick_shells);
    clear(r.thick_shell_deleted, thick_shells);
    clear(r.beams, beams);
    clear(r.beam_deleted, beams);
    r.beam_points = layout_.beam_points;
    clear(r.beam_stress, beams * layout_.beam_points);
    clear(r.particles, layout_.particles.size());
    if (layout_.fluid_groups > 0) clear(r.solid_density, solids);
    r.solid_fraction.assign(layout_.fluid_groups, std::vector<double>(layout_.fluid_groups > 0 ? solids : 0));
    clear(r.part_motion, layout_.parts.size());
    r.walls.clear();
    r.rigid_mass = 0;
    r.rigid_momentum = {};
    snapshot.collect(r);

    family_.begin_state(snapshot.clock.time, layout_.state_words());
    put_globals(snapshot, global_velocity(snapshot, motion, r));
    for (Index node : layout_.nodes) put(family_, motion.position(node));
    for (Index node : layout_.nodes) put(family_, motion.velocity(node));
    for (Index node : layout_.nodes) put(family_, motion.acceleration(node));
    put_solids();
    put_thick_shells();
    put_beams();
    put_shells();
    for (Index solid : layout_.solids) family_.put(r.solid_deleted[solid] ? 0 : 1);
    for (Index shell : layout_.thick_shells) family_.put(r.thick_shell_deleted[shell] ? 0 : 1);
    for (Index shell : layout_.shells) family_.put(r.shell_deleted[shell] ? 0 : 1);
    for (Index beam : layout_.beams) family_.put(r.beam_deleted[beam] ? 0 : 1);
    put_particles(snapshot.model);
    family_.end_state();
}

void D3plotRecorder::put_globals(const Snapshot& snapshot, const Vec3& velocity)
{
    const EnergyLedger& ledger = snapshot.ledger;
    family_.put(ledger.kinetic + ledger.eroded_kinetic);
    family_.put(ledger.internal + ledger.eroded_internal);
    family_.put(ledger.total());
    put(family_, velocity);
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
        put(family_, place);
    }
}

void D3plotRecorder::put_solids()
{
    const std::size_t variables = layout_.solid_variables, groups = layout_.fluid_groups;
    for (Index solid : layout_.solids) {
        put(family_, results_.solid_stress[solid]);
        family_.put(results_.solid_plastic_strain[solid]);
        // An Eulerian cell has no history of its own, and no other solid has a density or groups.
        for (std::size_t i = 0; i < layout_.solid_history(); ++i) {
            double value = i < variables ? results_.solid_history[solid * variables + i] : 0;
            if (groups > 0 && i == 0) value += results_.solid_density[solid];
            if (i > 0 && i <= groups) value += results_.solid_fraction[i - 1][solid];
            family_.put(value);
        }
        if (layout_.strains) put(family_, results_.solid_strain[solid]);
    }
}

/// One layer of a shell or thick shell.
void D3plotRecorder::put_point(std::size_t place, const std::vector<SymmetricTensor<double>>& stress,
                               const std::vector<double>& strain, const std::vector<double>& history)
{
    if (layout_.shell_stress) put(family_, stress[place]);
    if (layout_.shell_strain) family_.put(strain[place]);
    const std::size_t variables = layout_.shell_variables;
    for (std::size_t i = 0; i < variables; ++i) family_.put(history[place * variables + i]);
}

/// The strains stand behind the third layer, whatever MAXINT says.
void D3plotRecorder::put_thick_shells()
{
    for (Index shell : layout_.thick_shells) {
        for (int layer = 0; layer < layout_.layers; ++layer) {
            put_point(static_cast<std::size_t>(shell) * layout_.layers + layer, results_.thick_shell_stress,
                      results_.thick_shell_plastic_strain, results_.thick_shell_history);
            if (!layout_.strains || layer != std::min(2, layout_.layers - 1)) continue;
            for (const auto& strain : results_.thick_shell_strain[shell]) put(family_, strain);
        }
    }
}

void D3plotRecorder::put_beams()
{
    for (Index beam : layout_.beams) {
        const ElementResults::BeamState& state = results_.beams[beam];
        for (double value :
             {state.axial, state.shear_s, state.shear_t, state.moment_s, state.moment_t, state.torsion})
            family_.put(value);
        for (int number = 0; number < layout_.beam_points; ++number) {
            const ElementResults::BeamPoint& point =
                results_.beam_stress[static_cast<std::size_t>(beam) * layout_.beam_points + number];
            for (double value : {point.shear_rs, point.shear_tr, point.axial, point.plastic_strain})
                family_.put(value);
            family_.put(0); // axial strain, which no beam here keeps
        }
    }
}

void D3plotRecorder::put_shells()
{
    for (Index shell : layout_.shells) {
        for (int layer = 0; layer < layout_.layers; ++layer) {
            put_point(static_cast<std::size_t>(shell) * layout_.layers + layer, results_.shell_stress,
                      results_.shell_plastic_strain, results_.shell_history);
        }
        if (layout_.shell_forces) {
            for (double component : results_.shell_resultants[shell]) family_.put(component);
        }
        if (layout_.shell_extra) {
            family_.put(results_.shell_thickness[shell]);
            family_.put(0); // two element dependent variables that no formulation here has
            family_.put(0);
        }
        if (layout_.strains) {
            for (const auto& strain : results_.shell_strain[shell]) put(family_, strain);
        }
        if (layout_.shell_extra) family_.put(results_.shell_internal_energy[shell]);
    }
}

/// Each begins with the place of its part, negative once the particle has left the run.
void D3plotRecorder::put_particles(const Model& model)
{
    std::vector<double> part_place(layout_.parts.size());
    for (std::size_t i = 0; i < layout_.parts.size(); ++i)
        part_place[layout_.parts[i]] = static_cast<double>(i + 1);
    for (Index index : layout_.particles) {
        const ElementResults::Particle& particle = results_.particles[index];
        const double part = part_place[model.particles.part[index]];
        family_.put(particle.active ? part : -part);
        family_.put(particle.smoothing);
        family_.put(particle.pressure);
        put(family_, particle.stress);
        family_.put(particle.plastic_strain);
        family_.put(particle.density);
        family_.put(particle.internal_energy);
        family_.put(particle.neighbours);
        family_.put(particle.mass);
    }
}

} // namespace plash
