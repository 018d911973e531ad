#include "parser/nodal_displacements.h"

#include "core/run_error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <unordered_map>

namespace plash {

namespace {

/// The number in a text with blanks around it.
template <class Number>
std::optional<Number> displacement_number(std::string_view text)
{
    while (!text.empty() && (text.front() == ' ' || text.front() == '+')) text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

struct DisplacementLine {
    Id node = 0;
    std::array<double, 6> value{};
};

std::optional<DisplacementLine> line_of(const std::vector<std::string_view>& fields)
{
    if (fields.size() != 4 && fields.size() != 7) return {};
    DisplacementLine line;
    const auto node = displacement_number<Id>(fields[0]);
    if (!node) return {};
    line.node = *node;
    for (std::size_t i = 1; i < fields.size(); ++i) {
        const auto value = displacement_number<double>(fields[i]);
        if (!value) return {};
        line.value[i - 1] = *value;
    }
    return line;
}

/// Fields apart by blanks and commas, or else in columns: numbers of 15 characters may touch.
std::optional<DisplacementLine> parse_displacements(const std::string& text)
{
    const std::string_view all(text);
    std::vector<std::string_view> fields;
    for (std::size_t at = all.find_first_not_of(" ,"); at != all.npos;) {
        const std::size_t end = std::min(all.find_first_of(" ,", at), all.size());
        fields.push_back(all.substr(at, end - at));
        at = all.find_first_not_of(" ,", end);
    }
    if (const auto line = line_of(fields)) return line;
    constexpr std::size_t id_width = 8, width = 15;
    if (all.size() <= id_width) return {};
    fields = {all.substr(0, id_width)};
    for (std::size_t at = id_width; at < all.size(); at += width) fields.push_back(all.substr(at, width));
    return line_of(fields);
}

} // namespace

std::vector<NodeDisplacement> read_prescribed_geometry(const std::string& path, const Model& model)
{
    const RelaxationControls& relaxation = model.controls.relaxation;
    if ((relaxation.flag == 2) == path.empty()) {
        if (!path.empty())
            throw RunError(fmt::format("{}: the deck asks for no prescribed geometry "
                                       "(*CONTROL_DYNAMIC_RELAXATION IDRFLG = 2)",
                                       path));
        throw RunError(fmt::format("{}: *CONTROL_DYNAMIC_RELAXATION, field IDRFLG: 2 needs the file of the "
                                   "prescribed geometry (--geometry FILE)",
                                   model.place(relaxation.where)));
    }
    std::vector<NodeDisplacement> geometry;
    if (path.empty()) return geometry;
    std::ifstream file(path);
    if (!file) throw RunError(fmt::format("{} cannot be opened", path));
    std::unordered_map<Id, Index> index_of;
    for (std::size_t node = 0; node < model.nodes.size(); ++node)
        index_of[model.nodes.id[node]] = static_cast<Index>(node);
    std::vector<bool> seen(model.nodes.size());
    std::string text;
    for (int number = 1; std::getline(file, text); ++number) {
        while (!text.empty() && (text.back() == '\r' || text.back() == ' ')) text.pop_back();
        if (text.empty() || text[0] == '$') continue;
        const auto fail = [&](const std::string& what) {
            throw RunError(fmt::format("{}:{}: {}", path, number, what));
        };
        const auto line = parse_displacements(text);
        if (!line) fail("a node, three displacements and no or three rotations belong on a line");
        const auto found = index_of.find(line->node);
        if (found == index_of.end()) fail(fmt::format("there is no node {}", line->node));
        if (seen[found->second]) fail(fmt::format("node {} stands here once more", line->node));
        seen[found->second] = true;
        const auto& v = line->value;
        geometry.push_back({found->second, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
    }
    return geometry;
}

} // namespace plash
