#include "materials/elastic_fluid.h"

#include <fmt/format.h>

namespace plash {

ElasticFluid ElasticFluid::from_record(const Record& record)
{
    ElasticFluid fluid;
    fluid.density = positive(record, "RO", "mass density");
    fluid.bulk_modulus = record.real("K");
    if (fluid.bulk_modulus == 0) {
        const double young = positive(record, "E", "Young's modulus, for the bulk modulus that K leaves out");
        fluid.bulk_modulus = young / (3 * (1 - 2 * poisson_ratio_of(record)));
    }
    if (fluid.bulk_modulus < 0) reject_field(record, "K", fmt::format("{} is negative", fluid.bulk_modulus));
    fluid.viscosity = record.real("VC");
    if (fluid.viscosity < 0) reject_field(record, "VC", fmt::format("{} is negative", fluid.viscosity));
    const double cutoff = value_or(record.real("CP", 1e20), 1e20);
    if (cutoff < 0) {
        reject_field(record, "CP",
                     fmt::format("{} is negative (cavitation pressure, tension positive)", cutoff));
    }
    fluid.lowest_pressure = -cutoff;
    return fluid;
}

} // namespace plash
