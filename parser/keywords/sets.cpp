// *SET_NODE, _PART, _SEGMENT, _SHELL, _SOLID in all their forms: lists, ranges, columns, sums, intersections
// and the options of _GENERAL, resolved to positions once all elements and sets are known.

#include "parser/set_resolver.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace plash {
namespace {

using Members = std::vector<Index>;

std::array<double, 4> attributes(const Record& record)
{
    return {record.real("DA1"), record.real("DA2"), record.real("DA3"), record.real("DA4")};
}

template <class Set>
void start_set(const Record& record, const Block& block, Kind kind, std::vector<Set>& sets, Reading& reading)
{
    Index index = reading.table(kind).find(record.id);
    if (index == none) { // a _COLLECT of a known set goes on with it
        index = static_cast<Index>(sets.size());
        Set set;
        set.id = record.id;
        set.title = record.title;
        if constexpr (requires { set.attribute; }) set.attribute = attributes(record);
        sets.push_back(std::move(set));
    }
    for (const Table& table : record.tables) table.read = true;
    reading.pending_sets.push_back({kind, index, record, &block});
}

/// Translator of the sets of one kind.
template <Kind kind, auto sets>
void start_set_of(const Record& record, const Block& block, Reading& reading)
{
    start_set(record, block, kind, reading.model.*sets, reading);
}

constexpr auto start_node_set = start_set_of<Kind::node_set, &Model::node_sets>;
constexpr auto start_part_set = start_set_of<Kind::part_set, &Model::part_sets>;
constexpr auto start_segment_set = start_set_of<Kind::segment_set, &Model::segment_sets>;
constexpr auto start_shell_set = start_set_of<Kind::shell_set, &Model::shell_sets>;
constexpr auto start_solid_set = start_set_of<Kind::solid_set, &Model::solid_sets>;
constexpr auto start_beam_set = start_set_of<Kind::beam_set, &Model::beam_sets>;
constexpr auto start_thick_shell_set = start_set_of<Kind::tshell_set, &Model::thick_shell_sets>;
constexpr auto start_discrete_set = start_set_of<Kind::discrete_set, &Model::discrete_sets>;

constexpr Translator sets_table[] = {
    {"SET_NODE_LIST", Phase::sets, start_node_set},
    {"SET_NODE_LIST_GENERATE", Phase::sets, start_node_set},
    {"SET_NODE_LIST_GENERATE_INCREMENT", Phase::sets, start_node_set},
    {"SET_NODE_COLUMN", Phase::sets, start_node_set},
    {"SET_NODE_GENERAL", Phase::sets, start_node_set},
    {"SET_NODE_ADD", Phase::sets, start_node_set},
    {"SET_NODE_ADD_ADVANCED", Phase::sets, start_node_set},
    {"SET_NODE_INTERSECT", Phase::sets, start_node_set},
    {"SET_PART_LIST", Phase::sets, start_part_set},
    {"SET_PART_LIST_GENERATE", Phase::sets, start_part_set},
    {"SET_PART_LIST_GENERATE_INCREMENT", Phase::sets, start_part_set},
    {"SET_PART_COLUMN", Phase::sets, start_part_set},
    {"SET_PART_GENERAL", Phase::sets, start_part_set},
    {"SET_PART_ADD", Phase::sets, start_part_set},
    {"SET_SEGMENT", Phase::sets, start_segment_set},
    {"SET_SEGMENT_ADD", Phase::sets, start_segment_set},
    {"SET_SEGMENT_INTERSECT", Phase::sets, start_segment_set},
    {"SET_SEGMENT_GENERAL", Phase::sets, start_segment_set},
    {"SET_SHELL_LIST", Phase::sets, start_shell_set},
    {"SET_SHELL_LIST_GENERATE", Phase::sets, start_shell_set},
    {"SET_SHELL_LIST_GENERATE_INCREMENT", Phase::sets, start_shell_set},
    {"SET_SHELL_COLUMN", Phase::sets, start_shell_set},
    {"SET_SHELL_GENERAL", Phase::sets, start_shell_set},
    {"SET_SHELL_ADD", Phase::sets, start_shell_set},
    {"SET_SHELL_INTERSECT", Phase::sets, start_shell_set},
    {"SET_SOLID", Phase::sets, start_solid_set},
    {"SET_SOLID_GENERATE", Phase::sets, start_solid_set},
    {"SET_SOLID_GENERATE_INCREMENT", Phase::sets, start_solid_set},
    {"SET_SOLID_GENERAL", Phase::sets, start_solid_set},
    {"SET_SOLID_ADD", Phase::sets, start_solid_set},
    {"SET_BEAM", Phase::sets, start_beam_set},
    {"SET_BEAM_ADD", Phase::sets, start_beam_set},
    {"SET_BEAM_INTERSECT", Phase::sets, start_beam_set},
    {"SET_BEAM_GENERAL", Phase::sets, start_beam_set},
    {"SET_BEAM_GENERATE", Phase::sets, start_beam_set},
    {"SET_BEAM_GENERATE_INCREMENT", Phase::sets, start_beam_set},
    {"SET_TSHELL", Phase::sets, start_thick_shell_set},
    {"SET_TSHELL_GENERAL", Phase::sets, start_thick_shell_set},
    {"SET_TSHELL_GENERATE", Phase::sets, start_thick_shell_set},
    {"SET_DISCRETE", Phase::sets, start_discrete_set},
    {"SET_DISCRETE_ADD", Phase::sets, start_discrete_set},
    {"SET_DISCRETE_GENERAL", Phase::sets, start_discrete_set},
    {"SET_DISCRETE_GENERATE", Phase::sets, start_discrete_set},
};

} // namespace

std::span<const Translator> set_keywords()
{
    return sets_table;
}

void finish_sets(Reading& reading)
{
    if (!reading.pending_stand_ins.empty()) {
        // Other sets may ask for the nodes of the new particles.
        const auto is_part_set = [](const PendingSet& set) { return set.kind == Kind::part_set; };
        auto& pending = reading.pending_sets;
        const auto end = std::stable_partition(pending.begin(), pending.end(), is_part_set);
        std::vector<PendingSet> others(std::make_move_iterator(end), std::make_move_iterator(pending.end()));
        pending.erase(end, pending.end());
        SetResolver(reading).run();
        make_stand_ins(reading);
        pending = std::move(others);
    }
    SetResolver(reading).run();
    reading.pending_sets.clear();
}

std::vector<Index> nodes_of_parts(const Model& model, const std::vector<Index>& parts)
{
    std::vector<bool> wanted(model.parts.size()), used(model.nodes.size());
    for (Index part : parts) wanted[part] = true;
    for_each_topology(model, [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i)
            if (wanted[elements.part[i]])
                for (Index node : elements.nodes[i])
                    if (node != none) used[node] = true;
    });
    for (std::size_t i = 0; i < model.particles.size(); ++i)
        if (wanted[model.particles.part[i]]) used[model.particles.node[i]] = true;
    std::vector<Index> nodes;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) nodes.push_back(static_cast<Index>(i));
    return nodes;
}

std::vector<Index> all_nodes(const Model& model)
{
    std::vector<Index> nodes(model.nodes.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    return nodes;
}

} // namespace plash
