#include "materials/soil_foam.h"

#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// EPS1..EPS10 with P1..P10; the list ends with the first empty point behind the first one.
Curve pressure_points(const Record& record)
{
    Curve points;
    for (int i = 1; i <= 10; ++i) {
        const double strain = record.real(fmt::format("EPS{}", i));
        const double pressure = record.real(fmt::format("P{}", i));
        if (i > 1 && strain == 0 && pressure == 0) break;
        points.abscissa.push_back(strain);
        points.ordinate.push_back(pressure);
    }
    return points;
}

/// The table over compaction. The manual gives the logarithm of the relative volume, which is negative in
/// compression; a table whose strains are all positive is one over compaction already.
Curve over_compaction(const Record& record, std::string_view field, Curve table)
{
    const auto [low, high] = std::minmax_element(table.abscissa.begin(), table.abscissa.end());
    if (table.abscissa.size() < 2)
        reject_field(record, field, "the table of pressures has fewer than two points");
    if (*low < 0 && *high > 0) {
        reject_field(record, field,
                     fmt::format("the volume strains of the table go from {} to {}; they lie on "
                                 "one side of zero",
                                 *low, *high));
    }
    for (double& strain : table.abscissa) strain = std::abs(strain);
    if (table.abscissa.front() > table.abscissa.back()) {
        std::reverse(table.abscissa.begin(), table.abscissa.end());
        std::reverse(table.ordinate.begin(), table.ordinate.end());
    }
    for (std::size_t i = 1; i < table.abscissa.size(); ++i) {
        if (table.abscissa[i] > table.abscissa[i - 1] && table.ordinate[i] >= table.ordinate[i - 1]) continue;
        reject_field(
            record, field,
            fmt::format("pressure {} at the compaction {} follows {} at {}: compaction must rise, and "
                        "pressure must not fall",
                        table.ordinate[i], table.abscissa[i], table.ordinate[i - 1], table.abscissa[i - 1]));
    }
    return table;
}

double slope_of(const Curve& table, std::size_t segment)
{
    return (table.ordinate[segment + 1] - table.ordinate[segment]) /
           (table.abscissa[segment + 1] - table.abscissa[segment]);
}

} // namespace

SoilFoam SoilFoam::from_record(const Record& record, const Model& model)
{
    SoilFoam soil;
    soil.density = positive(record, "RO", "mass density");
    soil.shear_modulus = positive(record, "G", "shear modulus");
    soil.bulk_modulus = positive(record, "BULK", "bulk modulus for unloading");
    soil.a0 = record.real("A0");
    soil.a1 = record.real("A1");
    soil.a2 = record.real("A2");
    soil.cutoff = record.real("PC");
    if (soil.cutoff > 0) {
        reject_field(record, "PC",
                     fmt::format("{} is positive (pressure in tension is negative)", soil.cutoff));
    }
    soil.crushes = record.real("VCR") == 0;
    soil.tears = record.keyword == "MAT_SOIL_AND_FOAM_FAILURE";
    const bool by_curve = record.integer("LCID") != 0;
    const Curve table = by_curve ? over_compaction(record, "LCID", curve_of(record, "LCID", model).curve)
                                 : over_compaction(record, "EPS1", pressure_points(record));
    soil.table = Hardening::curve(table);
    soil.first_slope = slope_of(table, 0);
    for (std::size_t i = 0; i + 1 < table.abscissa.size(); ++i)
        soil.bulk_modulus = std::max(soil.bulk_modulus, slope_of(table, i));
    const double k = soil.bulk_modulus, g = soil.shear_modulus;
    soil.young_modulus = 9 * k * g / (3 * k + g);
    soil.poisson_ratio = (3 * k - 2 * g) / (2 * (3 * k + g));
    return soil;
}

} // namespace plash
