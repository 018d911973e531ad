#include "materials/plastic_kinematic.h"

#include <fmt/format.h>

namespace plash {

PlasticKinematicParameters PlasticKinematicParameters::from_record(const Record& record)
{
    PlasticKinematicParameters p;
    p.density = positive(record, "RO", "mass density");
    p.young_modulus = positive(record, "E", "Young's modulus");
    p.poisson_ratio = poisson_ratio_of(record);
    p.yield_stress = positive(record, "SIGY", "yield stress");
    const double tangent = record.real("ETAN");
    if (!(tangent >= 0 && tangent < p.young_modulus)) {
        reject_field(
            record, "ETAN",
            fmt::format("{} is not between 0 and E = {} (tangent modulus)", tangent, p.young_modulus));
    }
    p.plastic_modulus = p.young_modulus * tangent / (p.young_modulus - tangent);
    p.beta = record.real("BETA");
    if (!(p.beta >= 0 && p.beta <= 1)) {
        reject_field(record, "BETA",
                     fmt::format("{} is not between 0 (kinematic) and 1 (isotropic hardening)", p.beta));
    }
    p.rate.constant = record.real("SRC");
    p.rate.exponent = record.real("SRP");
    if (p.rate.constant < 0) reject_field(record, "SRC", fmt::format("{} is negative", p.rate.constant));
    if (p.rate.constant > 0 && !(p.rate.exponent > 0)) {
        reject_field(record, "SRP",
                     fmt::format("{} is not positive, but SRC asks for a rate effect", p.rate.exponent));
    }
    p.viscoplastic = record.real("VP") != 0 && p.rate.constant > 0;
    p.failure_strain = record.real("FS");
    return p;
}

} // namespace plash
