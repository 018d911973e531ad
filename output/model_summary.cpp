#include "output/model_summary.h"

#include "core/smallest_steps.h"
#include "output/ascii_text.h"
#include "output/result_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace plash {

namespace {

void append_counts(std::string& text, const Model& model)
{
    const std::pair<const char*, std::size_t> counts[] = {
        {"number of materials", model.materials.size()},
        {"number of nodal points", model.nodes.size()},
        {"number of solid elements", model.solids.size()},
        {"of these ten-node tetrahedra", model.tetrahedra.size()},
        {"number of beam elements", model.beams.size()},
        {"number of shell elements", model.shells.size()},
        {"number of thick shell elements", model.thick_shells.size()},
        {"number of springs and dampers", model.discretes.size()},
        {"number of lumped masses", model.masses.size()},
        {"number of sph particles", model.particles.size()},
        {"number of parts", model.parts.size()},
        {"number of load curves", model.curves.size()},
        {"number of contacts", model.contacts.size()},
        {"number of rigid walls", model.rigid_walls.size()},
        {"number of sets of fixed nodes", model.fixed_nodes.size()},
        {"number of prescribed motions", model.prescribed_motions.size()},
        {"number of nodal loads", model.nodal_loads.size()},
        {"number of pressure loads", model.pressure_loads.size()},
        {"number of blast loads", model.blast_loads.size()},
        {"number of airbags", model.airbags.size()},
        {"number of body loads", model.body_loads.size()},
    };
    text += "\n c o n t r o l   i n f o r m a t i o n\n\n";
    for (const auto& [name, count] : counts) {
        if (count > 0) fmt::format_to(std::back_inserter(text), "   {:.<44}{:>12}\n", name, count);
    }
    const TimeControls& time = model.controls.time;
    fmt::format_to(std::back_inserter(text), "   {:.<44}{:>12.5e}\n", "termination time", time.end_time);
    fmt::format_to(std::back_inserter(text), "   {:.<44}{:>12.5e}\n", "time step size scale factor",
                   time.step_scale);
    if (time.mass_scaled_step != 0) {
        fmt::format_to(std::back_inserter(text), "   {:.<44}{:>12.5e}\n", "time step of mass scaling",
                       time.mass_scaled_step);
    }
}

void append_parts(std::string& text, const Model& model, const MassSummary& summary)
{
    text += "\n s u m m a r y   o f   m a s s\n\n";
    for (std::size_t part = 0; part < model.parts.size(); ++part) {
        const double mass = part < summary.parts.size() ? summary.parts[part].mass : 0;
        const Index material = model.parts[part].material;
        fmt::format_to(std::back_inserter(text), " part id ={:10}  mass={:15.8e}  {:<40.40} {}\n",
                       model.parts[part].id, mass, model.parts[part].title,
                       material == none ? "" : "*" + model.materials[material].keyword);
    }
    fmt::format_to(std::back_inserter(text),
                   "\n total mass          ={:15.8e}\n x-coordinate of mass center ={:15.8e}\n"
                   " y-coordinate of mass center ={:15.8e}\n z-coordinate of mass center ={:15.8e}\n",
                   summary.mass, summary.center.x, summary.center.y, summary.center.z);
    for (const auto& [name, added] : summary.added) {
        fmt::format_to(std::back_inserter(text), " mass scaling adds {:12.5e} to {}\n", added, name);
    }
    if (!summary.added.empty()) {
        fmt::format_to(std::back_inserter(text), " mass scaling adds {:.4f} % of the mass of the deck\n",
                       100 * summary.added_ratio);
    }
}

} // namespace

std::string format_d3hsp(const Model& model, const MassSummary& summary,
                         std::vector<ElementResults::ElementStep> steps)
{
    std::string text = ascii_heading(model);
    for (const std::string& file : model.files) text += " read: " + file + "\n";
    append_counts(text, model);
    append_parts(text, model, summary);

    const std::size_t count = std::min(listed_steps, steps.size());
    std::partial_sort(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(count), steps.end(),
                      is_smaller);
    fmt::format_to(std::back_inserter(text),
                   "\n {} smallest timesteps\n\n element                  part        timestep\n", count);
    for (std::size_t i = 0; i < count; ++i) {
        fmt::format_to(std::back_inserter(text), " {:<10}{:>10}{:>10}{:>16.6e}\n", steps[i].kind,
                       steps[i].element, steps[i].part, steps[i].step);
    }
    return text;
}

void write_d3hsp(const std::string& directory, const Model& model, const MassSummary& summary,
                 std::vector<ElementResults::ElementStep> steps)
{
    replace_file(directory + "/d3hsp", format_d3hsp(model, summary, std::move(steps)));
}

} // namespace plash
