#include "eos/gruneisen.h"

#include "model/model.h"

#include <fmt/format.h>

namespace plash {

Gruneisen Gruneisen::from_record(const Record& record, double density)
{
    const double sound = record.real("C");
    if (!(sound > 0)) {
        throw DeckError(record.where,
                        fmt::format("*{}, field C: {} is no positive sound speed", record.keyword, sound));
    }
    if (record.integer("LCID") != 0) {
        throw DeckError(
            record.where,
            fmt::format("*{}, field LCID: an energy deposition curve is not supported; leave it empty",
                        record.keyword));
    }
    Gruneisen eos;
    eos.bulk_modulus = density * sound * sound;
    eos.s1 = record.real("S1");
    eos.s2 = record.real("S2");
    eos.s3 = record.real("S3");
    eos.gamma = record.real("GAMMA0");
    eos.a = record.real("A");
    eos.energy = record.real("E0");
    const double volume = record.real("V0");
    eos.relative_volume = volume != 0 ? volume : 1;
    if (!(eos.relative_volume > 0)) {
        throw DeckError(record.where, fmt::format("*{}, field V0: {} is no positive relative volume",
                                                  record.keyword, volume));
    }
    return eos;
}

} // namespace plash
