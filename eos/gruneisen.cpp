#include "eos/gruneisen.h"

#include "model/model.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// Excess compression at which the shock velocity of the fit is ten times the sound speed: 1 - S1 z - S2 z^2
/// - S3 z^3 = 1/10 with z = mu / (mu + 1) = particle velocity over shock velocity. None below z = 1: huge.
double fastest_shock(const Gruneisen& eos)
{
    const auto slowness = [&](double z) { return 1 - z * (eos.s1 + z * (eos.s2 + z * eos.s3)) - 0.1; };
    constexpr int parts = 1000;
    for (int i = 1; i < parts; ++i) {
        double high = static_cast<double>(i) / parts, low = high - 1.0 / parts;
        if (slowness(high) > 0) continue;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (low + high);
            (slowness(middle) > 0 ? low : high) = middle;
        }
        return low / (1 - low);
    }
    return 1e300;
}

} // namespace

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
    eos.largest = fastest_shock(eos);
    return eos;
}

} // namespace plash
