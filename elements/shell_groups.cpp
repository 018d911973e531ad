#include "elements/shell_groups.h"

#include "elements/shell_group_makers.h"
#include "elements/shell_mass.h"
#include "elements/shell_settings.h"
#include "materials/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace plash {

namespace {

constexpr std::pair<std::string_view, ShellGroupMaker*> makers[] = {
    {"MAT_COMPOSITE_DAMAGE", make_laminate_shells},
    {"MAT_ELASTIC", make_elastic_shells},
    {"MAT_ENHANCED_COMPOSITE_DAMAGE", make_laminate_shells},
    {"MAT_FABRIC", make_laminate_shells},
    {"MAT_HILL_3R", make_laminate_shells},
    {"MAT_JOHNSON_COOK", make_johnson_cook_shells},
    {"MAT_LAMINATED_COMPOSITE_FABRIC", make_laminate_shells},
    {"MAT_ORTHOTROPIC_ELASTIC", make_laminate_shells},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", make_piecewise_linear_shells},
    {"MAT_ISOTROPIC_ELASTIC_PLASTIC", make_piecewise_linear_shells},
    {"MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY", make_piecewise_linear_shells},
    {"MAT_POWER_LAW_PLASTICITY", make_piecewise_linear_shells},
    {"MAT_SIMPLIFIED_JOHNSON_COOK", make_piecewise_linear_shells},
    {"MAT_PLASTIC_KINEMATIC", make_plastic_kinematic_shells},
    {"MAT_PLASTICITY_COMPRESSION_TENSION", make_compression_tension_shells},
    {"MAT_PLASTICITY_WITH_DAMAGE", make_damaged_plasticity_shells},
    {"MAT_TRANSVERSELY_ANISOTROPIC_ELASTIC_PLASTIC", make_laminate_shells},
};

/// Who makes the group of a part; null for a rigid part.
ShellGroupMaker* maker_of(const Model& model, Index part_index)
{
    const Part& part = model.parts[part_index];
    if (!part.layers.empty()) return make_laminate_shells;
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
void check_element(const Model& model, Index element, const ShellPlate& plate)
{
    const ShellMass start = shell_mass(model, element, plate);
    const Part& part = model.parts[model.shells.part[element]];
    const Record& section = shell_section(model, part);
    if (!(start.thickness > 0)) {
        throw DeckError(section.where, fmt::format("shell {} of part {} has no thickness (T1 of *{}, or "
                                                   "*ELEMENT_SHELL_THICKNESS)",
                                                   model.shells.id[element], part.id, section.keyword));
    }
    if (!(start.area > 0)) {
        throw DeckError(part.where, fmt::format("shell {} of part {} has no area: its corners lie on a line",
                                                model.shells.id[element], part.id));
    }
}

/// Formulation that the section of a part asks for.
ShellFormulation formulation_of(const Model& model, const Part& part)
{
    const Record& section = shell_section(model, part);
    const Id given = section.integer("ELFORM");
    switch (given == 0 ? model.controls.elements.shell_theory : given) {
    case 1:
    case 2:
    case 5:
    case 10:
    case 11:
        return ShellFormulation::belytschko_tsay;
    case 4:
        return ShellFormulation::triangle;
    case 6:
    case 7:
    case 9:
    case 16:
        return ShellFormulation::fully_integrated;
    }
    reject_field(
        section, "ELFORM",
        fmt::format("shell formulation {} is not supported (2: Belytschko-Tsay, 4: C0 triangle, 5 and "
                    "9: membranes, 10: Belytschko-Wong-Chiang, 16: fully integrated; 1 and 11 run as "
                    "10, 6 and 7 as 16)",
                    given));
}

/// *MAT_NULL: shells that only have mass, for contacts.
bool is_null(const Model& model, const Part& part)
{
    return part.material != none && model.materials[part.material].keyword == "MAT_NULL";
}

void add_null_masses(const Model& model, const std::vector<Index>& elements, State& state)
{
    if (elements.empty()) return;
    const ShellPlate plate = shell_plate(model, model.parts[model.shells.part[elements.front()]]);
    for (Index element : elements) {
        check_element(model, element, plate);
        const ShellMass share = shell_mass(model, element, plate);
        const std::array<Index, 4> nodes = shell_corners(model, element);
        for (int corner = 0; corner < 4; ++corner) state.mass[nodes[corner]] += share.corner_mass[corner];
    }
}

/// Materials of the plies of an element, from the bottom; empty without plies.
std::vector<Index> stack_of(const Model& model, Index element)
{
    std::vector<Index> stack;
    for (const Layer& layer : shell_layers(model, element)) stack.push_back(layer.material);
    return stack;
}

/// Elements of a part that can be one group: quadrilaterals or triangles, with the same stack of plies, or
/// with the same offset; those that are joined to no other shell by themselves.
struct GroupKey {
    bool triangle = false;
    std::vector<Index> stack;
    double offset_share = 0;
    bool alone = false;
    double stiffness_share = 1;

    auto operator<=>(const GroupKey&) const = default;
};

/// OFFSET of an element over half of its thickness, to seven digits, so that what is equal in the deck is
/// equal.
double offset_share(const Model& model, Index element)
{
    if (model.shells.offset.empty() || model.shells.offset[element] == 0) return 0;
    return std::round(2e7 * model.shells.offset[element] / shell_thickness(model, element)) / 1e7;
}

/// Which nodes have more than one shell.
std::vector<bool> shared_nodes(const Model& model)
{
    std::vector<bool> seen(model.nodes.size()), shared(model.nodes.size());
    for (Index element = 0; element < static_cast<Index>(model.shells.size()); ++element) {
        const std::array<Index, 4> nodes = shell_corners(model, element);
        const int corners = nodes[2] == nodes[3] ? 3 : 4;
        for (int corner = 0; corner < corners; ++corner) {
            if (seen[nodes[corner]]) shared[nodes[corner]] = true;
            seen[nodes[corner]] = true;
        }
    }
    return shared;
}

/// TSLIMT of *CONTROL_TIMESTEP: how much of Young's modulus the elements of a part keep so that TSSFAC times
/// their step is not below it at the start. Only laws of the manual's list soften. Shares go down in steps of
/// 5 %, so that elements of nearly one size make one group.
class Softening {
public:
    Softening(const Model& model, const State& state, Index part) : model_(model), state_(state)
    {
        constexpr std::string_view soften[] = {"MAT_PLASTIC_KINEMATIC", "MAT_POWER_LAW_PLASTICITY",
                                               "MAT_PIECEWISE_LINEAR_PLASTICITY"};
        const TimeControls& control = model.controls.time;
        if (!(control.shell_step > 0) || model.parts[part].material == none) return;
        const Record& material = model.materials[model.parts[part].material];
        if (std::find(std::begin(soften), std::end(soften), material.keyword) == std::end(soften)) return;
        const ShellSettings settings =
            shell_settings(model, part, material.real("RO"), material.real("E"), material.real("PR"));
        length_rule_ = settings.length_rule;
        wanted_length_ = control.shell_step / control.step_scale * settings.wave_speed;
    }

    double share(Index element) const
    {
        if (wanted_length_ == 0) return 1;
        const double share =
            squared_length_of(model_, state_, element, length_rule_) / (wanted_length_ * wanted_length_);
        if (share >= 1) return 1;
        const double ratio = std::log(0.95);
        return std::exp(ratio * std::ceil(std::log(share) / ratio));
    }

private:
    const Model& model_;
    const State& state_;
    int length_rule_ = 0;
    double wanted_length_ = 0; ///< [length]; 0: nothing softens
};

/// Adds the groups of a part: quadrilaterals, and triangles of their own when they are sorted out (ESORT) or
/// the section is one of triangles; elements with different stacks of plies make different groups.
void add_groups(ShellGroupMaker* maker, const ShellPart& all, const std::vector<bool>& shared, State& state,
                std::vector<std::unique_ptr<Term>>& groups)
{
    const Model& model = all.model;
    const Part& part = model.parts[all.part];
    const ShellFormulation formulation = formulation_of(model, part);
    const bool sorted =
        formulation == ShellFormulation::triangle || model.controls.elements.sort_triangles > 0;
    std::map<GroupKey, ShellPart> members;
    const ShellPlate plate = shell_plate(model, part);
    const Softening softening(model, state, all.part);
    for (Index element : all.elements) {
        check_element(model, element, plate);
        const std::array<Index, 4> nodes = shell_corners(model, element);
        const bool triangle = nodes[2] == nodes[3];
        if (!triangle && formulation == ShellFormulation::triangle) {
            reject_field(
                shell_section(model, part), "ELFORM",
                fmt::format("formulation 4 is for triangles, but shell {} of part {} has four corners",
                            model.shells.id[element], part.id));
        }
        GroupKey key{triangle && sorted, stack_of(model, element)};
        if (key.stack.empty() && maker != make_laminate_shells)
            key.offset_share = offset_share(model, element);
        key.alone = std::none_of(nodes.begin(), nodes.end(), [&](Index node) { return shared[node]; });
        if (key.stack.empty()) key.stiffness_share = softening.share(element);
        members
            .try_emplace(key, ShellPart{model,
                                        all.part,
                                        {},
                                        all.initial_stresses,
                                        all.initial_strains,
                                        key.offset_share,
                                        key.alone,
                                        key.stiffness_share})
            .first->second.elements.push_back(element);
    }
    for (const auto& [key, shells] : members) {
        ShellGroupMaker* make = key.stack.empty() ? maker : make_laminate_shells;
        groups.push_back(make(shells, key.triangle ? ShellFormulation::triangle : formulation, state));
    }
}

} // namespace

std::vector<std::unique_ptr<Term>> make_shell_groups(const Model& model, State& state)
{
    std::vector<std::vector<Index>> elements(model.parts.size());
    for (Index element = 0; element < static_cast<Index>(model.shells.size()); ++element) {
        elements[model.shells.part[element]].push_back(element);
    }
    const InitialStresses initial_stresses = initial_shell_stresses(model);
    const InitialStresses initial_strains = initial_shell_strains(model);
    const std::vector<bool> shared = shared_nodes(model);
    std::vector<std::unique_ptr<Term>> groups;
    for (Index part = 0; part < static_cast<Index>(model.parts.size()); ++part) {
        if (elements[part].empty()) continue;
        if (is_null(model, model.parts[part])) {
            add_null_masses(model, elements[part], state);
            continue;
        }
        ShellGroupMaker* maker = maker_of(model, part);
        if (!maker) continue;
        state.need_rotation();
        add_groups(maker, {model, part, std::move(elements[part]), &initial_stresses, &initial_strains},
                   shared, state, groups);
    }
    return groups;
}

} // namespace plash
