#include "output/beam_files.h"

#include "output/ascii_text.h"
#include "output/chosen_rows.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr int most_points = 64; // of a cross section that are shown

/// Number of LS-DYNA's material type: 100 of *MAT_SPOTWELD.
int material_type(const std::string& keyword)
{
    if (keyword == "MAT_ELASTIC") return 1;
    if (keyword == "MAT_PLASTIC_KINEMATIC") return 3;
    if (keyword == "MAT_PIECEWISE_LINEAR_PLASTICITY") return 24;
    if (keyword == "MAT_SPOTWELD") return 100;
    return 0;
}

} // namespace

std::string format_elout_beams(const Snapshot& snapshot, std::span<const Index> beams)
{
    const Model& model = snapshot.model;
    ElementResults results;
    results.beam_rows = rows_of(beams, model.beams.size());
    results.beams.resize(beams.size());
    results.beam_deleted.resize(beams.size());
    results.beam_points = most_points;
    results.beam_stress.resize(beams.size() * most_points);
    snapshot.collect(results);

    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(
        out, "\n\n r e s u l t a n t s   a n d   s t r e s s e s   f o r   t i m e  s t e p{:9}   ( at time ",
        snapshot.clock.cycle + 1);
    append_scientific(text, snapshot.clock.time, 11, 5);
    text += " )\n";
    for (std::size_t row = 0; row < beams.size(); ++row) {
        if (results.beam_deleted[row]) continue;
        const Part& part = model.parts[model.beams.part[beams[row]]];
        const int type = part.material == none ? 0 : material_type(model.materials[part.material].keyword);
        fmt::format_to(out, "\n\n beam/truss # ={:8}      part ID  ={:10}      material type={:8}\n",
                       model.beams.id[beams[row]], part.id, type);
        text += "\n resultants      axial    shear-s    shear-t    moment-s   moment-t   torsion     pl eps\n"
                "           ";
        const auto& beam = results.beams[row];
        for (double value : {beam.axial, beam.shear_s, beam.shear_t, beam.moment_s, beam.moment_t,
                             beam.torsion, beam.plastic_strain}) {
            append_scientific(text, value, 11, 3);
        }
        text += "\n\n\n integration point stresses\n"
                "                       sigma 11       sigma 12       sigma 31   plastic  eps\n";
        for (int point = 0; point < std::min(beam.points, most_points); ++point) {
            const auto& stress = results.beam_stress[row * most_points + point];
            fmt::format_to(out, "{:5}      ", point + 1);
            for (double value : {stress.axial, stress.shear_rs, stress.shear_tr, stress.plastic_strain}) {
                append_scientific(text, value, 15, 6);
            }
            text += '\n';
        }
    }
    return text;
}

std::vector<Index> spot_weld_beams(const Model& model)
{
    std::vector<Index> beams;
    for (std::size_t beam = 0; beam < model.beams.size(); ++beam) {
        const Index material = model.parts[model.beams.part[beam]].material;
        if (material != none && model.materials[material].keyword == "MAT_SPOTWELD") {
            beams.push_back(static_cast<Index>(beam));
        }
    }
    return beams;
}

SwforcRecorder::SwforcRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)),
      beams_(spot_weld_beams(model)),
      rows_(rows_of(beams_, model.beams.size())),
      failed_since_(beams_.size(), -1),
      file_(path)
{
    file_.write(ascii_heading(model));
}

void SwforcRecorder::write_state(const Snapshot& snapshot)
{
    ElementResults results;
    results.beam_rows = rows_;
    results.beams.resize(beams_.size());
    results.beam_deleted.resize(beams_.size());
    snapshot.collect(results);
    std::string text =
        "\n constraint #      axial        shear         time  failure                           "
        "            length  rslt moment      torsion\n";
    for (std::size_t row = 0; row < beams_.size(); ++row) {
        const auto& beam = results.beams[row];
        if (results.beam_deleted[row] && failed_since_[row] < 0) failed_since_[row] = snapshot.clock.time;
        fmt::format_to(std::back_inserter(text), "{:11}", row + 1);
        append_scientific(text, beam.axial, 13, 5);
        append_scientific(text, std::hypot(beam.shear_s, beam.shear_t), 13, 5);
        append_scientific(text, snapshot.clock.time, 13, 5);
        text += results.beam_deleted[row] ? "  1.00+00" : "  0.00+00";
        fmt::format_to(std::back_inserter(text), "    spotweld beam  ID{:11}",
                       snapshot.model.beams.id[beams_[row]]);
        append_scientific(text, beam.length, 13, 5);
        append_scientific(text, std::hypot(beam.moment_s, beam.moment_t), 13, 5);
        append_scientific(text, beam.torsion, 13, 5);
        if (results.beam_deleted[row]) {
            text += fmt::format("  failure time={:12.5E}", failed_since_[row]);
        }
        text += '\n';
    }
    file_.write(text);
    file_.flush();
}

} // namespace plash
