#include "materials/piecewise_linear_plasticity.h"

#include "materials/flow_laws.h"
#include "materials/flow_points.h"
#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace plash {

namespace {

/// EPS1..EPS8 with ES1..ES8, from no plastic strain on.
Curve read_points(const Record& record)
{
    if (record.real("EPS1") != 0) reject_field(record, "EPS1", "the first plastic strain must be zero");
    return flow_points(record, 8);
}

/// A curve may begin at zero, as crush curves of foams do: then every strain is plastic from the first on,
/// and any flow hardens.
void check_yield_curve(const Record& record, const NamedCurve& curve)
{
    const auto& [strain, stress] = std::tie(curve.curve.abscissa, curve.curve.ordinate);
    for (std::size_t i = 0; i < stress.size(); ++i) {
        const bool may_be_zero = strain[i] <= 0 && i + 1 < stress.size();
        if (stress[i] > 0 || (may_be_zero && stress[i] == 0)) continue;
        reject_field(record, "LCSS",
                     fmt::format("curve {} gives the yield stress {} at the plastic strain {}; it has to be "
                                 "positive, but for zero at no strain",
                                 curve.id, stress[i], strain[i]));
    }
}

/// LCSS: a curve, or a table of curves over the strain rate (its values are logarithms when the first is
/// negative).
Hardening read_yield_curves(const Record& record, const Model& model)
{
    const Id id = record.integer("LCSS");
    for (const NamedTable& table : model.tables) {
        if (table.id != id) continue;
        std::vector<const Curve*> curves;
        for (Index curve : table.curves) {
            check_yield_curve(record, model.curves[curve]);
            curves.push_back(&model.curves[curve].curve);
        }
        return Hardening::table(table.abscissa, curves, table.abscissa.front() < 0);
    }
    const NamedCurve& curve = curve_of(record, "LCSS", model);
    check_yield_curve(record, curve);
    return Hardening::curve(curve.curve);
}

Hardening read_hardening(const Record& record, const Model& model, double young_modulus)
{
    if (record.integer("LCSS") != 0) return read_yield_curves(record, model);
    if (record.real("ES1") != 0 || record.real("EPS2") != 0) return Hardening::curve(read_points(record));
    const double yield_stress = positive(record, "SIGY", "yield stress");
    const double tangent = record.real("ETAN");
    if (!(tangent < young_modulus)) {
        reject_field(
            record, "ETAN",
            fmt::format("tangent modulus {} is not below Young's modulus {}", tangent, young_modulus));
    }
    return Hardening::linear(yield_stress, young_modulus * tangent / (young_modulus - tangent));
}

void read_rate(const Record& record, const Model& model, PiecewiseLinearPlasticity& law)
{
    using Rate = PiecewiseLinearPlasticity::Rate;
    const double option = record.real("VP");
    if (option != 0 && option != 1 && option != -1) {
        reject_field(record, "VP", fmt::format("rate formulation {} is not supported (-1, 0 or 1)", option));
    }
    const Rate formulation = option == 1 ? Rate::viscoplastic : Rate::scaled;
    law.deviatoric_rate = option == -1;
    // A table goes before LCSR and before C and P (keyword manual, volume II).
    if (law.hardening.depends_on_rate()) {
        law.rate = formulation;
        return;
    }
    if (record.integer("LCSR") != 0) {
        law.rate = formulation;
        law.rate_factor = curve_of(record, "LCSR", model).curve;
        law.lowest_factor =
            *std::min_element(law.rate_factor.ordinate.begin(), law.rate_factor.ordinate.end());
        if (!(law.lowest_factor > 0))
            reject_field(record, "LCSR", "the curve has factors that are not positive");
        return;
    }
    if (!(record.real("C") > 0)) return;
    law.rate = formulation;
    law.reference_rate = record.real("C");
    law.rate_exponent = 1 / positive(record, "P", "exponent of Cowper and Symonds, needed with C");
    if (formulation == Rate::viscoplastic) law.overstress = record.real("SIGY");
}

} // namespace

PiecewiseLinearPlasticity PiecewiseLinearPlasticity::from_record(const Record& record, const Model& model)
{
    if (is_flow_law(record.keyword)) return read_flow_law(record, model);
    for (const char* field : {"EPSTHIN", "EPSMAJ", "NUMINT"}) { // of *MAT_123
        if (record.real(field) != 0) reject_field(record, field, "this failure criterion is not supported");
    }
    PiecewiseLinearPlasticity law;
    law.density = positive(record, "RO", "mass density");
    law.young_modulus = positive(record, "E", "Young's modulus");
    law.poisson_ratio = poisson_ratio_of(record);
    law.hardening = read_hardening(record, model, law.young_modulus);
    read_rate(record, model, law);
    const double failure = record.real("FAIL");
    if (failure < 0) reject_field(record, "FAIL", "user-defined failure (FAIL < 0) is not supported");
    law.failure_strain = failure < 1e20 ? failure : 0;
    law.shortest_step = record.real("TDEL");
    return law;
}

} // namespace plash
