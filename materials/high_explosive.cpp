#include "materials/high_explosive.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace plash {

HighExplosive HighExplosive::from_record(const Record& record)
{
    HighExplosive law;
    law.density = positive(record, "RO", "mass density");
    law.detonation_speed = positive(record, "D", "detonation velocity");
    const double pressure = positive(record, "PCJ", "Chapman-Jouguet pressure");
    law.burnt_compression = pressure / (law.density * law.detonation_speed * law.detonation_speed);
    if (law.burnt_compression >= 1) {
        reject_field(record, "PCJ",
                     fmt::format("{} is not below RO D^2 = {}", pressure, pressure / law.burnt_compression));
    }
    const double beta = record.real("BETA");
    if (beta != 0 && beta != 1 && beta != 2) {
        reject_field(
            record, "BETA",
            fmt::format("{} is not one of 0 (beta and programmed burn), 1 (beta burn), 2 (programmed "
                        "burn)",
                        beta));
    }
    law.by_program = beta != 1;
    law.by_compression = beta != 2;
    if (beta != 2) return law;
    law.bulk_modulus = record.real("K");
    law.shear_modulus = record.real("G");
    law.yield_stress = record.real("SIGY");
    if (law.bulk_modulus < 0) reject_field(record, "K", fmt::format("{} is negative", law.bulk_modulus));
    if (law.shear_modulus < 0) reject_field(record, "G", fmt::format("{} is negative", law.shear_modulus));
    if (law.yield_stress < 0) reject_field(record, "SIGY", fmt::format("{} is negative", law.yield_stress));
    return law;
}

std::vector<Detonator> detonators_of(const Model& model, const Part& part)
{
    std::vector<Detonator> detonators;
    for (const Record& record : model.others) {
        if (record.keyword != "INITIAL_DETONATION") continue;
        const Id id = record.integer("PID");
        if (id < 0) {
            reject_field(
                record, "PID",
                fmt::format("{}: acoustic boundaries (-1) and part sets are not supported; there are "
                            "a part and 0, all explosives",
                            id));
        }
        const Detonator one{{record.real("X"), record.real("Y"), record.real("Z")}, record.real("LT")};
        if (id == 0 || id == part.id) detonators.push_back(one);
    }
    return detonators;
}

double lighting_time(const std::vector<Detonator>& detonators, const Vec3& point, double detonation_speed)
{
    if (detonators.empty()) return 0;
    double first = std::numeric_limits<double>::infinity();
    for (const Detonator& one : detonators) {
        first = std::min(first, one.time + norm(point - one.place) / detonation_speed);
    }
    return first;
}

} // namespace plash
