#include "materials/crushable_foam.h"

#include "materials/parameters.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

CrushableFoam CrushableFoam::from_record(const Record& record, const Model& model)
{
    CrushableFoam foam;
    foam.density = positive(record, "RO", "mass density");
    foam.young_modulus = positive(record, "E", "Young's modulus");
    foam.poisson_ratio = poisson_ratio_of(record);
    Curve crushing = curve_of(record, "LCID", model).curve;
    for (double& stress : crushing.ordinate) stress = std::abs(stress);
    foam.lowest_crushing = *std::min_element(crushing.ordinate.begin(), crushing.ordinate.end());
    foam.last_strain = crushing.abscissa.back();
    foam.crushing = Hardening::curve(crushing);
    foam.tensile_cutoff = record.real("TSC");
    if (foam.tensile_cutoff < 0) {
        reject_field(record, "TSC", fmt::format("{} is negative (tensile cut-off)", foam.tensile_cutoff));
    }
    if (record.integer("MODEL") != 0) {
        reject_field(record, "MODEL", "only the principal-stress model (0) is supported");
    }
    return foam;
}

} // namespace plash
