#include "output/spcforc.h"

#include "output/ascii_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace plash {

namespace {

void append_force(std::string& text, const Vec3& value)
{
    for (double component : {value.x, value.y, value.z}) append_scientific(text, component, 14, 4);
}

void append_row(std::string& text, Id node, std::string_view name, const Vec3& value)
{
    fmt::format_to(std::back_inserter(text), " node={:8} local x,y,z {:<7}=", node, name);
    append_force(text, value);
    text += "  setid=       0\n";
}

} // namespace

std::string format_spcforc(double time, std::span<const SupportRow> rows)
{
    std::string text = " output at time =";
    append_scientific(text, time, 14, 5);
    text += '\n';
    Vec3 sum{};
    for (const SupportRow& row : rows) {
        if (row.translations) append_row(text, row.node, "forces", row.force);
        if (row.rotations) append_row(text, row.node, "moments", row.moment);
        sum += row.force;
    }
    text += "             force resultants   =";
    append_force(text, sum);
    return text + "\n";
}

SupportTable::SupportTable(const Model& model) : row_of_node_(model.nodes.size(), none)
{
    constexpr FreedomMask translations = 7;
    std::map<Id, std::pair<Index, FreedomMask>> held; // by node number
    for (const FixedNodes& fixed : model.fixed_nodes) {
        for (Index node : fixed.nodes) {
            auto& [index, freedoms] = held[model.nodes.id[node]];
            index = node;
            freedoms |= fixed.freedoms;
        }
    }
    for (const auto& [id, node] : held) {
        row_of_node_[node.first] = static_cast<Index>(rows_.size());
        rows_.push_back({id, (node.second & translations) != 0, (node.second & ~translations) != 0, {}, {}});
    }
}

SpcforcRecorder::SpcforcRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), table_(model), file_(path)
{
    file_.write(ascii_heading(model) + "\n\n single point constraint forces\n\n");
}

std::vector<SupportRow> SupportTable::filled(const Snapshot& snapshot) const
{
    ElementResults results;
    results.boundary_forces_wanted = true;
    snapshot.collect(results);
    std::vector<SupportRow> rows = rows_;
    for (const auto& support : results.supports) {
        SupportRow& row = rows[row_of_node_[support.node]];
        row.force += support.force;
        row.moment += support.moment;
    }
    return rows;
}

void SpcforcRecorder::write_state(const Snapshot& snapshot)
{
    file_.write(format_spcforc(snapshot.clock.time, table_.filled(snapshot)));
    file_.flush();
}

} // namespace plash
