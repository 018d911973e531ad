// Points of curves in includes with other units: what they are is told by the fields that name the curve.

#include "parser/reading.h"

#include <fmt/format.h>

namespace plash {
namespace {

/// The dimensions that all uses agree on; nothing, and a message, where they do not or are not known.
std::optional<CurveDimensions> agreed(const std::vector<CurveUse>& uses, std::string_view keyword, Id id,
                                      Location where, Report& report)
{
    for (const CurveUse& use : uses) {
        if (use.dimensions && *use.dimensions == *uses.front().dimensions) continue;
        report.error(
            where, keyword, "",
            use.dimensions
                ? fmt::format("{} is used by *{} {} and *{} {} in different units: *INCLUDE_TRANSFORM cannot "
                              "convert it",
                              id, uses.front().keyword, uses.front().field, use.keyword, use.field)
                : fmt::format("{} is used by *{} {}, whose units Plash does not know: *INCLUDE_TRANSFORM "
                              "cannot convert it",
                              id, use.keyword, use.field));
        return std::nullopt;
    }
    return uses.front().dimensions;
}

void scale(std::vector<double>& values, const UnitFactors& units, const Dimension& dimension)
{
    const double factor = units.of(dimension).value_or(1);
    for (double& value : values) value *= factor;
}

} // namespace

void convert_foreign_curves(Reading& reading)
{
    Model& model = reading.model;
    // The curves of a table are used as the table is.
    for (const NamedTable& table : model.tables) {
        const auto uses = reading.curve_uses.find(table.id);
        if (uses == reading.curve_uses.end()) continue;
        const std::vector<CurveUse> of_table = uses->second;
        for (const Index curve : table.curves) {
            if (curve == none) continue;
            auto& of_curve = reading.curve_uses[model.curves[curve].id];
            of_curve.insert(of_curve.end(), of_table.begin(), of_table.end());
        }
    }
    for (const auto& [index, units] : reading.foreign_tables) {
        NamedTable& table = model.tables[index];
        const auto uses = reading.curve_uses.find(table.id);
        if (uses == reading.curve_uses.end()) continue; // nobody asks
        if (const auto dimensions =
                agreed(uses->second, "DEFINE_TABLE", table.id, table.where, reading.report))
            scale(table.abscissa, *units, dimensions->table);
    }
    for (const auto& [index, units] : reading.foreign_curves) {
        NamedCurve& curve = model.curves[index];
        const auto uses = reading.curve_uses.find(curve.id);
        if (uses == reading.curve_uses.end()) continue;
        if (const auto dimensions =
                agreed(uses->second, "DEFINE_CURVE", curve.id, curve.where, reading.report)) {
            scale(curve.curve.abscissa, *units, dimensions->abscissa);
            scale(curve.curve.ordinate, *units, dimensions->ordinate);
        }
    }
}

} // namespace plash
