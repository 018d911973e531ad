#include "materials/johnson_cook.h"

#include <fmt/format.h>

namespace plash {

JohnsonCook JohnsonCook::from_record(const Record& record, const Model&)
{
    JohnsonCook law;
    law.density = positive(record, "RO", "mass density");
    law.shear_modulus = record.real("G");
    law.young_modulus = record.real("E");
    law.poisson_ratio = record.real("PR");
    if (!(law.shear_modulus > 0)) {
        law.young_modulus = positive(record, "E", "Young's modulus, needed without G");
        law.shear_modulus = law.young_modulus / (2 * (1 + poisson_ratio_of(record)));
    } else if (!(law.young_modulus > 0)) {
        law.poisson_ratio = law.poisson_ratio > 0 ? poisson_ratio_of(record) : 0.3;
        law.young_modulus = 2 * law.shear_modulus * (1 + law.poisson_ratio);
    } else {
        law.poisson_ratio = poisson_ratio_of(record);
    }
    law.initial_yield = positive(record, "A", "yield stress");
    law.hardening = record.real("B");
    law.hardening_exponent = record.real("N");
    if (law.hardening < 0) reject_field(record, "B", "a negative hardening modulus is not supported");
    if (law.hardening_exponent < 0) reject_field(record, "N", "a negative exponent is not supported");
    if (law.hardening_exponent == 0) { // a constant
        law.initial_yield += law.hardening;
        law.hardening = 0;
    }
    if (law.hardening == 0) law.hardening_exponent = 1;
    law.rate_coefficient = record.real("C");
    if (law.rate_coefficient != 0)
        law.reference_rate = positive(record, "EPSO", "quasi-static rate, needed with C");
    law.viscoplastic = record.real("VP") == 1;
    if (record.integer("RATEOP") != 0)
        reject_field(record, "RATEOP",
                     fmt::format("form {} of the rate effect is not supported (0: Johnson-Cook)",
                                 record.integer("RATEOP")));
    law.room = record.real("TR");
    law.melting = record.real("TM");
    law.thermal_exponent = record.real("M");
    const double capacity = record.real("CP");
    if (capacity > 0) {
        if (!(law.melting > law.room)) reject_field(record, "TM", "the melting point does not lie above TR");
        if (!(law.thermal_exponent > 0)) reject_field(record, "M", "the thermal exponent is not positive");
        law.heat_capacity = law.density * capacity;
    } else {
        law.melting = law.room + 1;
    }
    law.fracture = {record.real("D1/BETA"), record.real("D2/WC"), record.real("D3/DC"),
                    record.real("D4/GAMMA"), record.real("D5")};
    law.least_fracture_strain = record.real("EFMIN", 1e-6);
    law.erodes = record.integer("EROD") == 0;
    law.spall = Spall::from_record(record, 2);
    return law;
}

} // namespace plash
