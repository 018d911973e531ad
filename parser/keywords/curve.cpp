// *DEFINE_CURVE and *DEFINE_TABLE.

#include "parser/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plash {
namespace {

/// A scale of zero stands for one.
double scale(const Record& record, std::string_view field)
{
    const double value = record.real(field, 1);
    return value == 0 ? 1 : value;
}

/// Abscissa SFA (A + OFFA), ordinate SFO (O + OFFO).
void read_curve(const Record& record, const Block& block, Reading& reading)
{
    NamedCurve curve;
    curve.id = record.id;
    curve.title = record.title;
    curve.where = record.where;
    const Id phases = record.integer("SIDR");
    curve.in_transient = phases != 1;
    curve.in_relaxation = phases == 1 || phases == 2;
    if (curve.in_relaxation) reading.model.controls.relaxation.curves_ask = true;
    const double abscissa_scale = scale(record, "SFA"), ordinate_scale = scale(record, "SFO");
    const double abscissa_offset = record.real("OFFA"), ordinate_offset = record.real("OFFO");
    const Table* points = record.table("A1");
    const std::size_t count = points ? points->rows() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double abscissa = abscissa_scale * (points->at(i, 0) + abscissa_offset);
        const double ordinate = ordinate_scale * (points->at(i, 1) + ordinate_offset);
        const std::vector<double>& before = curve.curve.abscissa;
        if (!before.empty() && abscissa <= before.back()) {
            const Location where{block.where.file, points->lines[i]};
            if (abscissa == before.back() && ordinate == curve.curve.ordinate.back()) continue;
            reading.report.error(
                where, record.keyword, "A1",
                fmt::format("curve {}: the abscissa {:g} does not rise above {:g} of the point before",
                            curve.id, abscissa, before.back()));
            break;
        }
        curve.curve.abscissa.push_back(abscissa);
        curve.curve.ordinate.push_back(ordinate);
    }
    if (count == 0) reading.error(record, "A1", fmt::format("curve {} has no points", curve.id));
    if (block.transform && block.transform->units.change())
        reading.foreign_curves.emplace_back(static_cast<Index>(reading.model.curves.size()),
                                            &block.transform->units);
    reading.model.curves.push_back(std::move(curve));
}

/// With curve numbers beside the values, or the curves follow in the deck in the order of the values.
void read_table(const Record& record, const Block& block, Reading& reading)
{
    NamedTable table;
    table.id = record.id;
    table.title = record.title;
    table.where = record.where;
    const Table* rows = record.table("VALUE");
    const std::size_t count = rows ? rows->rows() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double value = scale(record, "SFA") * (rows->at(i, 0) + record.real("OFFA"));
        if (!table.abscissa.empty() && value <= table.abscissa.back()) {
            reading.report.error(
                {block.where.file, rows->lines[i]}, record.keyword, "VALUE",
                fmt::format("table {}: the value {:g} does not rise above {:g} of the line before", table.id,
                            value, table.abscissa.back()));
            break;
        }
        table.abscissa.push_back(value);
        // For now the number of the curve: it may be defined further down.
        const double number = rows->at(i, 1);
        const bool possible = std::abs(number) <= std::numeric_limits<Index>::max();
        if (!possible)
            reading.report.error({block.where.file, rows->lines[i]}, record.keyword, "LCID",
                                 fmt::format("{} is too large for the number of a curve in a table", number));
        table.curves.push_back(possible ? static_cast<Index>(number) : 0);
    }
    if (count == 0) reading.error(record, "VALUE", fmt::format("table {} has no values", table.id));
    if (block.transform && block.transform->units.change())
        reading.foreign_tables.emplace_back(static_cast<Index>(reading.model.tables.size()),
                                            &block.transform->units);
    reading.model.tables.push_back(std::move(table));
}

constexpr Translator curve_table[] = {
    {"DEFINE_CURVE", Phase::properties, read_curve},
    {"DEFINE_TABLE", Phase::properties, read_table},
    {"DEFINE_TABLE_2D", Phase::properties, read_table},
};

} // namespace

std::span<const Translator> curve_keywords()
{
    return curve_table;
}

void finish_tables(Reading& reading)
{
    Model& model = reading.model;
    for (NamedTable& table : model.tables) {
        const bool numbered =
            std::any_of(table.curves.begin(), table.curves.end(), [](Index id) { return id != 0; });
        // Curves in the order of the deck: those behind the table's own line.
        std::size_t next = 0;
        while (next < model.curves.size() && (model.curves[next].where.file < table.where.file ||
                                              (model.curves[next].where.file == table.where.file &&
                                               model.curves[next].where.line < table.where.line)))
            ++next;
        for (Index& curve : table.curves) {
            const Id id = curve;
            if (numbered)
                curve = reading.look_up(Kind::curve, id);
            else
                curve = next < model.curves.size() ? static_cast<Index>(next++) : none;
            if (curve != none) reading.use(Kind::curve, model.curves[curve].id);
            if (curve != none) continue;
            reading.report.error(
                table.where, "DEFINE_TABLE", "LCID",
                numbered ? fmt::format("table {} names curve {}, which is not defined", table.id, id)
                         : fmt::format("table {} has {} values but fewer curves behind it", table.id,
                                       table.curves.size()));
        }
    }
}

} // namespace plash
