#pragma once

#include "eos/response.h"

namespace plash {

/// Equations of state that compact for good keep one variable a point, the largest compression so far. They
/// say so by `remembers = true` and take it as second argument: evaluate(compression, largest).
template <class Eos>
inline constexpr int eos_history_size = [] {
    if constexpr (requires { Eos::remembers; }) return 1;
    return 0;
}();

/// The response at a compression. `memory` is the variable of an equation of state that remembers; it is not
/// looked at for the others.
template <class Lane, class Eos>
inline PressureResponse<Lane> respond(const Eos& eos, const Lane& compression,
                                      [[maybe_unused]] const Lane* memory)
{
    if constexpr (eos_history_size < Eos >> 0)
        return eos.evaluate(compression, max(*memory, compression));
    else
        return eos.evaluate(compression);
}

/// The same after the point has come to this compression for good.
template <class Lane, class Eos>
inline PressureResponse<Lane> respond_and_remember(const Eos& eos, const Lane& compression,
                                                   [[maybe_unused]] Lane* memory)
{
    if constexpr (eos_history_size < Eos >> 0) *memory = max(*memory, compression);
    return respond(eos, compression, memory);
}

} // namespace plash
