#include "output/sphout.h"

#include "output/ascii_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// The particles of the nodes that the deck names, in the Model's order.
std::vector<Index> particles_at(const Model& model, std::vector<Index> nodes)
{
    std::sort(nodes.begin(), nodes.end());
    std::vector<Index> particles;
    for (std::size_t i = 0; i < model.particles.size(); ++i) {
        if (std::binary_search(nodes.begin(), nodes.end(), model.particles.node[i])) {
            particles.push_back(static_cast<Index>(i));
        }
    }
    return particles;
}

} // namespace

std::string format_sphout(long cycle, double time, std::span<const ParticleRow> rows)
{
    std::string text =
        fmt::format("\n\n\n s p h   p a r t i c l e s   f o r   t i m e   s t e p{:9}   ( at time", cycle);
    append_scientific(text, time, 14, 7);
    text += " )\n\n"
            " particle    part      sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx   "
            "von-mises"
            "     plastic\n"
            "                     pressure     density   smoothing      energy  neighbours      active\n";
    for (const ParticleRow& row : rows) {
        const ElementResults::Particle& p = row.state;
        const SymmetricTensor<double>& s = p.stress;
        fmt::format_to(std::back_inserter(text), "{:9}{:8}", row.id, row.part);
        for (double value : {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx, von_mises_stress(s), p.plastic_strain}) {
            append_scientific(text, value, 12, 4);
        }
        text += "\n                 ";
        for (double value : {p.pressure, p.density, p.smoothing, p.internal_energy}) {
            append_scientific(text, value, 12, 4);
        }
        fmt::format_to(std::back_inserter(text), "{:12}{:12}\n", p.neighbours, p.active ? 1 : 0);
    }
    return text;
}

SphoutRecorder::SphoutRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)),
      particles_(particles_at(model, model.controls.output.history_particles)),
      file_(path)
{
    std::string entries;
    for (Index particle : particles_) {
        entries += legend_entry(model.nodes.id[model.particles.node[particle]], "", 80);
    }
    file_.write(ascii_heading(model) + ascii_legend(entries));
}

void SphoutRecorder::write_state(const Snapshot& snapshot)
{
    const Model& model = snapshot.model;
    ElementResults results;
    results.particles.resize(model.particles.size());
    snapshot.collect(results);
    std::vector<ParticleRow> rows;
    for (Index particle : particles_) {
        rows.push_back({model.nodes.id[model.particles.node[particle]],
                        model.parts[model.particles.part[particle]].id, results.particles[particle]});
    }
    file_.write(format_sphout(snapshot.clock.cycle + 1, snapshot.clock.time, rows));
    file_.flush();
}

} // namespace plash
