// *SET_..._GENERAL: lines of an option and up to seven numbers, each adding members or, with a D in front,
// taking some away; and segment sets, whose options make segments of shells and of the outside of solids.

#include "parser/outer_faces.h"
#include "parser/set_resolver.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace plash {
namespace {

/// Elements that an option names by number, and sets of them.
struct ElementOption {
    std::string_view element, set;
    Kind kind, set_kind;
};

constexpr ElementOption element_options[] = {
    {"SHELL", "SET_SHELL", Kind::shell, Kind::shell_set},
    {"SOLID", "SET_SOLID", Kind::solid, Kind::solid_set},
    {"BEAM", "SET_BEAM", Kind::beam, Kind::beam_set},
    {"TSHELL", "SET_TSHELL", Kind::tshell, Kind::tshell_set},
    {"DISC", "SET_DISC", Kind::discrete, Kind::discrete_set},
};

/// Segments of `kept` that `other` has as well, wherever each begins and whichever way it goes round.
void keep_common(const SetResolver::Segments& other, SetResolver::Segments& kept)
{
    const auto sorted = [](std::array<Index, 4> segment) {
        std::sort(segment.begin(), segment.end());
        return segment;
    };
    std::set<std::array<Index, 4>> known;
    for (const auto& segment : other) known.insert(sorted(segment));
    std::erase_if(kept, [&](const auto& segment) { return !known.contains(sorted(segment)); });
}

std::string_view option_of(const Table& table, std::size_t row)
{
    return table.text.empty() ? std::string_view() : std::string_view(table.text[row * table.columns.size()]);
}

} // namespace

template <class Visit>
void SetResolver::for_nodes(Kind element, Index position, Visit&& visit) const
{
    const auto all = [&](const auto& nodes) {
        for (Index node : nodes[position])
            if (node != none) visit(node);
    };
    switch (element) {
    case Kind::shell:
        all(model_.shells.nodes);
        break;
    case Kind::solid:
        all(model_.solids.nodes);
        if (const auto* nodes = ten_nodes(model_, position))
            std::for_each(nodes->begin(), nodes->end(), visit);
        break;
    case Kind::beam:
        all(model_.beams.nodes);
        break;
    case Kind::tshell:
        all(model_.thick_shells.nodes);
        break;
    case Kind::discrete:
        all(model_.discretes.nodes);
        break;
    default:
        visit(position);
        break;
    }
}

const std::vector<Index>& SetResolver::parts_of(Kind element) const
{
    switch (element) {
    case Kind::shell:
        return model_.shells.part;
    case Kind::solid:
        return model_.solids.part;
    case Kind::beam:
        return model_.beams.part;
    case Kind::tshell:
        return model_.thick_shells.part;
    default:
        return model_.discretes.part;
    }
}

void SetResolver::add_general(const Record& record, const Table& table, Kind set, Members& members)
{
    const Kind member = member_kind(set);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        std::string_view option = option_of(table, row);
        const bool removes = option.size() > 1 && option.front() == 'D' && !option.starts_with("DISC");
        if (removes) option.remove_prefix(1);
        Members found;
        bool known = true;
        if (option == "ALL" || option.empty()) {
            found.resize(count_of(member));
            std::iota(found.begin(), found.end(), 0);
        }
        for (std::size_t column = 1; known && column < table.columns.size(); ++column) {
            const Id id = static_cast<Id>(table.at(row, column));
            if (id != 0)
                known = general({record, table.lines[row], table.columns[column]}, option, member, id, found);
        }
        if (!known) {
            reading_.report.error({record.where.file, table.lines[row]}, record.keyword, "OPTION",
                                  fmt::format("set {}: the option '{}' is not supported", record.id, option));
            continue;
        }
        if (!removes) {
            members.insert(members.end(), found.begin(), found.end());
            continue;
        }
        std::sort(found.begin(), found.end());
        std::erase_if(members,
                      [&](Index index) { return std::binary_search(found.begin(), found.end(), index); });
    }
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
}

