#include "eos/linear_polynomial.h"

#include "model/model.h"

#include <fmt/format.h>

namespace plash {

LinearPolynomial LinearPolynomial::from_record(const Record& record, double /*density*/)
{
    LinearPolynomial eos;
    eos.c0 = record.real("C0");
    eos.c1 = record.real("C1");
    eos.c2 = record.real("C2");
    eos.c3 = record.real("C3");
    eos.c4 = record.real("C4");
    eos.c5 = record.real("C5");
    eos.c6 = record.real("C6");
    eos.energy = record.real("E0");
    const double volume = record.real("V0");
    eos.relative_volume = volume != 0 ? volume : 1;
    eos.bulk_modulus = eos.c1;
    if (!(eos.relative_volume > 0)) {
        throw DeckError(record.where, fmt::format("*{}, field V0: {} is no positive relative volume",
                                                  record.keyword, volume));
    }
    if (eos.c1 == 0 && eos.c2 == 0 && eos.c3 == 0 && eos.c4 == 0 && eos.c5 == 0 && eos.c6 == 0) {
        throw DeckError(record.where,
                        fmt::format("*{}: all of C1 to C6 are zero, so the material would have no pressure",
                                    record.keyword));
    }
    return eos;
}

} // namespace plash
