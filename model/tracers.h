#pragma once

#include "model/model.h"

namespace plash {

/// visit(record) for every tracer of a deck, *DATABASE_TRACER and _ALE, in its order.
template <class Visit>
void for_tracer_records(const Model& model, Visit&& visit)
{
    for (const Record& record : model.others)
        if (record.keyword == "DATABASE_TRACER" || record.keyword == "DATABASE_TRACER_ALE") visit(record);
}

/// Number of tracers that are to be recorded: 0 without *DATABASE_TRHIST.
inline std::size_t tracer_count(const Model& model)
{
    const auto request = model.controls.output.ascii.find("trhist");
    if (request == model.controls.output.ascii.end()) return 0;
    std::size_t count = 0;
    for_tracer_records(model, [&](const Record&) { ++count; });
    return count;
}

} // namespace plash
