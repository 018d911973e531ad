#include "elements/beam_groups.h"

#include "elements/discrete_beams.h"
#include "materials/parameters.h"

#include <fmt/format.h>
#include <utility>

namespace plash {

namespace {

constexpr std::pair<std::string_view, BeamGroupMaker*> beam_makers[] = {
    {"MAT_ELASTIC", make_elastic_beams},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", make_piecewise_linear_beams},
    {"MAT_ISOTROPIC_ELASTIC_PLASTIC", make_piecewise_linear_beams},
    {"MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY", make_piecewise_linear_beams},
    {"MAT_POWER_LAW_PLASTICITY", make_piecewise_linear_beams},
    {"MAT_SIMPLIFIED_JOHNSON_COOK", make_piecewise_linear_beams},
    {"MAT_PLASTIC_KINEMATIC", make_plastic_kinematic_beams},
    {"MAT_SPOTWELD", make_spot_weld_beams},
};

bool is_discrete(const Model& model, const Part& part)
{
    return part.section != none && model.sections[part.section].keyword == "SECTION_BEAM" &&
           model.sections[part.section].integer("ELFORM", 1) == 6;
}

void add_group(const BeamPart& beams, State& state, std::vector<std::unique_ptr<Term>>& groups)
{
    const Part& part = beams.model.parts[beams.part];
    if (part.material == none) {
        throw DeckError(part.where, fmt::format("*PART {} has beams but no material", part.id));
    }
    const Record& material = beams.model.materials[part.material];
    if (beams.model.is_rigid(beams.part)) return;
    if (is_discrete(beams.model, part)) {
        groups.push_back(std::make_unique<DiscreteBeams>(beams, state));
        return;
    }
    if (material.keyword == "MAT_NULL") return add_beam_masses(beams, state);
    BeamSettings settings;
    settings.section = beam_section(beams.model, part);
    for (const auto& [keyword, maker] : beam_makers) {
        if (material.keyword != keyword) continue;
        if (settings.section.formulation != 3) state.need_rotation();
        groups.push_back(maker(beams, std::move(settings), state));
        return;
    }
    throw DeckError(material.where,
                    fmt::format("*{} is not supported for beams (part {})", material.keyword, part.id));
}

} // namespace

void add_beam_masses(const BeamPart& beams, State& state)
{
    const Model& model = beams.model;
    const Part& part = model.parts[beams.part];
    const double density = positive(model.materials[part.material], "RO", "mass density");
    const auto add = [&](Index element, double mass_of_end) {
        for (int end = 0; end < 2; ++end) state.mass[model.beams.nodes[element][end]] += mass_of_end;
    };
    if (is_discrete(model, part)) {
        const double volume = discrete_beam_volume(model.sections[part.section]);
        for (Index element : beams.elements) add(element, 0.5 * density * volume);
        return;
    }
    const BeamSection section = beam_section(model, part);
    for (Index element : beams.elements) {
        const auto& nodes = model.beams.nodes[element];
        const double length = norm(model.nodes.position[nodes[1]] - model.nodes.position[nodes[0]]);
        add(element, beam_mass(section, density, length, 0, 1).mass);
    }
}

std::vector<std::unique_ptr<Term>> make_beam_groups(const Model& model, State& state)
{
    std::vector<std::vector<Index>> elements(model.parts.size());
    for (Index element = 0; element < static_cast<Index>(model.beams.size()); ++element) {
        elements[model.beams.part[element]].push_back(element);
    }
    std::vector<std::unique_ptr<Term>> groups;
    for (Index part = 0; part < static_cast<Index>(model.parts.size()); ++part) {
        if (!elements[part].empty()) add_group({model, part, std::move(elements[part])}, state, groups);
    }
    return groups;
}

} // namespace plash
