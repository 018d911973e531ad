#include "model/eulerian.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

bool is_eulerian(const Model& model, Index part)
{
    const Index section = model.parts[part].section;
    if (section == none) return false;
    const Record& record = model.sections[section];
    if (record.keyword != "SECTION_SOLID" && record.keyword != "SECTION_SOLID_ALE") return false;
    const Id formulation = record.integer("ELFORM");
    return (formulation >= 5 && formulation <= 7) || formulation == 11 || formulation == 12;
}

bool has_eulerian_mesh(const Model& model)
{
    if (model.solids.size() == 0) return false;
    std::vector<bool> eulerian(model.parts.size());
    for (std::size_t part = 0; part < eulerian.size(); ++part)
        eulerian[part] = is_eulerian(model, static_cast<Index>(part));
    return std::any_of(model.solids.part.begin(), model.solids.part.end(),
                       [&](Index part) { return eulerian[part]; });
}

std::size_t multi_material_groups(const Model& model)
{
    const auto groups = std::count_if(model.others.begin(), model.others.end(), [](const Record& record) {
        return record.keyword.starts_with("ALE_MULTI-MATERIAL_GROUP") ||
               record.keyword.starts_with("ALE_STRUCTURED_MULTI-MATERIAL_GROUP");
    });
    return std::max<std::size_t>(groups, 1);
}

Index find_part(const Model& model, Id id)
{
    for (std::size_t part = 0; part < model.parts.size(); ++part)
        if (model.parts[part].id == id) return static_cast<Index>(part);
    return none;
}

const PartSet* find_part_set(const Model& model, Id id)
{
    for (const PartSet& set : model.part_sets)
        if (set.id == id) return &set;
    return nullptr;
}

std::vector<Index> parts_of_fields(const Model& model, const Record& record, std::string_view id_field,
                                   std::string_view type_field)
{
    const Id id = record.integer(id_field), type = type_field.empty() ? 0 : record.integer(type_field);
    if (type == 0) {
        if (const PartSet* set = find_part_set(model, id)) return set->parts;
        throw DeckError(record.where,
                        fmt::format("*{}, field {}: there is no part set {}", record.keyword, id_field, id));
    }
    if (type != 1) {
        throw DeckError(record.where, fmt::format("*{}, field {}: {} is not one of 0 part set, 1 part",
                                                  record.keyword, type_field, type));
    }
    const Index part = find_part(model, id);
    if (part != none) return {part};
    throw DeckError(record.where,
                    fmt::format("*{}, field {}: there is no part {}", record.keyword, id_field, id));
}

} // namespace plash
