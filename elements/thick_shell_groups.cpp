#include "elements/thick_shell_groups.h"

#include "elements/thick_shell_settings.h"

#include <fmt/format.h>
#include <map>

namespace plash {

namespace {

constexpr std::pair<std::string_view, ThickShellMaker*> thick_shell_makers[] = {
    {"MAT_ELASTIC", make_elastic_thick_shells},
    {"MAT_PLASTIC_KINEMATIC", make_plastic_kinematic_thick_shells},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", make_piecewise_linear_thick_shells},
    {"MAT_ISOTROPIC_ELASTIC_PLASTIC", make_piecewise_linear_thick_shells},
    {"MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY", make_piecewise_linear_thick_shells},
    {"MAT_POWER_LAW_PLASTICITY", make_piecewise_linear_thick_shells},
    {"MAT_SIMPLIFIED_JOHNSON_COOK", make_piecewise_linear_thick_shells},
    {"MAT_JOHNSON_COOK", make_johnson_cook_thick_shells},
    {"MAT_PLASTICITY_WITH_DAMAGE", make_damaged_plasticity_thick_shells},
    {"MAT_PLASTICITY_COMPRESSION_TENSION", make_compression_tension_thick_shells},
    {"MAT_CRUSHABLE_FOAM", make_crushable_foam_thick_shells},
};

constexpr std::string_view laminate_keywords[] = {"MAT_ORTHOTROPIC_ELASTIC", "MAT_COMPOSITE_DAMAGE",
                                                  "MAT_ENHANCED_COMPOSITE_DAMAGE",
                                                  "MAT_LAMINATED_COMPOSITE_FABRIC"};

/// The group of elements with one sequence of plies.
std::unique_ptr<SolidGroup> make_thick_shell_group(SolidSetup setup, bool plies, State& state)
{
    const Model& model = setup.model;
    const Part& part = model.parts[setup.part];
    if (plies) return make_laminate_thick_shells(std::move(setup), state);
    if (part.material == none)
        throw DeckError(part.where, fmt::format("*PART {} has thick shells but no material", part.id));
    const Record& material = model.materials[part.material];
    for (std::string_view keyword : laminate_keywords) {
        if (material.keyword == keyword) return make_laminate_thick_shells(std::move(setup), state);
    }
    for (const auto& [keyword, maker] : thick_shell_makers) {
        if (material.keyword == keyword) return maker(material, std::move(setup), state);
    }
    std::string known;
    for (const auto& [keyword, maker] : thick_shell_makers) known += fmt::format("{}, ", keyword);
    throw DeckError(material.where,
                    fmt::format("*{} {} is not supported for the thick shells of part {}; they have {}{}",
                                material.keyword, material.id, part.id, known,
                                fmt::join(laminate_keywords, ", ")));
}

} // namespace

std::vector<std::unique_ptr<SolidGroup>> make_thick_shell_groups(const Model& model, State& state)
{
    const ThickShellElements& shells = model.thick_shells;
    std::vector<std::vector<Index>> elements(model.parts.size());
    for (std::size_t element = 0; element < shells.size(); ++element)
        elements[shells.part[element]].push_back(static_cast<Index>(element));
    const InitialStresses initial_stresses =
        shells.size() > 0 ? initial_thick_shell_stresses(model) : InitialStresses{};
    const InitialStresses initial_strains =
        shells.size() > 0 ? initial_thick_shell_strains(model) : InitialStresses{};
    std::vector<std::unique_ptr<SolidGroup>> groups;
    for (Index part = 0; part < static_cast<Index>(model.parts.size()); ++part) {
        if (elements[part].empty() || model.is_rigid(part)) continue;
        std::map<std::vector<Index>, std::vector<Index>> by_plies;
        for (Index element : elements[part]) {
            std::vector<Index> materials;
            for (const Layer& layer : thick_shell_layers(model, element)) materials.push_back(layer.material);
            by_plies[std::move(materials)].push_back(element);
        }
        for (auto& [plies, members] : by_plies) {
            SolidSetup setup{model, part, std::move(members)};
            setup.thick_shells = true;
            setup.initial_stresses = &initial_stresses;
            setup.initial_strains = &initial_strains;
            setup.connectivity.reserve(8 * setup.elements.size());
            for (Index element : setup.elements) {
                const auto& nodes = shells.nodes[element];
                setup.connectivity.insert(setup.connectivity.end(), nodes.begin(), nodes.end());
            }
            setup.erode_inverted =
                model.controls.time.erode_small_step && model.controls.time.smallest_step_factor != 0;
            groups.push_back(make_thick_shell_group(std::move(setup), !plies.empty(), state));
        }
    }
    return groups;
}

} // namespace plash
