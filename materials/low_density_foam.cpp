#include "materials/low_density_foam.h"

#include "materials/parameters.h"

#include <algorithm>
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
                                 const Curve& slowest)
{
    for (std::size_t i = 0; i < slowest.abscissa.size(); ++i) {
        if (slowest.abscissa[i] >= 0 && slowest.ordinate[i] >= 0) continue;
        reject_field(record, field,
                     fmt::format("the point ({}, {}) of the curve is negative; compression is positive",
                                 slowest.abscissa[i], slowest.ordinate[i]));
    }
    loading = std::move(curves);
    place = {0};
    stress_at = {loading(0.0, 0.0).stress};
    energy_at = {0};
    for (double strain : slowest.abscissa) {
        if (strain <= 0) continue;
        const double stress = loading(strain, 0.0).stress;
        energy_at.push_back(energy_at.back() + 0.5 * (strain - place.back()) * (stress_at.back() + stress));
        place.push_back(strain);
        stress_at.push_back(stress);
    }
}

double LowDensityFoam::energy(double strain) const
{
    if (strain <= 0) return 0;
    const auto after = std::upper_bound(place.begin(), place.end(), strain) - place.begin();
    const std::size_t i = after - 1;
    const double stress = loading(strain, 0.0).stress;
    return energy_at[i] + 0.5 * (strain - place[i]) * (stress_at[i] + stress);
}

} // namespace plash
