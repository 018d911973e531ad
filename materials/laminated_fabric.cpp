#include "materials/laminated_fabric.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// A strength that would only be reached beyond the elastic line (E eps < X) is made brittle: the exponent is
/// cut at 100, where 99 % of the way to the strength is straight.
LaminatedFabric::Damage damage_of(const Record& record, double modulus, const char* strength_field,
                                  const char* strain_field, const char* limit_field)
{
    LaminatedFabric::Damage damage;
    const double strength = std::abs(record.real(strength_field));
    const double strain = std::abs(record.real(strain_field));
    if (strength == 0) return damage;
    if (strain == 0) {
        reject_field(record, strain_field,
                     fmt::format("the strain at the strength {} is missing", strength_field));
    }
    damage.strain = strength / modulus;
    constexpr double most = 100;
    const double ratio = std::log(strain / damage.strain);
    damage.exponent = ratio > 1 / most ? 1 / ratio : most;
    damage.peak = damage.strain * std::exp(1 / damage.exponent);
    damage.lowest = record.real(limit_field) * strength / modulus;
    return damage;
}

} // namespace

LaminatedFabric LaminatedFabric::from_record(const Record& record, const Model&)
{
    LaminatedFabric law;
    law.plane = OrthotropicPlane::from_record(record);
    if (record.real("FS") != -1) {
        reject_field(
            record, "FS",
            fmt::format("failure surface {} is not supported (-1: faceted, with damages of their own "
                        "for tension, compression and shear)",
                        record.real("FS")));
    }
    if (record.real("TAU1") != 0 || record.real("GAMMA1") != 0) {
        reject_field(record, "TAU1", "a shear curve with TAU1 and GAMMA1 is not supported; leave both empty");
    }
    law.tension_a = damage_of(record, law.plane.ea, "XT", "E11T", "SLIMT1");
    law.compression_a = damage_of(record, law.plane.ea, "XC", "E11C", "SLIMC1");
    law.tension_b = damage_of(record, law.plane.eb, "YT", "E22T", "SLIMT2");
    law.compression_b = damage_of(record, law.plane.eb, "YC", "E22C", "SLIMC2");
    law.shear = damage_of(record, law.plane.gab, "SC", "GMS", "SLIMS");
    law.erosion_strain = record.real("ERODS");
    if (law.erosion_strain < 0) {
        reject_field(record, "ERODS", "erosion by compressive strain (a negative value) is not supported");
    }
    return law;
}

} // namespace plash
