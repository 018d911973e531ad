#include "output/disbout.h"

#include "output/ascii_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace plash {

namespace {

void append_row(std::string& text, std::initializer_list<double> values)
{
    text += "           ";
    for (double value : values) append_scientific(text, value, 11, 3);
    text += '\n';
}

void append_beam(std::string& text, const Model& model, const ElementResults::DiscreteBeam& state)
{
    const Part& part = model.parts[model.beams.part[state.beam]];
    fmt::format_to(std::back_inserter(text),
                   " beam/truss # ={:8}      part ID  ={:10}      material type={:8}\n",
                   model.beams.id[state.beam], part.id, discrete_material_type(model, state.beam));
    const auto& way = state.way;
    const auto& force = state.resultant;
    text += " relative displ. axial   normal-s   normal-t  axial rot rotation-s rotation-t\n";
    append_row(text, {way[0], way[1], way[2], way[3], way[4], way[5]});
    text += " local resultant axial   normal-s   normal-t    torsion   moment-s  moment-t\n";
    append_row(text, {force[0], force[1], force[2], force[3], force[4], force[5]});
    constexpr std::string_view names[] = {" axial direction", " s direction    ", " t direction    "};
    for (int axis = 0; axis < 3; ++axis) {
        text += names[axis];
        text += "     x          y          z\n";
        append_row(text, {state.axes[axis].x, state.axes[axis].y, state.axes[axis].z});
    }
    text += '\n';
}

} // namespace

std::vector<Index> shown_discrete_beams(const Model& model)
{
    std::vector<bool> wanted(model.beams.size());
    for (Index beam : model.controls.output.history_beams) wanted[beam] = true;
    std::vector<Index> all, chosen;
    for (std::size_t beam = 0; beam < model.beams.size(); ++beam) {
        const Index section = model.parts[model.beams.part[beam]].section;
        if (section == none || model.sections[section].integer("ELFORM", 1) != 6) continue;
        all.push_back(static_cast<Index>(beam));
        if (wanted[beam]) chosen.push_back(static_cast<Index>(beam));
    }
    return chosen.empty() ? all : chosen;
}

int discrete_material_type(const Model& model, Index beam)
{
    constexpr std::pair<std::string_view, int> types[] = {
        {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM", 66},
        {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", 67},
        {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", 68},
        {"MAT_HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM", 70},
        {"MAT_CABLE_DISCRETE_BEAM", 71},
        {"MAT_ELASTIC_SPRING_DISCRETE_BEAM", 74},
        {"MAT_ELASTIC_6DOF_SPRING_DISCRETE_BEAM", 93},
        {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", 94},
        {"MAT_INELASTIC_6DOF_SPRING_DISCRETE_BEAM", 95},
        {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", 119},
        {"MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM", 121},
    };
    const Index material = model.parts[model.beams.part[beam]].material;
    if (material == none) return 0;
    for (const auto& [keyword, type] : types) {
        if (model.materials[material].keyword == keyword) return type;
    }
    return 0;
}

std::vector<ElementResults::DiscreteBeam> discrete_beam_states(const Snapshot& snapshot,
                                                               const std::vector<Index>& beams)
{
    ElementResults results;
    results.springs_wanted = true;
    snapshot.collect(results);
    auto& states = results.discrete_beams;
    std::erase_if(states, [&](const auto& state) {
        return !std::binary_search(beams.begin(), beams.end(), state.beam);
    });
    std::sort(states.begin(), states.end(), [](const auto& a, const auto& b) { return a.beam < b.beam; });
    return states;
}

DisboutRecorder::DisboutRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), beams_(shown_discrete_beams(model)), file_(path)
{
    file_.write(ascii_heading(model) + "\n");
}

void DisboutRecorder::write_state(const Snapshot& snapshot)
{
    std::string text = fmt::format("\n d i s c r e t e  b e a m  o u t p u t  f o r   t i m e  s t e p{:9}   "
                                   "( at time",
                                   snapshot.clock.cycle + 1);
    append_scientific(text, snapshot.clock.time, 12, 5);
    text += " )\n\n";
    for (const auto& state : discrete_beam_states(snapshot, beams_)) append_beam(text, snapshot.model, state);
    file_.write(text);
    file_.flush();
}

} // namespace plash
