#include "output/history_reader.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace plash {

namespace {

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \r\t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \r\t") - first + 1);
}

struct Entry {
    std::string name;
    double value = 0;
};

/// " kinetic energy.................   1.0E+00", perhaps with a remark such as "wall# 1" behind the number,
/// which becomes part of the name. False for any other line.
bool parse_entry(std::string_view line, Entry& entry)
{
    const auto dots = line.find("..");
    if (dots == std::string_view::npos) return false;
    const auto after = line.find_first_not_of('.', dots);
    if (after == std::string_view::npos) return false;
    const std::string_view rest = trimmed(line.substr(after));
    const auto [end, fault] = std::from_chars(rest.data(), rest.data() + rest.size(), entry.value);
    if (fault != std::errc()) return false;
    const std::string_view remark = trimmed(rest.substr(end - rest.data()));
    entry.name = trimmed(line.substr(0, dots));
    if (!remark.empty()) entry.name.append(" ").append(remark);
    return true;
}

} // namespace

const History::Column* History::find(std::string_view name) const
{
    const auto found =
        std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
    return found == columns.end() ? nullptr : &*found;
}

History read_glstat_history(std::string_view text)
{
    std::vector<std::vector<Entry>> states;
    while (!text.empty()) {
        const auto end = text.find('\n');
        if (end == std::string_view::npos) break; // a line that was being written
        Entry entry;
        if (parse_entry(text.substr(0, end), entry)) {
            if (entry.name == "time") states.emplace_back();
            if (!states.empty()) states.back().push_back(std::move(entry));
        }
        text.remove_prefix(end + 1);
    }
    History history;
    if (states.empty()) return history;
    for (const Entry& entry : states.front()) {
        if (entry.name != "time") history.columns.push_back({entry.name, {}});
    }
    for (const auto& state : states) {
        if (state.size() < history.columns.size() + 1) continue;
        history.time.push_back(state.front().value);
        for (auto& column : history.columns) {
            const auto found = std::find_if(state.begin(), state.end(),
                                            [&](const Entry& entry) { return entry.name == column.name; });
            column.values.push_back(found == state.end() ? 0 : found->value);
        }
    }
    return history;
}

} // namespace plash
