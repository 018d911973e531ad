#pragma once

#include <cstddef>

namespace plash {

/// An element that goes in this cycle. Its energy counts the work of the last step with its force at the
/// step's end, which moves nobody any more: half of that force's work in the step, `missing_work` [energy],
/// is not in the motion either.
struct ElementLoss {
    std::size_t place = 0; ///< batch x lane_count + lane
    double missing_work = 0;
};

} // namespace plash
