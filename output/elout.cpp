#include "output/elout.h"

#include "output/ascii_text.h"
#include "output/beam_files.h"
#include "output/chosen_rows.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>

namespace plash {

namespace {

std::string table_heading(long cycle, double time)
{
    std::string text =
        fmt::format("\n\n\n e l e m e n t   s t r e s s   c a l c u l a t i o n s   f o r   t i m e  "
                    "s t e p{:9}   ( at time ",
                    cycle);
    append_scientific(text, time, 12, 5);
    return text + " )\n\n";
}

void append_point(std::string& text, const PointStress& point)
{
    fmt::format_to(std::back_inserter(text), "{:<7} ", point.plastic_strain > 0 ? "plastic" : "elastic");
    const SymmetricTensor<double>& s = point.stress;
    for (double component : {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx}) append_scientific(text, component, 12, 4);
}

/// The strains of some elements behind their stresses, where they are asked for.
/// sides  what stands before the tensors of an element
void append_strains(std::string& text, std::span<const ElementHistory> elements,
                    std::initializer_list<const char*> sides)
{
    if (elements.empty() || elements[0].strains.empty()) return;
    text += "\n strains (global)      eps-xx      eps-yy      eps-zz      eps-xy      eps-yz      eps-zx";
    text += std::string(36, ' ') + '\n' + std::string(117, ' ') + '\n';
    for (const ElementHistory& element : elements) {
        fmt::format_to(std::back_inserter(text), "{:8}-{:7}\n", element.id, element.part);
        auto strain = element.strains.begin();
        for (const char* side : sides) {
            text += fmt::format("{:<17}", side);
            for (double component : {strain->xx, strain->yy, strain->zz, strain->xy, strain->yz, strain->zx})
                append_scientific(text, component, 12, 4);
            text += '\n';
            ++strain;
        }
    }
}

const Record* section_of(const Model& model, Index part)
{
    const Index section = model.parts[part].section;
    return section == none ? nullptr : &model.sections[section];
}

/// Points through the thickness of a thick shell: its plies, or NIP of its section.
int thick_shell_points(const Model& model, Index shell)
{
    const ThickShellElements& shells = model.thick_shells;
    if (!shells.layers.empty() && !shells.layers[shell].empty())
        return static_cast<int>(shells.layers[shell].size());
    const Part& part = model.parts[shells.part[shell]];
    if (!part.layers.empty()) return static_cast<int>(part.layers.size());
    const Record* section = section_of(model, shells.part[shell]);
    const Id points = section ? section->integer("NIP", 2) : 2;
    return points > 0 ? static_cast<int>(points) : 2;
}

/// Layer of the collected results that holds integration point `point` (from the bottom). Three layers come
/// as middle, innermost, outermost; any other number from bottom to top.
int layer_of(int point, int points, int layers)
{
    if (layers != 3) return point;
    if (points == 1) return 0;
    if (points == 2) return 1 + point;
    return std::array{1, 0, 2}[point];
}

/// kind  three letters, as in the heading of the points
std::string format_layers(long cycle, double time, std::span<const ElementHistory> shells,
                          std::string_view kind)
{
    std::string text = table_heading(cycle, time);
    text += " element  materl(global)\n ipt-";
    text += kind;
    text +=
        "  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx       "
        "plastic\n"
        "           state                                                                                 "
        "strain \n";
    for (const ElementHistory& shell : shells) {
        fmt::format_to(std::back_inserter(text), "{:8}-{:7}\n", shell.id, shell.part);
        for (std::size_t i = 0; i < shell.points.size(); ++i) {
            fmt::format_to(std::back_inserter(text), "{:4}-{:3} ", i + 1, shell.formulation);
            append_point(text, shell.points[i]);
            append_scientific(text, shell.points[i].plastic_strain, 14, 4);
            text += '\n';
        }
    }
    append_strains(text, shells, {" lower ipt", " upper ipt"});
    return text;
}

} // namespace

std::string format_elout_solids(long cycle, double time, std::span<const ElementHistory> solids)
{
    std::string text = table_heading(cycle, time);
    text +=
        " element  materl\n"
        "     ipt  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx           "
        "            yield\n"
        "           state                                                                                  "
        "effsg      function\n";
    for (const ElementHistory& solid : solids) {
        fmt::format_to(std::back_inserter(text), "{:8}-{:7}\n", solid.id, solid.part);
        for (std::size_t i = 0; i < solid.points.size(); ++i) {
            fmt::format_to(std::back_inserter(text), "{:8} ", i + 1);
            append_point(text, solid.points[i]);
            append_scientific(text, von_mises_stress(solid.points[i].stress), 14, 4);
            append_scientific(text, solid.points[i].plastic_strain, 14, 4);
            text += '\n';
        }
    }
    append_strains(text, solids, {""});
    return text;
}

std::string format_elout_shells(long cycle, double time, std::span<const ElementHistory> shells)
{
    return format_layers(cycle, time, shells, "shl");
}

std::string format_elout_thick_shells(long cycle, double time, std::span<const ElementHistory> shells)
{
    return format_layers(cycle, time, shells, "tsh");
}

ElementHistories::ElementHistories(const Model& model)
    : shells_(without_repeats(model.controls.output.history_shells)),
      solids_(without_repeats(model.controls.output.history_solids)),
      shell_rows_(rows_of(shells_, model.shells.size())),
      solid_rows_(rows_of(solids_, model.solids.size())),
      thick_shells_(without_repeats(model.controls.output.history_thick_shells)),
      thick_shell_rows_(rows_of(thick_shells_, model.thick_shells.size())),
      strains_(model.controls.output.strains())
{
    for (Index shell : thick_shells_) {
        const int points = thick_shell_points(model, shell);
        thick_shell_points_.push_back(points);
        thick_shell_layers_ = std::max(thick_shell_layers_, points);
    }
    for (Index shell : shells_) {
        const Record* section = section_of(model, model.shells.part[shell]);
        const int points = section ? std::max<int>(1, section->integer("NIP", 2)) : 1;
        shell_points_.push_back(points);
        shell_layers_ = std::max(shell_layers_, points);
    }
}

ElementHistories::Lists ElementHistories::collect(const Snapshot& snapshot) const
{
    const Model& model = snapshot.model;
    ElementResults results;
    results.shell_rows = shell_rows_;
    results.solid_rows = solid_rows_;
    results.shell_layers = shell_layers_;
    results.shell_stress.resize(shells_.size() * shell_layers_);
    results.shell_plastic_strain.resize(shells_.size() * shell_layers_);
    results.shell_deleted.resize(shells_.size());
    results.solid_stress.resize(solids_.size());
    results.solid_plastic_strain.resize(solids_.size());
    results.solid_deleted.resize(solids_.size());
    results.thick_shell_rows = thick_shell_rows_;
    results.thick_shell_layers = thick_shell_layers_;
    results.thick_shell_stress.resize(thick_shells_.size() * thick_shell_layers_);
    results.thick_shell_plastic_strain.resize(thick_shells_.size() * thick_shell_layers_);
    results.thick_shell_deleted.resize(thick_shells_.size());
    if (strains_) {
        results.shell_strain.resize(shells_.size());
        results.solid_strain.resize(solids_.size());
        results.thick_shell_strain.resize(thick_shells_.size());
    }
    snapshot.collect(results);

    Lists lists;
    auto& [solids, shells, thick_shells] = lists;
    for (std::size_t row = 0; row < thick_shells_.size(); ++row) {
        if (results.thick_shell_deleted[row]) continue;
        const Index part = model.thick_shells.part[thick_shells_[row]];
        const Record* section = section_of(model, part);
        ElementHistory& shell = thick_shells.emplace_back();
        shell.id = model.thick_shells.id[thick_shells_[row]];
        if (strains_)
            shell.strains.assign(results.thick_shell_strain[row].begin(),
                                 results.thick_shell_strain[row].end());
        shell.part = model.parts[part].id;
        shell.formulation = section ? section->integer("ELFORM", 1) : 1;
        for (int point = 0; point < thick_shell_points_[row]; ++point) {
            const std::size_t place =
                row * thick_shell_layers_ + layer_of(point, thick_shell_points_[row], thick_shell_layers_);
            shell.points.push_back(
                {results.thick_shell_stress[place], results.thick_shell_plastic_strain[place]});
        }
    }
    for (std::size_t row = 0; row < solids_.size(); ++row) {
        if (results.solid_deleted[row]) continue;
        ElementHistory& solid = solids.emplace_back();
        solid.id = model.solids.id[solids_[row]];
        solid.part = model.parts[model.solids.part[solids_[row]]].id;
        if (strains_) solid.strains = {results.solid_strain[row]};
        solid.points = {{results.solid_stress[row], results.solid_plastic_strain[row]}};
    }
    for (std::size_t row = 0; row < shells_.size(); ++row) {
        if (results.shell_deleted[row]) continue;
        const Index part = model.shells.part[shells_[row]];
        const Record* section = section_of(model, part);
        ElementHistory& shell = shells.emplace_back();
        shell.id = model.shells.id[shells_[row]];
        if (strains_)
            shell.strains.assign(results.shell_strain[row].begin(), results.shell_strain[row].end());
        shell.part = model.parts[part].id;
        shell.formulation = section ? section->integer("ELFORM", 2) : 2;
        for (int point = 0; point < shell_points_[row]; ++point) {
            const std::size_t place =
                row * shell_layers_ + layer_of(point, shell_points_[row], shell_layers_);
            shell.points.push_back({results.shell_stress[place], results.shell_plastic_strain[place]});
        }
    }
    return lists;
}

EloutRecorder::EloutRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)),
      histories_(model),
      beams_(without_repeats(model.controls.output.history_beams)),
      file_(path)
{
    file_.write(ascii_heading(model) + "\n\n");
}

void EloutRecorder::write_state(const Snapshot& snapshot)
{
    const auto [solids, shells, thick_shells] = histories_.collect(snapshot);
    const long cycle = snapshot.clock.cycle + 1;
    if (!solids.empty()) file_.write(format_elout_solids(cycle, snapshot.clock.time, solids));
    if (!shells.empty()) file_.write(format_elout_shells(cycle, snapshot.clock.time, shells));
    if (!thick_shells.empty())
        file_.write(format_elout_thick_shells(cycle, snapshot.clock.time, thick_shells));
    if (!beams_.empty()) file_.write(format_elout_beams(snapshot, beams_));
    file_.flush();
}

} // namespace plash
