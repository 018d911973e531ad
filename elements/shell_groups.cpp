#include "elements/shell_groups.h"

#include "elements/shell_group_makers.h"
#include "elements/shell_mass.h"
#include "materials/parameters.h"

#include <array>
#include <fmt/format.h>
#include <utility>

namespace plash {

namespace {

constexpr std::pair<std::string_view, ShellGroupMaker*> makers[] = {
    {"MAT_ELASTIC", make_elastic_shells},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", make_piecewise_linear_shells},
    {"MAT_PLASTIC_KINEMATIC", make_plastic_kinematic_shells},
};

/// Who makes the group of a part; null for a rigid part.
ShellGroupMaker* maker_of(const Model& model, Index part_index)
{
    const Part& part = model.parts[part_index];
    if (part.material == none) {
        throw DeckError(part.where, fmt::format("*PART {} has shells but no material", part.id));
    }
    const Record& material = model.materials[part.material];
    if (model.is_rigid(part_index)) return nullptr;
    for (const auto& [keyword, maker] : makers) {
        if (material.keyword == keyword) return maker;
    }
    throw DeckError(material.where,
                    fmt::format("*{} is not supported for shells (part {})", material.keyword, part.id));
}

/// Elements that no shell theory can work with: no thickness or no area.
void check_element(const Model& model, Index element)
{
    const ShellMass start = shell_mass(model, element);
    const Part& part = model.parts[model.shells.part[element]];
    if (!(start.thickness > 0)) {
        throw DeckError(model.sections[part.section].where,
                        fmt::format("shell {} of part {} has no thickness (T1 of *{}, or "
                                    "*ELEMENT_SHELL_THICKNESS)",
                                    model.shells.id[element], part.id, model.sections[part.section].keyword));
    }
    if (!(start.area > 0)) {
        throw DeckError(part.where, fmt::format("shell {} of part {} has no area: its corners lie on a line",
                                                model.shells.id[element], part.id));
    }
}

/// Formulation that the section of a part asks for.
ShellFormulation formulation_of(const Model& model, const Part& part)
{
    if (part.section == none) {
        throw DeckError(part.where, fmt::format("*PART {} has shells but no *SECTION_SHELL", part.id));
    }
    const Record& section = model.sections[part.section];
    const Id given = section.integer("ELFORM");
    switch (given == 0 ? model.controls.elements.shell_theory : given) {
    case 2:
        return ShellFormulation::belytschko_tsay;
    case 4:
        return ShellFormulation::triangle;
    case 16:
        return ShellFormulation::fully_integrated;
    }
    reject_field(section, "ELFORM",
                 fmt::format("shell formulation {} is not supported (2: Belytschko-Tsay, 4: C0 triangle, 16: "
                             "fully integrated)",
                             given));
}

/// Adds the groups of a part: one of quadrilaterals, and one of triangles when they are sorted out (ESORT) or
/// the section is one of triangles.
void add_groups(ShellGroupMaker* maker, const ShellPart& all, State& state,
                std::vector<std::unique_ptr<Term>>& groups)
{
    const Model& model = all.model;
    const Part& part = model.parts[all.part];
    const ShellFormulation formulation = formulation_of(model, part);
    const bool sorted =
        formulation == ShellFormulation::triangle || model.controls.elements.sort_triangles > 0;
    ShellPart quadrilaterals{model, all.part, {}}, triangles{model, all.part, {}};
    for (Index element : all.elements) {
        check_element(model, element);
        const std::array<Index, 4> nodes = shell_corners(model, element);
        const bool triangle = nodes[2] == nodes[3];
        if (!triangle && formulation == ShellFormulation::triangle) {
            reject_field(
                model.sections[part.section], "ELFORM",
                fmt::format("formulation 4 is for triangles, but shell {} of part {} has four corners",
                            model.shells.id[element], part.id));
        }
        (triangle && sorted ? triangles : quadrilaterals).elements.push_back(element);
    }
    if (!quadrilaterals.elements.empty()) groups.push_back(maker(quadrilaterals, formulation, state));
    if (!triangles.elements.empty()) groups.push_back(maker(triangles, ShellFormulation::triangle, state));
}

} // namespace

std::vector<std::unique_ptr<Term>> make_shell_groups(const Model& model, State& state)
{
    std::vector<std::vector<Index>> elements(model.parts.size());
    for (Index element = 0; element < static_cast<Index>(model.shells.size()); ++element) {
        elements[model.shells.part[element]].push_back(element);
    }
    std::vector<std::unique_ptr<Term>> groups;
    for (Index part = 0; part < static_cast<Index>(model.parts.size()); ++part) {
        if (elements[part].empty()) continue;
        ShellGroupMaker* maker = maker_of(model, part);
        if (!maker) continue;
        state.need_rotation();
        add_groups(maker, {model, part, std::move(elements[part])}, state, groups);
    }
    return groups;
}

} // namespace plash
