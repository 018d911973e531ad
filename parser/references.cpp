#include "parser/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plash {
namespace {

bool exists(Reading& reading, Kind kind, Id id)
{
    if (reading.table(kind).contains(id)) return true;
    if (kind == Kind::thermal_material) return true; // nobody looks for it without a thermal analysis
    if (kind == Kind::part) return reading.table(Kind::rigid_body).contains(id);
    return kind == Kind::curve &&
           (reading.table(Kind::table).contains(id) || reading.table(Kind::function).contains(id));
}

std::vector<bool> parts_with_elements(const Model& model)
{
    std::vector<bool> used(model.parts.size());
    for_each_topology(model, [&](const auto& elements) {
        for (Index part : elements.part) used[part] = true;
    });
    for (Index part : model.particles.part) used[part] = true;
    return used;
}

std::vector<bool> nodes_with_elements(const Model& model)
{
    std::vector<bool> used(model.nodes.size());
    for_each_topology(model, [&](const auto& elements) {
        for (const auto& nodes : elements.nodes)
            for (Index node : nodes)
                if (node != none) used[node] = true;
    });
    for (const auto& nodes : model.shells.mid_nodes)
        for (Index node : nodes)
            if (node != none) used[node] = true;
    for (Index node : model.particles.node) used[node] = true;
    for (Index node : model.masses.node) used[node] = true;
    return used;
}

/// What a definition takes a curve to be, when some include has other units than the deck.
void note_curve(const Record& record, const FieldLayout& field, Id id, Reading& reading)
{
    const auto& transforms = reading.deck.transforms;
    if (std::none_of(transforms.begin(), transforms.end(),
                     [](const auto& transform) { return transform->units.change(); }))
        return;
    const auto value = [&](std::string_view name) {
        const Record::Field* found = record.peek(name);
        return found && std::abs(found->value) < 100 ? static_cast<int>(found->value) : 0;
    };
    const int freedom = std::abs(value("DOF"));
    const bool rotation = freedom >= 5 && freedom <= 11;
    reading.curve_uses[id].push_back(
        {record.keyword, field.name,
         curve_dimensions_of(record.keyword, field.name, value("VAD"), rotation)});
}

} // namespace

void References::collect(const Record& record, const KeywordLayout& layout, Reading& reading)
{
    if (layout.name.starts_with("SET_")) return;
    for (const CardLayout& card : layout.cards) collect(record, layout, card, reading);
}

void References::collect(const Record& record, const KeywordLayout& layout, const CardLayout& card,
                         Reading& reading)
{
    const auto add = [&](const FieldLayout& field, double value, Location where) {
        if (value == 0) return;
        // Minus the number of a curve stands for the same curve, used in another way.
        reading.use(field.kind, static_cast<Id>(std::abs(value)));
        if (field.kind == Kind::curve) note_curve(record, field, static_cast<Id>(std::abs(value)), reading);
        if (value > 0) references_.push_back({field.kind, static_cast<Id>(value), where, &layout, &field});
    };
    for (const FieldLayout& field : card.fields) {
        if (field.kind == Kind::none || field.defines) continue;
        if (card.repeat == CardLayout::Repeat::once) {
            if (const Record::Field* found = record.peek(field.name)) add(field, found->value, found->where);
            continue;
        }
        for (const Table& table : record.tables) {
            for (std::size_t column = 0; column < table.columns.size(); ++column) {
                if (table.columns[column] != field.name) continue;
                for (std::size_t row = 0; row < table.rows(); ++row)
                    add(field, table.at(row, column), {record.where.file, table.lines[row]});
            }
        }
    }
    for (const CardLayout& inner : card.group) collect(record, layout, inner, reading);
}

void References::check(Reading& reading) const
{
    for (const Reference& reference : references_) {
        if (exists(reading, reference.kind, reference.id)) continue;
        reading.report.error(reference.where, reference.layout->name, reference.field->name,
                             fmt::format("there is no {} {}", to_string(reference.kind), reference.id));
    }
}

void count_unused(Reading& reading)
{
    const Model& model = reading.model;
    const auto add = [&](std::string_view what, long count, Id first) {
        if (count > 0) reading.report.unused.push_back({std::string(what), count, first});
    };
    const auto count = [&](Kind kind, std::string_view what, const auto& list) {
        long number = 0;
        Id first = 0;
        for (const auto& entry : list) {
            if (entry.id == 0 || reading.is_used(kind, entry.id)) continue;
            if (number++ == 0) first = entry.id;
        }
        add(what, number, first);
    };
    const auto count_false = [&](std::string_view what, const std::vector<bool>& used, const auto& id_of) {
        const auto first = std::find(used.begin(), used.end(), false);
        if (first != used.end())
            add(what, std::count(first, used.end(), false),
                id_of(static_cast<std::size_t>(first - used.begin())));
    };
    count_false("nodes without elements", nodes_with_elements(model),
                [&](std::size_t index) { return model.nodes.id[index]; });
    count_false("parts without elements", parts_with_elements(model),
                [&](std::size_t index) { return model.parts[index].id; });
    count(Kind::section, "sections", model.sections);
    count(Kind::material, "materials", model.materials);
    count(Kind::eos, "equations of state", model.equations_of_state);
    count(Kind::hourglass, "hourglass controls", model.hourglass);
    count(Kind::curve, "curves", model.curves);
    count(Kind::table, "tables", model.tables);
    count(Kind::coordinate, "coordinate systems", model.coordinate_systems);
    count(Kind::vector, "vectors", model.vectors);
    count(Kind::box, "boxes", model.boxes);
    count(Kind::node_set, "node sets", model.node_sets);
    count(Kind::segment_set, "segment sets", model.segment_sets);
    count(Kind::part_set, "part sets", model.part_sets);
    count(Kind::shell_set, "shell sets", model.shell_sets);
    count(Kind::solid_set, "solid sets", model.solid_sets);
    count(Kind::beam_set, "beam sets", model.beam_sets);
    count(Kind::tshell_set, "thick shell sets", model.thick_shell_sets);
    count(Kind::discrete_set, "discrete sets", model.discrete_sets);
}

} // namespace plash