/// *SET_NODE_ADD_ADVANCED: nodes of sets of every type.
void SetResolver::add_advanced(const Record& record, const Table& table, Members& members)
{
    constexpr std::string_view options[] = {"SET_NODE", "SET_SHELL", "SET_BEAM",  "SET_SOLID",
                                            "SET_SEG",  "SET_DISC",  "SET_TSHELL"};
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const Row at{record, table.lines[row], table.columns.front()};
        const Id id = static_cast<Id>(table.at(row, 0)), type = static_cast<Id>(table.at(row, 1));
        if (id == 0) continue; // an empty pair at the end of a line
        if (type < 1 || type > 7)
            reading_.report.error(
                {record.where.file, at.line}, record.keyword, "TYPE",
                fmt::format("set {}: there is no type {} of sets; 1 to 7 are", record.id, type));
        else
            general_nodes(at, options[type - 1], id, members);
    }
}

bool SetResolver::general(const Row& row, std::string_view option, Kind member, Id id, Members& found)
{
    if (option == "ALL" || option.empty()) return true;
    if (option == "BOX") {
        add_box(row, member, block_->number(Kind::box, id), found);
    } else if ((option == "NODE" && member == Kind::node) || (option == "PART" && member == Kind::part) ||
               (option == "ELEM" && member != Kind::node && member != Kind::part)) {
        add_one(row, member, block_->number(member, id), found);
    } else if (option == "PART") {
        Members part;
        add_one(row, Kind::part, block_->number(Kind::part, id), part);
        add_parts(member, part, found);
    } else if (option == "SET_PART") {
        if (const Members* parts = other_set(row, Kind::part_set, block_->number(Kind::part_set, id)))
            add_parts(member, *parts, found);
    } else {
        return general_nodes(row, option, id, found);
    }
    return true;
}

/// Options that give the nodes (or, in element sets, the elements themselves) of elements and sets of them.
bool SetResolver::general_nodes(const Row& row, std::string_view option, Id id, Members& found)
{
    const bool wants_nodes = row.record.keyword.starts_with("SET_NODE");
    if (option == "SET_NODE" || option == "SET_SEG" || option == "SEG") {
        if (!wants_nodes) return false;
        const Kind kind = option == "SET_NODE" ? Kind::node_set : Kind::segment_set;
        const Id number = block_->number(kind, id);
        if (kind == Kind::node_set) {
            if (const Members* other = other_set(row, kind, number))
                found.insert(found.end(), other->begin(), other->end());
        } else if (const Index index = reading_.look_up(kind, number); index == none) {
            report_missing(row, kind, number);
        } else if (resolve(kind, index)) {
            for (const auto& segment : model_.segment_sets[index].segments)
                found.insert(found.end(), segment.begin(), segment.end());
        }
        return true;
    }
    for (const ElementOption& known : element_options) {
        const bool own_set =
            option == "SET" && row.record.keyword.starts_with("SET_" + std::string(known.element));
        if (option != known.element && option != known.set && !own_set) continue;
        Members elements;
        if (option == known.element)
            add_one(row, known.kind, block_->number(known.kind, id), elements);
        else if (const Members* other = other_set(row, known.set_kind, block_->number(known.set_kind, id)))
            elements = *other;
        for (Index element : elements) {
            if (wants_nodes)
                for_nodes(known.kind, element, [&](Index node) { found.push_back(node); });
            else
                found.push_back(element);
        }
        return true;
    }
    return false;
}

void SetResolver::add_parts(Kind member, const Members& parts, Members& found)
{
    if (parts.empty()) return;
    if (member == Kind::part) {
        found.insert(found.end(), parts.begin(), parts.end());
    } else if (member == Kind::node) {
        const Members nodes = nodes_of_parts(model_, parts);
        found.insert(found.end(), nodes.begin(), nodes.end());
    } else {
        std::vector<bool> wanted(model_.parts.size());
        for (Index part : parts) wanted[part] = true;
        const std::vector<Index>& of = parts_of(member);
        for (std::size_t i = 0; i < of.size(); ++i)
            if (wanted[of[i]]) found.push_back(static_cast<Index>(i));
    }
}

