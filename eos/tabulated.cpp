#include "eos/tabulated.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// Points over the volume strain, falling, as a line over the compression strain, rising.
Tabulated::Line line_of(const Record& record, const std::vector<double>& strain,
                        const std::vector<double>& value)
{
    Tabulated::Line line;
    line.start = -strain.front();
    line.value = value.front();
    double before = 0;
    for (std::size_t i = 0; i + 1 < strain.size(); ++i) {
        if (!(strain[i + 1] < strain[i])) {
            throw DeckError(record.where,
                            fmt::format("*{}, field EV{}: the volume strain {} does not fall below {} of the "
                                        "point before",
                                        record.keyword, i + 2, strain[i + 1], strain[i]));
        }
        const double slope = (value[i + 1] - value[i]) / (strain[i] - strain[i + 1]);
        line.kink[line.kinks] = -strain[i];
        line.change[line.kinks++] = slope - before;
        before = slope;
    }
    return line;
}

/// Points of a curve over the volume strain from the largest strain down; more than fit are refused.
void take_curve(const Record& record, const NamedCurve& curve, std::vector<double>& strain,
                std::vector<double>& value)
{
    strain.assign(curve.curve.abscissa.rbegin(), curve.curve.abscissa.rend());
    value.assign(curve.curve.ordinate.rbegin(), curve.curve.ordinate.rend());
    if (strain.size() > Tabulated::Line::most_kinks + 1) {
        throw DeckError(record.where,
                        fmt::format("*{}: curve {} has {} points; at most {} are supported", record.keyword,
                                    curve.id, strain.size(), Tabulated::Line::most_kinks + 1));
    }
}

Tabulated read(const Record& record, const Model* model)
{
    std::vector<double> strain, cold, warm;
    for (int i = 1; i <= 10; ++i) {
        const double value = record.real(fmt::format("EV{}", i));
        const double c = record.real(fmt::format("C{}", i)), t = record.real(fmt::format("T{}", i));
        // The list ends where an all-empty point follows a point in compression.
        if (i > 1 && value == 0 && c == 0 && strain.back() <= 0) break;
        strain.push_back(value);
        cold.push_back(c);
        warm.push_back(t);
    }
    std::vector<double> warm_strain = strain;
    const auto curve = [&](const char* field, std::vector<double>& x, std::vector<double>& y) {
        const Id id = record.integer(field);
        if (id == 0) return;
        const Index index = model ? model->find_curve(id) : none;
        if (index == none) {
            throw DeckError(record.where,
                            fmt::format("*{}, field {}: curve {} is not supported here or does not exist",
                                        record.keyword, field, id));
        }
        take_curve(record, model->curves[index], x, y);
    };
    curve("LCC", strain, cold);
    curve("LCT", warm_strain, warm);
    if (strain.size() < 2) {
        throw DeckError(record.where, fmt::format("*{} {}: there are no points of volume strain and pressure",
                                                  record.keyword, record.id));
    }
    Tabulated eos;
    eos.cold = line_of(record, strain, cold);
    eos.warm = line_of(record, warm_strain, warm);
    eos.gamma = record.real("GAMA");
    eos.energy = record.real("E0");
    const double volume = record.real("V0");
    eos.relative_volume = volume != 0 ? volume : 1;
    if (!(eos.relative_volume > 0)) {
        throw DeckError(record.where, fmt::format("*{}, field V0: {} is no positive relative volume",
                                                  record.keyword, volume));
    }
    double pressure = 0;
    eos.cold.evaluate(1e-12, pressure, eos.bulk_modulus);
    if (!(eos.bulk_modulus > 0)) {
        throw DeckError(record.where, fmt::format("*{} {}: the pressure does not rise in compression",
                                                  record.keyword, record.id));
    }
    return eos;
}

} // namespace

Tabulated Tabulated::from_record(const Record& record, const Model& model)
{
    return read(record, &model);
}

Tabulated Tabulated::from_record(const Record& record, double /*density*/)
{
    return read(record, nullptr);
}

} // namespace plash
