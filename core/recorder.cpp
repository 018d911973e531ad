#include "core/recorder.h"

namespace plash {

void Snapshot::collect(ElementResults& results) const
{
    for (const auto& term : terms) term->collect(state, results);
}

} // namespace plash
