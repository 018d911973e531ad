#include "output/d3plot.h"

#include "output/nodal_motion.h"

namespace plash {

D3plotRecorder::D3plotRecorder(const Model& model, Schedule schedule, const ResultPath& path,
                               std::size_t words_per_file)
    : ScheduledRecorder(std::move(schedule)),
      layout_(model),
      family_(path, words_per_file, layout_.one_state_per_file),
      values_(layout_, family_)
{
    family_.write_geometry(d3plot_geometry(model, layout_));
}

void D3plotRecorder::write_state(const Snapshot& snapshot)
{
    const NodalMotion motion(snapshot, false);
    values_.collect(snapshot, {layout_.solids.size(), layout_.thick_shells.size(), layout_.beams.size(),
                               layout_.shells.size(), layout_.particles.size()});
    const ElementResults& r = values_.results();

    family_.begin_state(snapshot.clock.time, layout_.state_words());
    values_.put_globals(snapshot, motion);
    for (Index node : layout_.nodes) values_.put(motion.position(node));
    for (Index node : layout_.nodes) values_.put(motion.velocity(node));
    for (Index node : layout_.nodes) values_.put(motion.acceleration(node));
    for (Index solid : layout_.solids) values_.put_solid(solid);
    for (Index shell : layout_.thick_shells) values_.put_thick_shell(shell);
    for (Index beam : layout_.beams) values_.put_beam(beam);
    for (Index shell : layout_.shells) values_.put_shell(shell);
    for (Index solid : layout_.solids) family_.put(r.solid_deleted[solid] ? 0 : 1);
    for (Index shell : layout_.thick_shells) family_.put(r.thick_shell_deleted[shell] ? 0 : 1);
    for (Index shell : layout_.shells) family_.put(r.shell_deleted[shell] ? 0 : 1);
    for (Index beam : layout_.beams) family_.put(r.beam_deleted[beam] ? 0 : 1);
    put_particles(snapshot.model);
    family_.end_state();
}

/// Each begins with the place of its part, negative once the particle has left the run.
void D3plotRecorder::put_particles(const Model& model)
{
    std::vector<double> part_place(layout_.parts.size());
    for (std::size_t i = 0; i < layout_.parts.size(); ++i)
        part_place[layout_.parts[i]] = static_cast<double>(i + 1);
    for (Index index : layout_.particles) {
        const ElementResults::Particle& particle = values_.results().particles[index];
        const double part = part_place[model.particles.part[index]];
        family_.put(particle.active ? part : -part);
        family_.put(particle.smoothing);
        family_.put(particle.pressure);
        values_.put(particle.stress);
        family_.put(particle.plastic_strain);
        family_.put(particle.density);
        family_.put(particle.internal_energy);
        family_.put(particle.neighbours);
        family_.put(particle.mass);
    }
}

} // namespace plash
