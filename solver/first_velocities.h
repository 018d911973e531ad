#pragma once

#include "solver/scene.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace plash {

/// Brings a scene to rest for a phase before the run, and back to the velocities of the start after it, with
/// an energy book that begins anew.
class FirstVelocities {
public:
    explicit FirstVelocities(Scene& scene)
        : scene_(scene), velocity_(scene.state.velocity), angular_velocity_(scene.state.angular_velocity)
    {
        rest();
    }
    /// Everything stands still where it is.
    void rest()
    {
        State& state = scene_.state;
        std::fill(state.velocity.begin(), state.velocity.end(), Vec3{});
        std::fill(state.angular_velocity.begin(), state.angular_velocity.end(), Vec3{});
        for (const auto& term : scene_.terms) term->begin_phase(true, state);
    }
    void restore()
    {
        scene_.state.velocity = std::move(velocity_);
        scene_.state.angular_velocity = std::move(angular_velocity_);
        for (const auto& term : scene_.terms) term->begin_phase(false, scene_.state);
        scene_.ledger.start_anew();
    }

private:
    Scene& scene_;
    std::vector<Vec3> velocity_, angular_velocity_;
};

} // namespace plash
