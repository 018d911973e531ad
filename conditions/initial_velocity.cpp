#include "conditions/initial_velocity.h"

namespace plash {

void apply_initial_velocities(const Model& model, State& state)
{
    for (const InitialVelocity& initial : model.initial_velocities) {
        const Vec3 spin = initial.spin * initial.axis;
        for (Index node : initial.nodes) {
            state.velocity[node] = initial.translation + cross(spin, state.position[node] - initial.center);
            if (!state.rotational()) continue;
            if (initial.set_rotation) {
                state.angular_velocity[node] = initial.angular_velocity;
            } else if (initial.spin != 0) {
                state.angular_velocity[node] = spin;
            }
        }
    }
}

} // namespace plash
