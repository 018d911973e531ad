#include "materials/hill_sheet.h"

#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

Hardening linear_from_tangent(const Record& record, const char* yield_field, const char* tangent_field,
                              double young_modulus)
{
    const double yield = positive(record, yield_field, "yield stress");
    const double tangent = record.real(tangent_field);
    if (!(tangent >= 0 && tangent < young_modulus)) {
        reject_field(record, tangent_field,
                     fmt::format("{} is not between 0 and E = {} (tangent modulus)", tangent, young_modulus));
    }
    return Hardening::linear(yield, young_modulus * tangent / (young_modulus - tangent));
}

Hardening sheet_curve(const Record& record, const char* field, const Model& model)
{
    const Curve& curve = curve_of(record, field, model).curve;
    for (double stress : curve.ordinate)
        if (!(stress > 0))
            reject_field(record, field, fmt::format("the curve gives the yield stress {}", stress));
    return Hardening::curve(curve);
}

/// P1 (E0 + p)^P2; without E0 it starts where it meets the elastic line.
Hardening swift(const Record& record, double young_modulus)
{
    const double k = positive(record, "P1", "strength coefficient"), n = record.real("P2");
    if (!(n > 0 && n < 1)) reject_field(record, "P2", fmt::format("{} is not between 0 and 1 (exponent)", n));
    const double given = record.real("E0"),
                 start = given > 0 ? given : std::pow(young_modulus / k, 1 / (n - 1));
    Curve curve;
    constexpr int points = 200;
    for (int i = 0; i <= points; ++i) {
        curve.abscissa.push_back(2 * std::pow(static_cast<double>(i) / points, 3));
        curve.ordinate.push_back(k * std::pow(start + curve.abscissa.back(), n));
    }
    return Hardening::curve(curve);
}

} // namespace

HillSheet HillSheet::from_record(const Record& record, const Model& model)
{
    HillSheet law;
    law.density_value = positive(record, "RO", "mass density");
    law.young_modulus = positive(record, "E", "Young's modulus");
    law.poisson_ratio = poisson_ratio_of(record);
    if (record.keyword != "MAT_HILL_3R") {
        const double ratio = std::abs(record.real("R"));
        if (!(ratio > 0)) reject_field(record, "R", fmt::format("{} is no ratio of strains", ratio));
        law.set_ratios(ratio, ratio, ratio);
        law.hardening = record.integer("HLCID") != 0
                            ? sheet_curve(record, "HLCID", model)
                            : linear_from_tangent(record, "SIGY", "ETAN", law.young_modulus);
        return law;
    }
    law.set_ratios(positive(record, "R00", "ratio of strains along"),
                   positive(record, "R45", "at 45 degrees"), positive(record, "R90", "across"));
    const double rule = value_or(record.real("HR"), 1);
    if (rule == 1)
        law.hardening = linear_from_tangent(record, "P2", "P1", law.young_modulus);
    else if (rule == 2)
        law.hardening = swift(record, law.young_modulus);
    else if (rule == 3)
        law.hardening = sheet_curve(record, "LCID", model);
    else {
        reject_field(
            record, "HR",
            fmt::format("hardening rule {} is not supported (1 linear, 2 exponential, 3 curve)", rule));
    }
    return law;
}

void HillSheet::set_ratios(double r00, double r45, double r90)
{
    c = r00 / (1 + r00);
    b = r00 * (1 + r90) / (r90 * (1 + r00));
    d = (1 + 2 * r45) * (r00 + r90) / (r90 * (1 + r00));
}

} // namespace plash
