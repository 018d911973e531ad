#include "assess/signals.h"

#include "output/history_reader.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

namespace plash {

namespace {

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> number(std::string_view text)
{
    text = trimmed(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

/// The number in a fixed column; nothing when the line ends before it or something else stands there.
std::optional<double> number(std::string_view line, std::size_t column, std::size_t width)
{
    if (line.size() < column + width) return {};
    return number(line.substr(column, width));
}

std::vector<std::string_view> words_of(std::string_view line)
{
    std::vector<std::string_view> words;
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
        words.push_back(line.substr(0, line.find_first_of(" \t")));
        line.remove_prefix(words.back().size());
    }
    return words;
}

/// Calls `use` with each whole line; the last one counts only if it ends.
template <class Use>
void each_line(std::string_view text, Use&& use)
{
    for (auto end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
        use(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
}

/// Curves by name, in the order in which they first appear.
class Curves {
public:
    void add(const std::string& name, double time, double value)
    {
        const auto [place, is_new] = place_.try_emplace(name, signals_.size());
        if (is_new) signals_.push_back({name, {}});
        TimeCurve& curve = signals_[place->second].curve;
        curve.time.push_back(time);
        curve.value.push_back(value);
    }
    std::vector<Signal> take() { return std::move(signals_); }

private:
    std::map<std::string, std::size_t> place_;
    std::vector<Signal> signals_;
};

std::vector<Signal> glstat_signals(std::string_view text)
{
    const History history = read_glstat_history(text);
    std::vector<Signal> signals;
    for (const auto& column : history.columns)
        signals.push_back({column.name, {history.time, column.values}});
    return signals;
}

std::vector<Signal> nodout_signals(std::string_view text)
{
    static const char* const motion[] = {"x-disp", "y-disp", "z-disp", "x-vel",  "y-vel",  "z-vel",
                                         "x-accl", "y-accl", "z-accl", "x-coor", "y-coor", "z-coor"};
    static const char* const rotation[] = {"x-rot",    "y-rot",    "z-rot",    "x-rotvel", "y-rotvel",
                                           "z-rotvel", "x-rotacc", "y-rotacc", "z-rotacc"};
    Curves curves;
    double time = 0;
    bool rotations = false, legend = false;
    each_line(text, [&](std::string_view line) {
        if (line.starts_with("{BEGIN LEGEND}")) legend = true;
        if (line.starts_with("{END LEGEND}")) legend = false;
        if (const auto at = line.find("at time"); at != std::string_view::npos) {
            time = number(line, at + 7, 14).value_or(time);
        } else if (line.starts_with(" nodal point")) {
            rotations = line.find("x-rot") != std::string_view::npos;
        } else if (const auto id = number(line, 0, 9); id && !legend) {
            const std::size_t count = rotations ? std::size(rotation) : std::size(motion);
            if (line.size() < 10 + 12 * count) return;
            for (std::size_t i = 0; i < count; ++i) {
                if (const auto value = number(line, 10 + 12 * i, 12)) {
                    curves.add(fmt::format("{:.0f}/{}", *id, rotations ? rotation[i] : motion[i]), time,
                               *value);
                }
            }
        }
    });
    return curves.take();
}

/// " slave  2 time 0.0  x 0.0  y 0.0  z 0.0 mass 0.0  mx 0.0 ...": pairs of a name and a number.
std::vector<Signal> rcforc_signals(std::string_view text)
{
    Curves curves;
    each_line(text, [&](std::string_view line) {
        const auto words = words_of(line);
        if (words.size() < 10 || (words[0] != "slave" && words[0] != "master") || words[2] != "time") return;
        const auto time = number(words[3]);
        for (std::size_t i = 4; time && i + 1 < words.size(); i += 2) {
            if (const auto value = number(words[i + 1]))
                curves.add(fmt::format("{}/{}_{}", words[1], words[0], words[i]), *time, *value);
        }
    });
    return curves.take();
}

std::vector<Signal> rwforc_signals(std::string_view text)
{
    static const char* const names[] = {"normal", "x", "y", "z"};
    Curves curves;
    each_line(text, [&](std::string_view line) {
        const auto words = words_of(line);
        if (words.size() != 6) return;
        const auto time = number(words[0]), wall = number(words[1]);
        for (std::size_t i = 0; time && wall && i < 4; ++i) {
            if (const auto value = number(words[i + 2]))
                curves.add(fmt::format("{:.0f}/{}", *wall, names[i]), *time, *value);
        }
    });
    return curves.take();
}

std::vector<Signal> matsum_signals(std::string_view text)
{
    static const std::pair<const char*, const char*> names[] = {
        {"inten=", "internal"},   {"kinen=", "kinetic"},    {"x-mom=", "x-momentum"},
        {"y-mom=", "y-momentum"}, {"z-mom=", "z-momentum"}, {"x-rbv=", "x-velocity"},
        {"y-rbv=", "y-velocity"}, {"z-rbv=", "z-velocity"}, {"hgeng=", "hourglass"}};
    Curves curves;
    double time = 0;
    std::string part;
    each_line(text, [&](std::string_view line) {
        if (line.starts_with(" time =")) time = number(line.substr(7)).value_or(time);
        if (line.starts_with(" mat.#=")) part = trimmed(line.substr(7, 8));
        for (const auto& [mark, name] : names) {
            const auto at = line.find(mark);
            if (at == std::string_view::npos || part.empty()) continue;
            if (const auto value = number(line.substr(at + 6, 13)))
                curves.add(part + "/" + name, time, *value);
        }
    });
    return curves.take();
}

using Reader = std::vector<Signal> (*)(std::string_view);

const std::map<std::string, Reader, std::less<>>& readers()
{
    static const std::map<std::string, Reader, std::less<>> table = {{"glstat", glstat_signals},
                                                                     {"matsum", matsum_signals},
                                                                     {"nodout", nodout_signals},
                                                                     {"rcforc", rcforc_signals},
                                                                     {"rwforc", rwforc_signals}};
    return table;
}

std::string plain(std::string name)
{
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

std::string names_of(const std::vector<Signal>& signals)
{
    std::string text;
    for (const Signal& signal : signals) {
        if (text.size() > 600) return text + " ...";
        text += (text.empty() ? "" : ", ") + signal.name;
    }
    return text;
}

} // namespace

std::vector<Signal> read_signals(std::string_view kind, std::string_view text)
{
    const auto reader = readers().find(kind);
    if (reader == readers().end()) return {};
    std::vector<Signal> signals = reader->second(text);
    for (Signal& signal : signals) signal.name = plain(std::string(kind) + "/" + signal.name);
    return signals;
}

const std::vector<std::string>& signal_files()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const auto& [name, reader] : readers()) list.push_back(name);
        return list;
    }();
    return names;
}

TimeCurve run_signal(const std::string& directory, const std::string& name)
{
    const std::string kind = name.substr(0, name.find('/'));
    if (!readers().contains(kind)) {
        throw SignalError(fmt::format("'{}' is not a signal: it begins with one of the files {}", name,
                                      fmt::join(signal_files(), ", ")));
    }
    const std::filesystem::path path = std::filesystem::path(directory) / kind;
    if (!std::filesystem::exists(path)) {
        throw SignalError(
            fmt::format("{} is not there; the deck may not ask for it (*DATABASE_{})", path.string(), kind));
    }
    std::vector<Signal> signals = read_signals(kind, bytes_of(path));
    const std::string wanted = plain(name);
    for (Signal& signal : signals) {
        if (signal.name == wanted) return std::move(signal.curve);
    }
    throw SignalError(fmt::format("{} has no '{}'; it has {}", path.string(), name, names_of(signals)));
}

std::vector<Signal> read_csv(const std::string& path)
{
    if (!std::filesystem::is_regular_file(path)) throw SignalError(path + " is not a file");
    std::vector<Signal> columns;
    std::vector<double> times;
    std::size_t line_number = 0;
    std::string text = bytes_of(path);
    if (!text.ends_with('\n')) text += '\n';
    each_line(text, [&](std::string_view line) {
        ++line_number;
        line = trimmed(line);
        if (line.empty() || line.starts_with('#')) return;
        std::vector<std::string_view> fields;
        for (;;) {
            const auto comma = line.find(',');
            fields.push_back(trimmed(line.substr(0, comma)));
            if (comma == std::string_view::npos) break;
            line.remove_prefix(comma + 1);
        }
        if (columns.empty()) {
            const bool headings = !number(fields[0]);
            for (std::size_t i = 1; i < fields.size(); ++i)
                columns.push_back({headings ? std::string(fields[i]) : fmt::format("{}", i + 1), {}});
            if (columns.empty()) throw SignalError(path + " has one column only: time, value is wanted");
            if (headings) return;
        }
        const auto time = number(fields[0]);
        if (!time) throw SignalError(fmt::format("{}:{}: '{}' is not a time", path, line_number, fields[0]));
        for (std::size_t i = 1; i < fields.size() && i <= columns.size(); ++i) {
            if (fields[i].empty()) continue;
            const auto value = number(fields[i]);
            if (!value)
                throw SignalError(fmt::format("{}:{}: '{}' is not a number", path, line_number, fields[i]));
            TimeCurve& curve = columns[i - 1].curve;
            if (!curve.empty() && *time < curve.time.back())
                throw SignalError(fmt::format("{}:{}: time goes back to {}", path, line_number, *time));
            curve.time.push_back(*time);
            curve.value.push_back(*value);
        }
    });
    return columns;
}

TimeCurve csv_signal(const std::string& path, const std::string& column)
{
    std::vector<Signal> columns = read_csv(path);
    if (columns.empty()) throw SignalError(path + " holds no numbers");
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const bool wanted =
            column.empty() ? i == 0 : columns[i].name == column || column == fmt::format("{}", i + 2);
        if (!wanted) continue;
        if (columns[i].curve.empty()) throw SignalError(path + ": column '" + columns[i].name + "' is empty");
        return std::move(columns[i].curve);
    }
    throw SignalError(fmt::format("{} has no column '{}'; it has {}", path, column, names_of(columns)));
}

} // namespace plash
