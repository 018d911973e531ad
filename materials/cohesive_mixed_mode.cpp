#include "materials/cohesive_mixed_mode.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Peak traction of a mode: the field itself, or what the triangle under the energy with the ultimate
/// separation has.
double strength_of(const Record& record, const char* field, const char* ultimate, double energy)
{
    const double given = record.real(field);
    if (given < 0) {
        reject_field(record, field,
                     fmt::format("a curve over the element's size ({}) is not supported; give the peak "
                                 "traction",
                                 given));
    }
    const double separation = record.real(ultimate);
    if (given > 0) return given;
    if (!(separation > 0)) {
        reject_field(record, field,
                     fmt::format("neither a peak traction ({}) nor {} is given", field, ultimate));
    }
    return 2 * energy / separation;
}

/// The triangle needs room behind its peak.
void check_triangle(const Record& record, const char* field, double strength, double stiffness, double energy)
{
    if (2 * energy / strength > strength / stiffness) return;
    reject_field(record, field,
                 fmt::format("the peak traction {} is reached at a separation of {}, where the energy {} is "
                             "used up already; it takes a larger stiffness or energy",
                             strength, strength / stiffness, energy));
}

} // namespace

CohesiveMixedMode CohesiveMixedMode::from_record(const Record& record)
{
    CohesiveMixedMode law;
    law.density = record.real("RO");
    if (law.density < 0) reject_field(record, "RO", fmt::format("{} is negative", law.density));
    law.by_area = record.integer("ROFLG") == 1;
    law.normal_stiffness = positive(record, "EN", "stiffness normal to the surface");
    law.shear_stiffness = positive(record, "ET", "stiffness along the surface");
    law.normal_energy = positive(record, "GIC", "fracture energy of mode I");
    law.shear_energy = positive(record, "GIIC", "fracture energy of mode II");
    law.normal_strength = strength_of(record, "T", "UND", law.normal_energy);
    law.shear_strength = strength_of(record, "S", "UTD", law.shear_energy);
    check_triangle(record, "T", law.normal_strength, law.normal_stiffness, law.normal_energy);
    check_triangle(record, "S", law.shear_strength, law.shear_stiffness, law.shear_energy);
    law.exponent = record.real("XMU");
    if (law.exponent == 0) {
        reject_field(record, "XMU", "0 is no exponent (positive: power law, negative: Benzeggagh & Kenane)");
    }
    law.mean_exponent = value_or(record.real("GAMMA", 1), 1);
    const double failing = record.real("INTFAIL");
    law.points_to_fail = static_cast<int>(std::abs(failing));
    if (law.points_to_fail > 4) {
        reject_field(record, "INTFAIL", fmt::format("{}: the element has four points", failing));
    }
    law.at_corners = failing <= 0;
    return law;
}

} // namespace plash
