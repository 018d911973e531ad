#include "materials/elastic_plastic_hydro.h"

#include "materials/flow_points.h"
#include "materials/parameters.h"

#include <fmt/format.h>

namespace plash {

ElasticPlasticHydro ElasticPlasticHydro::from_record(const Record& record, const Model&)
{
    ElasticPlasticHydro law;
    law.density = positive(record, "RO", "mass density");
    law.shear_modulus = positive(record, "G", "shear modulus");
    const bool with_spall = record.keyword == "MAT_ELASTIC_PLASTIC_HYDRO_SPALL";
    const Curve points = flow_points(record, 16);
    if (points.abscissa.empty()) {
        const double yield_stress = record.real(with_spall ? "SIG0" : "SIGY"), modulus = record.real("EH");
        if (yield_stress < 0) reject_field(record, with_spall ? "SIG0" : "SIGY", "a negative yield stress");
        if (modulus < 0) reject_field(record, "EH", "a negative hardening modulus is not supported");
        law.hardening = Hardening::linear(yield_stress, modulus);
    } else {
        law.hardening = Hardening::curve(points);
    }
    law.failure_strain = record.real("FS");
    if (law.failure_strain < 0) reject_field(record, "FS", "a negative failure strain is not supported");
    if (with_spall) {
        law.a1 = record.real("A1");
        law.a2 = record.real("A2");
    }
    law.spall = Spall::from_record(record, 1);
    law.poisson_ratio = 0.3;
    return law;
}

} // namespace plash
