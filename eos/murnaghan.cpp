#include "eos/murnaghan.h"

#include "model/model.h"

#include <fmt/format.h>

namespace plash {

Murnaghan Murnaghan::from_record(const Record& record, double /*density*/)
{
    Murnaghan eos;
    eos.gamma = record.real("GAMMA");
    eos.stiffness = record.real("K0");
    const double volume = record.real("V0");
    eos.relative_volume = volume != 0 ? volume : 1;
    eos.bulk_modulus = eos.gamma * eos.stiffness;
    const auto refuse = [&](const char* field, double value, const char* wanted) {
        throw DeckError(record.where,
                        fmt::format("*{}, field {}: {:g} is not {}", record.keyword, field, value, wanted));
    };
    if (!(eos.gamma > 0)) refuse("GAMMA", eos.gamma, "a positive exponent (7 for water)");
    if (!(eos.stiffness > 0)) refuse("K0", eos.stiffness, "a positive stress (rho0 c^2 / GAMMA)");
    if (!(eos.relative_volume > 0)) refuse("V0", volume, "a positive relative volume");
    return eos;
}

} // namespace plash