/// Nodes inside a box; elements with all their nodes inside.
void SetResolver::add_box(const Row& row, Kind member, Id id, Members& found)
{
    const Index index = reading_.look_up(Kind::box, id);
    if (index == none || static_cast<std::size_t>(index) >= model_.boxes.size()) {
        report_missing(row, Kind::box, id);
        return;
    }
    const Box& box = model_.boxes[index].box;
    for (std::size_t i = 0; i < count_of(member); ++i) {
        bool inside = member != Kind::part;
        for_nodes(member, static_cast<Index>(i),
                  [&](Index node) { inside = inside && box.holds(model_.nodes.position[node]); });
        if (inside) found.push_back(static_cast<Index>(i));
    }
}

void SetResolver::add_segments(const Record& record, SegmentSet& set)
{
    for (const Table& table : record.tables) {
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (record.keyword == "SET_SEGMENT") {
                add_segment(record, table, row, 0, set);
            } else if (record.keyword == "SET_SEGMENT_GENERAL") {
                if (option_of(table, row) == "SEG")
                    add_segment(record, table, row, 1, set);
                else if (!general_segments(record, table, row, set.segments))
                    reading_.report.error({record.where.file, table.lines[row]}, record.keyword, "OPTION",
                                          fmt::format("set {}: the option '{}' is not supported", record.id,
                                                      option_of(table, row)));
            } else {
                const Id id = static_cast<Id>(table.at(row, 0));
                const Index index = reading_.look_up(Kind::segment_set, id);
                if (index == none) {
                    report_missing({record, table.lines[row], table.columns.front()}, Kind::segment_set, id);
                    continue;
                }
                if (!resolve(Kind::segment_set, index)) continue;
                const Segments& other = model_.segment_sets[index].segments;
                if (record.keyword == "SET_SEGMENT_INTERSECT" && row > 0)
                    keep_common(other, set.segments);
                else
                    set.segments.insert(set.segments.end(), other.begin(), other.end());
            }
        }
    }
}

void SetResolver::add_segment(const Record& record, const Table& table, std::size_t row,
                              std::size_t first_column, SegmentSet& set)
{
    std::array<Index, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
        Id id = static_cast<Id>(table.at(row, first_column + i));
        if (first_column > 0) id = block_->number(Kind::node, id);
        corners[i] = id == 0 && i == 3 ? corners[2] : reading_.table(Kind::node).find(id);
        if (corners[i] == none) {
            report_missing({record, table.lines[row], table.columns[first_column + i]}, Kind::node, id);
            return;
        }
    }
    set.segments.push_back(corners);
}

/// ALL, PART, SET_PART: shells and the outside of solids of the parts; SHELL, SET_SHELL: these shells.
bool SetResolver::general_segments(const Record& record, const Table& table, std::size_t row,
                                   Segments& segments)
{
    const std::string_view option = option_of(table, row);
    const bool all = option == "ALL" || option.empty();
    if (!all && option != "PART" && option != "SET_PART" && option != "SHELL" && option != "SET_SHELL" &&
        option != "SET_SOLID")
        return false;
    std::vector<bool> shells(model_.shells.size(), all), solids(model_.solids.size(), all);
    for (std::size_t column = 1; !all && column < table.columns.size(); ++column) {
        const Id id = static_cast<Id>(table.at(row, column));
        if (id == 0) continue;
        const Row at{record, table.lines[row], table.columns[column]};
        Members found;
        if (option == "SET_SOLID") {
            general(at, option, Kind::solid, id, found);
            for (Index solid : found) solids[solid] = true;
            continue;
        }
        general(at, option, Kind::shell, id, found);
        for (Index shell : found) shells[shell] = true;
        if (option == "SHELL" || option == "SET_SHELL") continue;
        Members parts;
        general(at, option, Kind::part, id, parts);
        found.clear();
        add_parts(Kind::solid, parts, found);
        for (Index solid : found) solids[solid] = true;
    }
    for (std::size_t i = 0; i < shells.size(); ++i)
        if (shells[i]) segments.push_back(model_.shells.nodes[i]);
    const Segments faces = outer_faces(model_, solids);
    segments.insert(segments.end(), faces.begin(), faces.end());
    return true;
}

} // namespace plash
