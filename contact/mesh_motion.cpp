#include "contact/mesh_motion.h"

#include <algorithm>

namespace plash {

void ContactMotion::copy(const ContactMesh& mesh, const State& state, std::size_t begin, std::size_t end)
{
    for (std::size_t i = begin; i < end; ++i) {
        const Index node = mesh.nodes[i].node;
        position.own()[i] = state.position[node];
        velocity.own()[i] = state.velocity[node];
    }
}

/// begin is the first node of a block.
void ContactMotion::bound_velocities(std::size_t begin, std::size_t end)
{
    const Vec3* speed = velocity.data();
    for (std::size_t first = begin; first < end; first += block_length) {
        Bounds range;
        for (std::size_t i = first; i < std::min(first + block_length, end); ++i) range.add(speed[i]);
        block_range[first / block_length] = range;
    }
}

/// Adds what the bounds of the velocities allow in a step.
void ContactMotion::travel()
{
    Bounds range;
    for (const Bounds& block : block_range) range.add(block);
    step_range = !block_range.empty() ? norm(range.high - range.low) * last_step : 0;
    travelled += step_range;
}

} // namespace plash
