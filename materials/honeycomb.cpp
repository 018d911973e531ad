#include "materials/honeycomb.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// A curve over 1 - V. Curves whose abscissa starts at or below zero are over it already; others are over V,
/// from the compacted honeycomb up (manual, remark 1).
BrokenLine over_closure(const Curve& curve)
{
    if (curve.abscissa.front() <= 0) return {curve.abscissa, curve.ordinate};
    std::vector<double> closed(curve.abscissa.rbegin(), curve.abscissa.rend());
    for (double& value : closed) value = 1 - value;
    return {closed, {curve.ordinate.rbegin(), curve.ordinate.rend()}};
}

} // namespace

Honeycomb Honeycomb::from_record(const Record& record, const Model& model)
{
    Honeycomb law;
    law.density = positive(record, "RO", "mass density");
    law.young_modulus = positive(record, "E", "Young's modulus of the compacted honeycomb");
    law.poisson_ratio = poisson_ratio_of(record);
    law.yield_stress = positive(record, "SIGY", "yield stress of the compacted honeycomb");
    law.compacted_volume = record.real("VF");
    if (!(law.compacted_volume >= 0 && law.compacted_volume < 1)) {
        reject_field(
            record, "VF",
            fmt::format("{} is not between 0 and 1 (relative volume when compacted)", law.compacted_volume));
    }
    const char* moduli[] = {"EAAU", "EBBU", "ECCU", "GABU", "GBCU", "GCAU"};
    for (int i = 0; i < 6; ++i) {
        law.uncompacted[i] = (i < 3 ? 1 : 2) * positive(record, moduli[i], "uncompacted modulus");
    }
    const auto curve = [&](const char* field, const char* fallback) {
        const char* named = record.integer(field) != 0 ? field : fallback;
        return over_closure(curve_of(record, named, model).curve);
    };
    const char* shear = record.integer("LCS") != 0 ? "LCS" : "LCA";
    law.strength = {curve("LCA", "LCA"),  curve("LCB", "LCA"),  curve("LCC", "LCA"),
                    curve("LCAB", shear), curve("LCBC", shear), curve("LCCA", shear)};
    if (record.integer("LCSR") != 0) {
        const Curve& factor = curve_of(record, "LCSR", model).curve;
        law.rate_factor = {factor.abscissa, factor.ordinate};
        law.rate_dependent = true;
    }
    if (record.real("TSEF") > 0) law.tensile_failure = record.real("TSEF");
    if (record.real("SSEF") > 0) law.shear_failure = record.real("SSEF");
    law.axes = OrthotropicAxes::from_record(record, model);
    return law;
}

} // namespace plash
