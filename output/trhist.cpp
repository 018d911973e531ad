#include "output/trhist.h"

#include "model/measures.h"
#include "model/tracers.h"
#include "output/ascii_text.h"
#include "output/binout_arrays.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// Stress, plastic strain and density of the elements in which tracers lie.
void add_solid_states(const Snapshot& snapshot, std::vector<ElementResults::Tracer>& tracers)
{
    const Model& model = snapshot.model;
    ElementResults results;
    results.solid_rows.assign(model.solids.size(), none);
    Index rows = 0;
    for (const ElementResults::Tracer& tracer : tracers)
        if (tracer.solid != none && results.solid_rows[tracer.solid] == none)
            results.solid_rows[tracer.solid] = rows++;
    if (rows == 0) return;
    results.solid_stress.resize(rows);
    results.solid_plastic_strain.resize(rows);
    results.solid_deleted.resize(rows);
    snapshot.collect(results);
    for (ElementResults::Tracer& tracer : tracers) {
        if (tracer.solid == none) continue;
        const Index row = results.solid_rows[tracer.solid];
        tracer.active = !results.solid_deleted[row];
        if (!tracer.active) continue;
        tracer.stress = results.solid_stress[row];
        tracer.plastic_strain = results.solid_plastic_strain[row];
        const auto& nodes = model.solids.nodes[tracer.solid];
        tracer.relative_volume =
            solid_volume(nodes, snapshot.state.position) / solid_volume(nodes, model.nodes.position);
        const Index material = model.parts[model.solids.part[tracer.solid]].material;
        if (material != none) tracer.density = model.materials[material].real("RO") / tracer.relative_volume;
    }
}

class TrhistSection final : public BinoutSection {
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        std::vector<Vec3> places, velocities, direct, shear;
        std::vector<double> strains, densities, volumes;
        std::vector<Id> active;
        for (const ElementResults::Tracer& tracer : tracer_states(snapshot)) {
            const auto& s = tracer.stress;
            places.push_back(tracer.place);
            velocities.push_back(tracer.velocity);
            direct.push_back({s.xx, s.yy, s.zz});
            shear.push_back({s.xy, s.yz, s.zx});
            strains.push_back(tracer.plastic_strain);
            densities.push_back(tracer.density);
            volumes.push_back(tracer.relative_volume);
            active.push_back(tracer.active);
        }
        file.put_whole("cycle", Id{snapshot.clock.cycle + 1});
        put_vectors(file, places, "x", "y", "z");
        put_vectors(file, velocities, "vx", "vy", "vz");
        put_vectors(file, direct, "sx", "sy", "sz");
        put_vectors(file, shear, "sxy", "syz", "szx");
        file.put("efp", strains);
        file.put("rho", densities);
        file.put("rvol", volumes);
        file.put("active", active);
    }
};

} // namespace

std::vector<ElementResults::Tracer> tracer_states(const Snapshot& snapshot)
{
    ElementResults results;
    results.tracers_wanted = true;
    snapshot.collect(results);
    add_solid_states(snapshot, results.tracers);
    return std::move(results.tracers);
}

TrhistRecorder::TrhistRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    std::string text = fmt::format("Tracer particle file\n{:10}{:10}\n", tracer_count(model), 16);
    for (const char* line : {"x y z vx vy vz", "sx sy sz sxy syz szx", "efp rho rvol active"})
        text += fmt::format("{}\n", line);
    file_.write(text);
}

void TrhistRecorder::write_state(const Snapshot& snapshot)
{
    std::string text;
    const auto line = [&](std::initializer_list<double> values) {
        for (const double value : values) append_scientific(text, value, 15, 7);
        text += '\n';
    };
    line({snapshot.clock.time});
    for (const ElementResults::Tracer& tracer : tracer_states(snapshot)) {
        const auto& s = tracer.stress;
        line({tracer.place.x, tracer.place.y, tracer.place.z, tracer.velocity.x, tracer.velocity.y,
              tracer.velocity.z});
        line({s.xx, s.yy, s.zz, s.xy, s.yz, s.zx});
        line({tracer.plastic_strain, tracer.density, tracer.relative_volume, tracer.active ? 1.0 : 0.0});
    }
    file_.write(text);
    file_.flush();
}

std::unique_ptr<BinoutSection> make_trhist_section()
{
    return std::make_unique<TrhistSection>();
}

} // namespace plash
