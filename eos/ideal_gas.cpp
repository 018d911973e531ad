#include "eos/ideal_gas.h"

#include "model/model.h"

#include <fmt/format.h>

namespace plash {

IdealGas IdealGas::from_record(const Record& record, double density)
{
    const auto refuse = [&](const char* field, double value, const char* wanted) {
        throw DeckError(record.where,
                        fmt::format("*{}, field {}: {:g} is not {}", record.keyword, field, value, wanted));
    };
    const double cv = record.real("CVMAS"), cp = record.real("CPMAS");
    if (!(cv > 0)) refuse("CVMAS", cv, "a positive heat capacity by mass");
    if (!(cp > cv)) refuse("CPMAS", cp, "above CVMAS");
    for (const char* field : {"B", "C", "VC0", "ADIAB"}) {
        if (record.real(field) != 0) refuse(field, record.real(field), "supported; leave it at 0");
    }
    IdealGas eos;
    eos.gamma = cp / cv;
    const double temperature = record.real("T0"), volume = record.real("V0");
    if (!(temperature > 0)) refuse("T0", temperature, "a positive temperature");
    eos.energy = density * cv * temperature;
    eos.relative_volume = volume != 0 ? volume : 1;
    if (!(eos.relative_volume > 0)) refuse("V0", volume, "a positive relative volume");
    return eos;
}

} // namespace plash
