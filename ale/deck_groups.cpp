#include "ale/deck_groups.h"

#include "ale/gas_mixture.h"
#include "ale/mixture.h"
#include "materials/null_fluid.h"
#include "materials/parameters.h"
#include "model/eulerian.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace plash {

namespace {

bool is_vacuum(const Record& material)
{
    return material.keyword == "MAT_VACUUM" || material.keyword == "MAT_ALE_VACUUM";
}

/// *MAT_ALE_VISCOUS: *MAT_NULL with the viscosity under another name, as long as that is constant.
NullFluid viscous_fluid(const Record& record)
{
    if (record.real("MUHI") != 0 || record.real("MULO") < 0)
        reject_field(
            record, record.real("MUHI") != 0 ? "MUHI" : "MULO",
            "viscosity that depends on the rate of shear is not supported; there is a constant MULO");
    NullFluid fluid = NullFluid::from_record(record); // RO and PC
    fluid.viscosity = record.real("MULO");
    return fluid;
}

/// Energies of the laws stand by reference volume; E0 belongs to the density at the start.
template <class Law>
void set_law(DeckGroup& group, const Record& record, const NullFluid& fluid)
{
    const Law law = Law::from_record(record, fluid.density);
    group.law.law = law;
    group.density = fluid.density / law.relative_volume;
    group.energy_per_mass = law.energy / fluid.density;
}

/// Law and state at the start from a material and an equation of state.
/// number  of the group in the deck, from 1
void set_material(const Model& model, DeckGroup& group, std::size_t number, const Record& material,
                  const Record* equation_of_state, Location where)
{
    if (is_vacuum(material)) {
        material.real("RHO"); // nothing has no density: LS-DYNA does not use it either
        return;
    }
    if (material.keyword == "MAT_ALE_GAS_MIXTURE") {
        set_gas_mixture(group, material, model, static_cast<Id>(number));
        return;
    }
    const bool viscous = material.keyword == "MAT_ALE_VISCOUS";
    if (material.keyword != "MAT_NULL" && !viscous) {
        throw DeckError(material.where,
                        fmt::format("*{} {} is not supported in an Eulerian mesh (group '{}'); there are "
                                    "*MAT_NULL, *MAT_ALE_VISCOUS, *MAT_ALE_GAS_MIXTURE and *MAT_VACUUM",
                                    material.keyword, material.id, group.name));
    }
    if (!equation_of_state) {
        throw DeckError(where, fmt::format("the fluid '{}' has *{} {} but no equation of state", group.name,
                                           material.keyword, material.id));
    }
    const NullFluid fluid = viscous ? viscous_fluid(material) : NullFluid::from_record(material);
    group.fluid = 0; // numbered later
    group.law.reference_density = fluid.density;
    group.law.viscosity = fluid.viscosity;
    group.law.tension_limit = std::max(fluid.lowest_pressure, -1e300);
    if (equation_of_state->keyword == "EOS_GRUNEISEN") {
        set_law<Gruneisen>(group, *equation_of_state, fluid);
    } else if (equation_of_state->keyword == "EOS_LINEAR_POLYNOMIAL") {
        set_law<LinearPolynomial>(group, *equation_of_state, fluid);
    } else if (equation_of_state->keyword == "EOS_MURNAGHAN") {
        set_law<Murnaghan>(group, *equation_of_state, fluid);
    } else {
        throw DeckError(equation_of_state->where,
                        fmt::format("*{} {} is not supported in an Eulerian mesh (group '{}'); there are "
                                    "*EOS_GRUNEISEN, *EOS_LINEAR_POLYNOMIAL and *EOS_MURNAGHAN",
                                    equation_of_state->keyword, equation_of_state->id, group.name));
    }
}

void set_material_of_part(const Model& model, DeckGroup& group, std::size_t number)
{
    const Part& part = model.parts[group.parts.front()];
    if (part.material == none)
        throw DeckError(part.where,
                        fmt::format("*PART {} is in an Eulerian group but has no material", part.id));
    const Record* equation_of_state =
        part.equation_of_state == none ? nullptr : &model.equations_of_state[part.equation_of_state];
    set_material(model, group, number, model.materials[part.material], equation_of_state, part.where);
}

template <class Records>
const Record* find_record(const Records& records, Id id)
{
    const auto found =
        std::find_if(records.begin(), records.end(), [&](const Record& record) { return record.id == id; });
    return found == records.end() ? nullptr : &*found;
}

/// *ALE_MULTI-MATERIAL_GROUP and *ALE_STRUCTURED_MULTI-MATERIAL_GROUP, in deck order.
void add_multi_material_groups(const Model& model, std::vector<DeckGroup>& groups)
{
    for (const Record& record : model.others) {
        DeckGroup group;
        if (record.keyword == "ALE_MULTI-MATERIAL_GROUP") {
            group.parts = parts_of_fields(model, record, "SID", "IDTYPE");
            group.name = record.text("GPNAME");
        } else if (record.keyword == "ALE_MULTI-MATERIAL_GROUP_SET") {
            group.parts = parts_of_fields(model, record, "PSID", "");
        } else if (record.keyword == "ALE_MULTI-MATERIAL_GROUP_PART") {
            const Index part = find_part(model, record.integer("PID"));
            if (part != none) group.parts = {part};
        } else if (record.keyword == "ALE_STRUCTURED_MULTI-MATERIAL_GROUP") {
            group.name = record.text("AMMGNM");
            const Record* material = find_record(model.materials, record.integer("MID"));
            if (!material)
                throw DeckError(record.where, fmt::format("*{}, field MID: there is no material {}",
                                                          record.keyword, record.integer("MID")));
            const Record* law = find_record(model.equations_of_state, record.integer("EOSID"));
            set_material(model, group, groups.size() + 1, *material, law, record.where);
            groups.push_back(std::move(group));
            continue;
        } else {
            continue;
        }
        if (group.parts.empty())
            throw DeckError(record.where, fmt::format("*{}: the group has no part", record.keyword));
        if (group.name.empty()) group.name = model.parts[group.parts.front()].title;
        set_material_of_part(model, group, groups.size() + 1);
        groups.push_back(std::move(group));
    }
}

/// Without groups in the deck, parts of one material and equation of state are one group.
void add_single_material_groups(const Model& model, DeckGroups& result)
{
    for (std::size_t index = 0; index < model.parts.size(); ++index) {
        const Part& part = model.parts[index];
        if (!is_eulerian(model, static_cast<Index>(index))) continue;
        const Id formulation = model.sections[part.section].integer("ELFORM");
        if (formulation == 11) {
            throw DeckError(part.where, fmt::format("*PART {} has ELFORM = 11, but the deck has no "
                                                    "*ALE_MULTI-MATERIAL_GROUP",
                                                    part.id));
        }
        result.void_allowed = result.void_allowed || formulation == 12;
        const auto same = [&](const DeckGroup& group) {
            const Part& other = model.parts[group.parts.front()];
            return other.material == part.material && other.equation_of_state == part.equation_of_state;
        };
        const auto found = std::find_if(result.groups.begin(), result.groups.end(), same);
        if (found != result.groups.end()) {
            found->parts.push_back(static_cast<Index>(index));
            continue;
        }
        if (!result.groups.empty()) {
            throw DeckError(part.where,
                            fmt::format("*PART {} has another material than part {}; several materials in "
                                        "an Eulerian mesh need ELFORM = 11 and *ALE_MULTI-MATERIAL_GROUP",
                                        part.id, model.parts[result.groups.front().parts.front()].id));
        }
        DeckGroup group;
        group.name = part.title;
        group.parts = {static_cast<Index>(index)};
        set_material_of_part(model, group, 1);
        result.groups.push_back(std::move(group));
    }
}

} // namespace

