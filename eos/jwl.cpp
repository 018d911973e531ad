#include "eos/jwl.h"

#include "model/model.h"

#include <fmt/format.h>

namespace plash {

Jwl Jwl::from_record(const Record& record, double /*density*/)
{
    Jwl eos;
    const auto positive = [&](const char* field) {
        const double value = record.real(field);
        if (value > 0) return value;
        throw DeckError(record.where,
                        fmt::format("*{}, field {}: {} is not positive", record.keyword, field, value));
    };
    eos.a = record.real("A");
    eos.b = record.real("B");
    eos.r1 = positive("R1");
    eos.r2 = positive("R2");
    eos.omega = positive("OMEG");
    eos.energy = record.real("E0");
    const double volume = record.real("VO");
    eos.relative_volume = volume != 0 ? volume : 1;
    if (!(eos.relative_volume > 0)) {
        throw DeckError(record.where, fmt::format("*{}, field VO: {} is no positive relative volume",
                                                  record.keyword, volume));
    }
    eos.bulk_modulus = eos.evaluate(1.0).cold_slope;
    return eos;
}

} // namespace plash
