#include "output/history_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
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

std::string bytes_of(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

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

namespace {

/// One value a state and entity, in the order of the file; entities that come later begin with zeros.
class EntityHistory {
public:
    void add(double time, const std::string& name, double value)
    {
        if (history_.time.empty() || time != history_.time.back()) history_.time.push_back(time);
        const auto column = std::find_if(history_.columns.begin(), history_.columns.end(),
                                         [&](const History::Column& c) { return c.name == name; });
        History::Column& found = column == history_.columns.end()
                                     ? history_.columns.emplace_back(History::Column{name, {}})
                                     : *column;
        found.values.resize(history_.time.size() - 1, 0.0);
        found.values.push_back(value);
    }
    History take()
    {
        for (History::Column& column : history_.columns) column.values.resize(history_.time.size(), 0.0);
        return std::move(history_);
    }

private:
    History history_;
};

/// Calls line(text) for each line that is ended.
template <class Line>
void for_each_line(std::string_view text, Line&& line)
{
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return; // broken off
        line(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
}

} // namespace

History read_rwforc_history(std::string_view text)
{
    EntityHistory history;
    for_each_line(text, [&](std::string_view line) {
        double time = 0, normal = 0;
        long wall = 0;
        if (std::sscanf(std::string(line).c_str(), "%lf %ld %lf", &time, &wall, &normal) != 3) return;
        history.add(time, fmt::format("wall {}", wall), normal);
    });
    return history.take();
}

History read_rcforc_history(std::string_view text)
{
    EntityHistory history;
    for_each_line(text, [&](std::string_view line) {
        long contact = 0;
        double time = 0, x = 0, y = 0, z = 0;
        const int found = std::sscanf(std::string(line).c_str(), " slave %ld time %lf x %lf y %lf z %lf",
                                      &contact, &time, &x, &y, &z);
        if (found != 5) return;
        history.add(time, fmt::format("contact {}", contact), std::sqrt(x * x + y * y + z * z));
    });
    return history.take();
}

} // namespace plash
