#include "materials/parameters.h"

#include <fmt/format.h>

namespace plash {

void reject_field(const Record& record, std::string_view field, std::string_view complaint)
{
    const Record::Field* found = record.find(field);
    throw DeckError(found && found->where.line > 0 ? found->where : record.where,
                    fmt::format("*{}, field {}: {}", record.keyword, field, complaint));
}

double positive(const Record& record, std::string_view field, std::string_view meaning)
{
    const double value = record.real(field);
    if (!(value > 0)) reject_field(record, field, fmt::format("{} is not positive ({})", value, meaning));
    return value;
}

double poisson_ratio_of(const Record& record)
{
    const double value = record.real("PR");
    if (!(value > -1 && value < 0.5)) {
        reject_field(record, "PR", fmt::format("{} is not between -1 and 0.5 (Poisson's ratio)", value));
    }
    return value;
}

const NamedCurve& curve_of(const Record& record, std::string_view field, const Model& model)
{
    const Id id = record.integer(field);
    for (const NamedCurve& curve : model.curves) {
        if (curve.id == id) return curve;
    }
    reject_field(record, field, fmt::format("there is no *DEFINE_CURVE {}", id));
}

} // namespace plash
