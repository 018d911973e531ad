#include "parser/include_transform.h"

#include "parser/definition_reader.h"
#include "parser/number.h"

#include <fmt/format.h>

#include <algorithm>

namespace plash {

Id IncludeTransform::offset(Kind kind) const
{
    switch (kind) {
    case Kind::none:
    case Kind::count:
        return 0;
    case Kind::node:
        return node;
    case Kind::shell:
    case Kind::solid:
    case Kind::beam:
    case Kind::tshell:
    case Kind::discrete:
    case Kind::mass:
    case Kind::inertia:
    case Kind::seatbelt:
        return element;
    case Kind::part:
    case Kind::rigid_body:
        return part;
    case Kind::material:
    case Kind::thermal_material:
    case Kind::eos:
        return material;
    case Kind::node_set:
    case Kind::segment_set:
    case Kind::part_set:
    case Kind::shell_set:
    case Kind::solid_set:
    case Kind::beam_set:
    case Kind::tshell_set:
    case Kind::discrete_set:
    case Kind::group_set:
    case Kind::box_set:
    case Kind::mode_set:
        return set;
    case Kind::curve:
    case Kind::table:
    case Kind::function:
        return curve;
    case Kind::coordinate:
    case Kind::vector:
    case Kind::orientation:
    case Kind::box:
    case Kind::transformation:
    case Kind::friction:
        return define;
    case Kind::section:
    case Kind::hourglass:
        return other;
    }
    return other;
}

void read_include_transform(const Block& block, const Parameters& parameters, Report& report,
                            IncludeTransform& transform)
{
    DefinitionReader definitions(block, parameters, report);
    Record record;
    if (!definitions.next(record)) return;
    transform.node += record.integer("IDNOFF");
    transform.element += record.integer("IDEOFF");
    transform.part += record.integer("IDPOFF");
    transform.material += record.integer("IDMOFF");
    transform.set += record.integer("IDSOFF");
    transform.curve += record.integer("IDFOFF");
    transform.define += record.integer("IDDOFF");
    transform.other += record.integer("IDROFF");
    const auto factor = [&](std::string_view field) {
        const double value = record.real(field, 1);
        if (value < 0)
            report.error(record.peek(field)->where, record.keyword, std::string(field),
                         fmt::format("a factor of {:g} is not positive", value));
        return value > 0 ? value : 1;
    };
    transform.units.mass *= factor("FCTMAS");
    transform.units.time *= factor("FCTTIM");
    transform.units.length *= factor("FCTLEN");
    if (const std::string_view scale = record.text("FCTTEM");
        !scale.empty() && scale != "1" && scale != "1.0")
        transform.units.temperature = true;
    for (const char* field : {"PREFIX", "SUFFIX"})
        if (!record.text(field).empty())
            report.warning(record.peek(field)->where, record.keyword, field, "titles stay as they are");
    if (const Id id = record.integer("TRANID"); id != 0)
        transform.transformations.emplace(transform.transformations.begin(), id,
                                          record.peek("TRANID")->where);
}

void read_auto_offset(const Block& block, const Deck& deck, Report& report, IncludeTransform& transform)
{
    if (block.keyword.name.ends_with("_USER")) {
        DefinitionReader definitions(block, deck.parameters, report);
        Record record;
        if (!definitions.next(record)) return;
        transform.node += record.integer("NOFFSET");
        transform.element += record.integer("NEOFFSET");
        return;
    }
    for (const Block& other : deck.blocks) {
        const bool nodes = other.keyword.name == "NODE";
        if (!nodes && !other.keyword.name.starts_with("ELEMENT_")) continue;
        Id& highest = nodes ? transform.node : transform.element;
        const Kind kind = nodes ? Kind::node : Kind::solid;
        LineCursor cursor(other.text, 1);
        std::string_view line;
        while (cursor.next_data(line)) {
            Id id = 0;
            const std::size_t width = std::max(8, other.minimum_width);
            if (parse_whole(line.substr(0, std::min({line.find(','), width, line.size()})), id))
                highest = std::max(highest, other.number(kind, id));
        }
    }
}

} // namespace plash
