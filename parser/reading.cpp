#include "parser/reading.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {
namespace {

/// Every family of keywords that has a translation of its own.
constexpr std::span<const Translator> (*families[])() = {
    node_keywords,     solid_keywords,   shell_keywords,    element_keywords,     property_keywords,
    part_keywords,     curve_keywords,   geometry_keywords, set_keywords,         boundary_keywords,
    load_keywords,     initial_keywords, damping_keywords,  termination_keywords, rigid_wall_keywords,
    contact_keywords,  control_keywords, database_keywords, constrained_keywords, ale_keywords,
    adaptive_keywords, airbag_keywords,  blast_keywords,
};

bool matches(std::string_view pattern, std::string_view keyword)
{
    if (!pattern.ends_with('*')) return pattern == keyword;
    pattern.remove_suffix(1);
    return keyword.starts_with(pattern);
}

} // namespace

std::optional<std::array<Index, 4>> Reading::find_segment(const Record& record)
{
    std::array<Index, 4> nodes{};
    const char* fields[] = {"N1", "N2", "N3", "N4"};
    for (int i = 0; i < 4; ++i) nodes[i] = find(record, fields[i], Kind::node);
    if (record.integer("N4") == 0) nodes[3] = nodes[2];
    if (std::find(nodes.begin(), nodes.end(), none) != nodes.end()) return {};
    return nodes;
}

BodyNumber Reading::find_body(Id id)
{
    if (id == 0) return none;
    if (const Index part = table(Kind::part).find(id); part != none) return part;
    const Index body = table(Kind::rigid_body).find(id);
    return body == none ? none : static_cast<Index>(model.parts.size()) + body;
}

void Reading::check_hourglass(const Record& record, std::string_view field)
{
    constexpr double usual = 0.15;
    const Record::Field *given = record.peek(field), *form = record.peek("IHQ");
    const double coefficient = given ? given->value : 0;
    const int type = form ? static_cast<int>(form->value) : 0;
    if (coefficient < 0) {
        warning(record, field,
                fmt::format("{:g} is negative: hourglass modes would be driven, not held", coefficient));
    } else if (type >= 0 && type <= 5 && coefficient > usual) {
        warning(record, field,
                fmt::format("{:g} is above {:g}, beyond which hourglass control of types 1 to 5 may become "
                            "unstable; usual are 0.05 to 0.1",
                            coefficient, usual));
    }
}

void Reading::error(const Record& record, std::string_view field, std::string text)
{
    const Record::Field* found = record.peek(field);
    report.error(found ? found->where : record.where, record.keyword, field, std::move(text));
}

void Reading::warning(const Record& record, std::string_view field, std::string text)
{
    const Record::Field* found = record.peek(field);
    report.warning(found ? found->where : record.where, record.keyword, field, std::move(text));
}

const Translator* find_translator(std::string_view keyword)
{
    for (const auto family : families)
        for (const Translator& translator : family())
            if (matches(translator.keyword, keyword)) return &translator;
    return nullptr;
}

} // namespace plash
