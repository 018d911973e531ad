#include "parser/set_resolver.h"

#include <fmt/format.h>

#include <algorithm>

namespace plash {
namespace {

/// Sets inside sets: more would be a mistake, and each takes its share of the stack.
constexpr int deepest_set = 1000;

/// Sorted, each once: sums and differences of sets work on this form.
void tidy(SetResolver::Members& members)
{
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
}

} // namespace

Kind SetResolver::member_kind(Kind set)
{
    switch (set) {
    case Kind::node_set:
        return Kind::node;
    case Kind::part_set:
        return Kind::part;
    case Kind::shell_set:
        return Kind::shell;
    case Kind::solid_set:
        return Kind::solid;
    case Kind::beam_set:
        return Kind::beam;
    case Kind::tshell_set:
        return Kind::tshell;
    default:
        return Kind::discrete;
    }
}

void SetResolver::run()
{
    for (std::size_t i = 0; i < reading_.pending_sets.size(); ++i) {
        const PendingSet& set = reading_.pending_sets[i];
        by_set_[{set.kind, set.index}].push_back(i);
    }
    for (const auto& [key, numbers] : by_set_) resolve(key.first, key.second);
}

bool SetResolver::resolve(Kind kind, Index index)
{
    const auto pending = by_set_.find({kind, index});
    if (pending == by_set_.end()) return true;
    State& state = states_[{kind, index}];
    if (state == State::done) return true;
    if (state == State::open || depth_ == deepest_set) {
        const Record& record = reading_.pending_sets[pending->second.front()].record;
        reading_.report.error(
            record.where, record.keyword, "SID",
            state == State::open
                ? fmt::format("set {} contains itself by way of other sets", record.id)
                : fmt::format("set {} lies more than {} sets deep in other sets", record.id, deepest_set));
        return false;
    }
    state = State::open;
    ++depth_;
    for (std::size_t number : pending->second) {
        const Record& record = reading_.pending_sets[number].record;
        const Block* outer = block_;
        block_ = reading_.pending_sets[number].block;
        if (kind == Kind::segment_set)
            add_segments(record, model_.segment_sets[index]);
        else
            add_members(record, kind, members_of(kind, index));
        block_ = outer;
    }
    --depth_;
    state = State::done;
    return true;
}

SetResolver::Members& SetResolver::members_of(Kind set, Index index)
{
    switch (set) {
    case Kind::node_set:
        return model_.node_sets[index].nodes;
    case Kind::part_set:
        return model_.part_sets[index].parts;
    case Kind::shell_set:
        return model_.shell_sets[index].elements;
    case Kind::solid_set:
        return model_.solid_sets[index].elements;
    case Kind::beam_set:
        return model_.beam_sets[index].elements;
    case Kind::tshell_set:
        return model_.thick_shell_sets[index].elements;
    default:
        return model_.discrete_sets[index].elements;
    }
}

std::size_t SetResolver::count_of(Kind kind) const
{
    switch (kind) {
    case Kind::node:
        return model_.nodes.size();
    case Kind::part:
        return model_.parts.size();
    case Kind::shell:
        return model_.shells.size();
    case Kind::solid:
        return model_.solids.size();
    case Kind::beam:
        return model_.beams.size();
    case Kind::tshell:
        return model_.thick_shells.size();
    default:
        return model_.discretes.size();
    }
}

Id SetResolver::id_of(Kind kind, std::size_t position) const
{
    switch (kind) {
    case Kind::node:
        return model_.nodes.id[position];
    case Kind::part:
        return model_.parts[position].id;
    case Kind::shell:
        return model_.shells.id[position];
    case Kind::solid:
        return model_.solids.id[position];
    case Kind::beam:
        return model_.beams.id[position];
    case Kind::tshell:
        return model_.thick_shells.id[position];
    default:
        return model_.discretes.id[position];
    }
}

void SetResolver::report_missing(const Row& row, Kind kind, Id id)
{
    reading_.report.error(
        {row.record.where.file, row.line}, row.record.keyword, row.column,
        fmt::format("set {} names {} {}, which is not defined", row.record.id, to_string(kind), id));
}

void SetResolver::add_one(const Row& row, Kind kind, Id id, Members& members)
{
    const Index found = reading_.table(kind).find(id);
    if (found != none)
        members.push_back(found);
    else
        report_missing(row, kind, id);
}

void SetResolver::add_range(Kind kind, Id first, Id last, Id step, Members& members)
{
    const IdTable& table = reading_.table(kind);
    step = std::max<Id>(step, 1);
    if (last < first) return;
    if (static_cast<std::uint64_t>(last - first) / step <= 2 * count_of(kind)) {
        for (Id id = first; id <= last; id += step)
            if (const Index found = table.find(id); found != none) members.push_back(found);
        return;
    }
    for (std::size_t i = 0; i < count_of(kind); ++i) {
        const Id id = id_of(kind, i);
        if (id >= first && id <= last && (id - first) % step == 0) members.push_back(static_cast<Index>(i));
    }
}

const SetResolver::Members* SetResolver::other_set(const Row& row, Kind set, Id id)
{
    const Index index = reading_.look_up(set, id);
    if (index == none) {
        report_missing(row, set, id);
        return nullptr;
    }
    return resolve(set, index) ? &members_of(set, index) : nullptr;
}

void SetResolver::add_members(const Record& record, Kind set, Members& members)
{
    const Kind member = member_kind(set);
    const std::string_view name = record.keyword;
    for (const Table& table : record.tables) {
        if (name.ends_with("_GENERAL")) {
            add_general(record, table, set, members);
            continue;
        }
        if (name.ends_with("_ADD_ADVANCED")) {
            add_advanced(record, table, members);
            continue;
        }
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const Row at{record, table.lines[row], table.columns.front()};
            const Id id = static_cast<Id>(table.at(row, 0));
            const auto second = [&](std::size_t column) { return static_cast<Id>(table.at(row, column)); };
            if (name.ends_with("_GENERATE")) {
                add_range(member, id, second(1), 1, members);
            } else if (name.ends_with("_INCREMENT")) {
                add_range(member, id, second(1), second(2), members);
            } else if (name.ends_with("_INTERSECT")) {
                intersect(other_set(at, set, id), row == 0, members);
            } else if (name.ends_with("_ADD")) {
                if (const Members* other = other_set(at, set, std::abs(id)))
                    members.insert(members.end(), other->begin(), other->end());
            } else if (id != 0) {
                add_one(at, member, id, members);
            }
        }
    }
    if (name.ends_with("_ADD") || name.ends_with("_ADVANCED")) tidy(members);
}

void SetResolver::intersect(const Members* other, bool first, Members& members)
{
    Members sorted = other ? *other : Members{};
    tidy(sorted);
    if (first) {
        members = std::move(sorted);
        return;
    }
    Members common;
    std::set_intersection(members.begin(), members.end(), sorted.begin(), sorted.end(),
                          std::back_inserter(common));
    members = std::move(common);
}

} // namespace plash
