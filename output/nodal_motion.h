#pragma once

#include "core/recorder.h"

#include <vector>

namespace plash {

/// The motion of the nodes as LS-DYNA writes it into nodout and d3plot: displacement and acceleration at n,
/// velocity at n-1/2. (LS-DYNA's own nodout of the cantilever shows the shift: its velocities satisfy
/// v(t - 0.501 +- 0.002 dt) of its displacements.) The State holds the velocities at n+1/2 when a snapshot is
/// taken, so that v(n-1/2) = v(n+1/2) - a(n) * clock.velocity_step().
class NodalMotion {
public:
    /// With `rotations` the angular quantities too (zero when the scene has none).
    NodalMotion(const Snapshot&, bool rotations);

    Vec3 position(Index node) const { return state_.position[node]; }
    Vec3 displacement(Index node) const { return state_.position[node] - start_[node]; }
    /// Of the material, where it flows through a mesh that does not move with it (then at n).
    Vec3 velocity(Index node) const
    {
        return material_velocity_.empty() ? state_.velocity[node] - span_ * acceleration_[node]
                                          : material_velocity_[node];
    }
    Vec3 acceleration(Index node) const { return acceleration_[node]; }

    Vec3 angular_velocity(Index node) const
    {
        return state_.angular_velocity[node] - span_ * angular_acceleration_[node];
    }
    Vec3 angular_acceleration(Index node) const { return angular_acceleration_[node]; }

private:
    const State& state_;
    const std::vector<Vec3>& start_;
    double span_;
    std::vector<Vec3> acceleration_;
    std::vector<Vec3> material_velocity_; ///< empty without Eulerian meshes
    std::vector<Vec3> angular_acceleration_;
};

/// Velocity of the whole model as one rigid body: momentum over mass [velocity]. Nodes that the loop moves
/// count with their own mass, rigid bodies and fluids with what `results` holds of them.
Vec3 global_velocity(const Snapshot&, const NodalMotion&, const ElementResults& results);

} // namespace plash
