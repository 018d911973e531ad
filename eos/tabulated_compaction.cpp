#include "eos/tabulated_compaction.h"

#include <fmt/format.h>

namespace plash {

TabulatedCompaction TabulatedCompaction::from_record(const Record& record, const Model& model)
{
    if (record.integer("LCID") != 0) {
        throw DeckError(record.where,
                        fmt::format("*{}, field LCID: an energy deposition curve is not supported; leave it "
                                    "empty",
                                    record.keyword));
    }
    TabulatedCompaction eos;
    eos.cold = tabulated_column(record, &model, "C", "LCC");
    eos.warm = tabulated_column(record, &model, "T", "LCT");
    eos.unloading = tabulated_column(record, &model, "K", "LCK");
    eos.gamma = record.real("GAMA");
    eos.energy = record.real("E0");
    eos.relative_volume = initial_relative_volume(record, "V0");
    eos.bulk_modulus = eos.evaluate(1.0, 1.0).cold_slope;
    if (!(eos.bulk_modulus > 0)) {
        throw DeckError(record.where, fmt::format("*{} {}: neither the pressure rises in compression nor is "
                                                  "there a bulk modulus (K1, LCK) for unloading",
                                                  record.keyword, record.id));
    }
    return eos;
}

} // namespace plash
