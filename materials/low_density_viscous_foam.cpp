#include "materials/low_density_viscous_foam.h"

#include "materials/parameters.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// A Maxwell element whose modulus is that of one direction alone.
MaxwellElement one_dimensional(const Record& record, const char* field, double modulus, double decay)
{
    if (modulus < 0 || decay < 0) {
        reject_field(record, field,
                     fmt::format("the relaxing modulus {} with the decay {} is negative", modulus, decay));
    }
    return {0.5 * modulus, decay};
}

} // namespace

LowDensityViscousFoam<6> viscous_foam(const Record& record, const Model& model)
{
    if (record.integer("LCID2") != 0) {
        reject_field(record, "LCID2",
                     "a fit to a relaxation curve and frequency data are not supported; give GI and BETAI");
    }
    LowDensityViscousFoam<6> law{LowDensityFoam::from_record(record, model)};
    law.density = law.foam.density;
    const Table* rows = record.table("GI");
    if (!rows) return law;
    if (rows->rows() > law.series.size()) {
        reject_field(record, "GI", fmt::format("{} rows; at most 6 are read", rows->rows()));
    }
    for (std::size_t row = 0; row < rows->rows(); ++row) {
        law.series[row] = one_dimensional(record, "GI", rows->at(row, 0), rows->at(row, 1));
        if (rows->columns.size() > 2 && rows->at(row, 2) != 0) {
            reject_field(record, "REF", "a reference geometry is not supported; leave the field at 0");
        }
    }
    return law;
}

LowDensityViscousFoam<1> relaxing_foam(const Record& record, const Model& model)
{
    LowDensityViscousFoam<1> law{LowDensityFoam::from_record(record, model)};
    law.density = law.foam.density;
    law.series[0] = one_dimensional(record, "ED", record.real("ED"), record.real("BETA1"));
    return law;
}

} // namespace plash
