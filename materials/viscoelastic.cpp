#include "materials/viscoelastic.h"

#include "materials/parameters.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

Viscoelastic Viscoelastic::from_record(const Record& record, const Model&)
{
    Viscoelastic law;
    const bool kelvin_card = record.keyword != "MAT_VISCOELASTIC";
    law.density = positive(record, "RO", "mass density");
    law.bulk_modulus = positive(record, "BULK", "bulk modulus");
    const double first = positive(record, "G0", "short-time shear modulus");
    law.long_modulus = record.real("GI");
    if (law.long_modulus < 0) reject_field(record, "GI", fmt::format("{} is negative", law.long_modulus));
    if (kelvin_card && record.real("FO") != 0) {
        reject_field(record, "FO", "Kelvin's form (1) is not supported; 0 (Maxwell) is");
    }
    law.fading = {first - law.long_modulus, record.real(kelvin_card ? "DC" : "BETA")};
    if (law.fading.decay < 0) {
        reject_field(record, kelvin_card ? "DC" : "BETA",
                     fmt::format("{} is a negative decay", law.fading.decay));
    }
    if (law.fading.modulus < 0) { // such a material would give work without end
        reject_field(record, "GI", fmt::format("{} is above G0 = {}", law.long_modulus, first));
    }
    const double k = law.bulk_modulus, g = first;
    law.young_modulus = 9 * k * g / (3 * k + g);
    law.poisson_ratio = (3 * k - 2 * g) / (2 * (3 * k + g));
    return law;
}

} // namespace plash
