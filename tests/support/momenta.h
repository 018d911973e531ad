#pragma once

#include "core/state.h"

namespace plash::testing {

/// Momentum and angular momentum about the origin of all masses of the State.
struct Momenta {
    Vec3 linear{}, angular{};

    explicit Momenta(const State& state)
    {
        for (std::size_t i = 0; i < state.size(); ++i) {
            const Vec3 momentum = state.mass[i] * state.velocity[i];
            linear += momentum;
            angular += cross(state.position[i], momentum);
        }
    }
};

} // namespace plash::testing
