#include "materials/null_fluid.h"

#include <fmt/format.h>

namespace plash {

NullFluid NullFluid::from_record(const Record& record)
{
    NullFluid fluid;
    fluid.density = positive(record, "RO", "mass density");
    const double cutoff = record.real("PC");
    if (cutoff > 0) {
        reject_field(record, "PC", fmt::format("{} is positive; a cut-off in tension is negative", cutoff));
    }
    fluid.lowest_pressure = cutoff;
    fluid.viscosity = record.real("MU");
    if (fluid.viscosity < 0) reject_field(record, "MU", fmt::format("{} is negative", fluid.viscosity));
    fluid.largest_volume = record.real("TEROD");
    fluid.smallest_volume = record.real("CEROD");
    if (fluid.largest_volume != 0 && fluid.largest_volume <= 1) {
        reject_field(record, "TEROD",
                     fmt::format("{} is a relative volume of compression; in tension it is "
                                 "above 1",
                                 fluid.largest_volume));
    }
    if (fluid.smallest_volume < 0 || fluid.smallest_volume >= 1) {
        reject_field(
            record, "CEROD",
            fmt::format("{} is not a relative volume of compression between 0 and 1", fluid.smallest_volume));
    }
    return fluid;
}

} // namespace plash
