#include "materials/low_density_foam.h"

#include "materials/parameters.h"

#include <fmt/format.h>

namespace plash {

LowDensityFoam LowDensityFoam::from_record(const Record& record, const Model& model)
{
    LowDensityFoam foam;
    foam.density = positive(record, "RO", "mass density");
    foam.young_modulus = positive(record, "E", "Young's modulus in tension");
    foam.set_loading(record, "LCID", Hardening::curve(curve_of(record, "LCID", model).curve),
                     curve_of(record, "LCID", model).curve);
    const double cutoff = record.real("TC");
    foam.tensile_cutoff = value_or(cutoff, 1e20);
    if (cutoff < 0) reject_field(record, "TC", fmt::format("{} is negative (tensile cut-off)", cutoff));
    foam.hysteresis = value_or(record.real("HU"), 1);
    if (!(foam.hysteresis > 0 && foam.hysteresis <= 1)) {
        reject_field(record, "HU",
                     fmt::format("{} is not between 0 and 1 (hysteresis factor)", foam.hysteresis));
    }
    foam.shape = value_or(record.real("SHAPE"), 1);
    if (!(foam.shape > 0)) reject_field(record, "SHAPE", fmt::format("{} is not positive", foam.shape));
    foam.tears = record.real("FAIL") == 1;
    if (record.real("REF") != 0) {
        reject_field(record, "REF", "a reference geometry is not supported; leave the field at 0");
    }
    return foam;
}

void LowDensityFoam::set_loading(const Record& record, std::string_view field, Hardening curves,
                                 const Curve& slowest_curve)
{
    for (std::size_t i = 0; i < slowest_curve.abscissa.size(); ++i) {
        if (slowest_curve.abscissa[i] >= 0 && slowest_curve.ordinate[i] >= 0) continue;
        reject_field(record, field,
                     fmt::format("the point ({}, {}) of the curve is negative; compression is positive",
                                 slowest_curve.abscissa[i], slowest_curve.ordinate[i]));
    }
    loading = std::move(curves);
    std::vector<double> place{0}, stress{loading(0.0, 0.0).stress};
    for (double strain : slowest_curve.abscissa) {
        if (strain <= 0) continue;
        place.push_back(strain);
        stress.push_back(loading(strain, 0.0).stress);
    }
    slowest = BrokenLine(place, stress);
}

} // namespace plash