std::vector<FluidGroup> DeckGroups::fluids() const
{
    std::vector<FluidGroup> result;
    for (const DeckGroup& group : groups)
        if (group.fluid != none) result.push_back(group.law);
    return result;
}

int DeckGroups::group_of_part(Index part) const
{
    for (std::size_t i = 0; i < groups.size(); ++i)
        if (std::find(groups[i].parts.begin(), groups[i].parts.end(), part) != groups[i].parts.end())
            return static_cast<int>(i);
    return none;
}

int DeckGroups::vacuum() const
{
    for (std::size_t i = 0; i < groups.size(); ++i)
        if (groups[i].fluid == none) return static_cast<int>(i);
    return none;
}

unsigned fluids_of_set(const Model& model, const Record& record, const std::string& field, Id id,
                       const DeckGroups& groups)
{
    const auto group_at = [&](const Table& table, std::size_t row) -> const DeckGroup* {
        const Id number =
            table.text.empty() ? std::llround(table.at(row, 0)) : std::atol(table.text[row].c_str());
        if (number > 0 && number <= static_cast<Id>(groups.groups.size())) return &groups.groups[number - 1];
        for (const DeckGroup& group : groups.groups)
            if (!table.text.empty() && group.name == table.text[row]) return &group;
        return nullptr;
    };
    for (const Record& set : model.others) {
        if (!set.keyword.starts_with("SET_MULTI") || set.id != id) continue;
        unsigned mask = 0;
        const Table* table = set.table("AMMGID");
        for (std::size_t row = 0; table && row < table->rows(); ++row) {
            const std::string name =
                table->text.empty() ? fmt::format("{:g}", table->at(row, 0)) : table->text[row];
            if (name.empty() || name == "0") continue;
            const DeckGroup* group = group_at(*table, row);
            if (!group)
                throw DeckError(set.where,
                                fmt::format("*{} {}: there is no group {}", set.keyword, id, name));
            if (group->fluid != none) mask |= 1u << group->fluid;
        }
        return mask;
    }
    reject_field(record, field, fmt::format("there is no *SET_MULTI-MATERIAL_GROUP_LIST {}", id));
}

DeckGroups deck_groups_of(const Model& model)
{
    DeckGroups result;
    add_multi_material_groups(model, result.groups);
    if (result.groups.empty()) add_single_material_groups(model, result);
    int fluids = 0;
    for (DeckGroup& group : result.groups) {
        if (group.fluid == none)
            result.void_allowed = true;
        else
            group.fluid = fluids++;
    }
    if (fluids == 0)
        throw DeckError({}, "the Eulerian mesh of the deck has no fluid: all its groups are *MAT_VACUUM");
    if (fluids > most_groups)
        throw DeckError({}, fmt::format("the deck has {} groups of fluids in its Eulerian mesh; there can "
                                        "be {}",
                                        fluids, most_groups));
    return result;
}

} // namespace plash
