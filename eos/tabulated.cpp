#include "eos/tabulated.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// Points over the volume strain, falling, as a line over the compression strain, rising.
BrokenLine line_of(const Record& record, std::vector<double> strain, const std::vector<double>& value)
{
    for (std::size_t i = 0; i + 1 < strain.size(); ++i) {
        if (strain[i + 1] < strain[i]) continue;
        throw DeckError(record.where,
                        fmt::format("*{}, field EV{}: the volume strain {} does not fall below {} of the "
                                    "point before",
                                    record.keyword, i + 2, strain[i + 1], strain[i]));
    }
    for (double& one : strain) one = -one;
    return {strain, value};
}

Tabulated read_tabulated(const Record& record, const Model* model)
{
    Tabulated eos;
    eos.cold = tabulated_column(record, model, "C", "LCC");
    eos.warm = tabulated_column(record, model, "T", "LCT");
    eos.gamma = record.real("GAMA");
    eos.energy = record.real("E0");
    eos.relative_volume = initial_relative_volume(record, "V0");
    double pressure = 0;
    eos.cold.evaluate(1e-12, pressure, eos.bulk_modulus);
    if (!(eos.bulk_modulus > 0)) {
        throw DeckError(record.where, fmt::format("*{} {}: the pressure does not rise in compression",
                                                  record.keyword, record.id));
    }
    return eos;
}

} // namespace

BrokenLine tabulated_column(const Record& record, const Model* model, std::string_view column,
                            std::string_view curve_field)
{
    std::vector<double> strain, value;
    for (int i = 1; i <= 10; ++i) {
        const double place = record.real(fmt::format("EV{}", i));
        const double pressure = record.real(fmt::format("C{}", i));
        // The list ends where an all-empty point follows a point in compression.
        if (i > 1 && place == 0 && pressure == 0 && strain.back() <= 0) break;
        strain.push_back(place);
        value.push_back(record.real(fmt::format("{}{}", column, i)));
    }
    const Id id = record.integer(curve_field);
    if (id != 0) {
        const Index index = model ? model->find_curve(id) : none;
        if (index == none) {
            throw DeckError(record.where,
                            fmt::format("*{}, field {}: curve {} is not supported here or does not exist",
                                        record.keyword, curve_field, id));
        }
        const Curve& curve = model->curves[index].curve;
        strain.assign(curve.abscissa.rbegin(), curve.abscissa.rend());
        value.assign(curve.ordinate.rbegin(), curve.ordinate.rend());
    }
    if (strain.size() < 2 && column == "C") {
        throw DeckError(record.where, fmt::format("*{} {}: there are no points of volume strain and pressure",
                                                  record.keyword, record.id));
    }
    return line_of(record, std::move(strain), value);
}

double initial_relative_volume(const Record& record, std::string_view field)
{
    const double volume = record.real(field);
    if (volume < 0) {
        throw DeckError(record.where, fmt::format("*{}, field {}: {} is no positive relative volume",
                                                  record.keyword, field, volume));
    }
    return volume != 0 ? volume : 1;
}

Tabulated Tabulated::from_record(const Record& record, const Model& model)
{
    return read_tabulated(record, &model);
}

Tabulated Tabulated::from_record(const Record& record, double /*density*/)
{
    return read_tabulated(record, nullptr);
}

} // namespace plash
