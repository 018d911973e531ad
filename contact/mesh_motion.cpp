#include "contact/mesh_motion.h"

namespace plash {

void ContactMotion::copy(const ContactMesh& mesh, const State& state, std::size_t begin, std::size_t end)
{
    for (std::size_t i = begin; i < end; ++i) {
        const Index node = mesh.nodes[i].node;
        position.own()[i] = state.position[node];
        velocity.own()[i] = state.velocity[node];
    }
}

/// Adds what the bounds of the velocities allow in a step.
void ContactMotion::travel(const std::vector<Bounds>& partial)
{
    Bounds range;
    for (const Bounds& part : partial) {
        range.add(part.low);
        range.add(part.high);
    }
    step_range = !partial.empty() ? norm(range.high - range.low) * last_step : 0;
    travelled += step_range;
}

} // namespace plash
