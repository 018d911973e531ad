#include "contact/mesh_motion.h"

#include "contact/bounding_tree.h"
#include "core/parallel.h"

namespace plash {

void ContactMotion::load(const ContactMesh& mesh, const Clock& clock, const State& state)
{
    const std::size_t count = mesh.nodes.size();
    position.resize(count);
    velocity.resize(count);
    last_step = clock.last_step;
    std::vector<Bounds> partial((count + chunk_length - 1) / chunk_length);
    for_chunks(count, [&](std::size_t begin, std::size_t end) {
        Bounds range;
        for (std::size_t i = begin; i < end; ++i) {
            const Index node = mesh.nodes[i].node;
            position[i] = state.position[node];
            velocity[i] = state.velocity[node];
            range.add(velocity[i]);
        }
        partial[begin / chunk_length] = range;
    });
    Bounds range;
    for (const Bounds& part : partial) {
        range.add(part.low);
        range.add(part.high);
    }
    step_range = count > 0 ? norm(range.high - range.low) * last_step : 0;
    travelled += step_range;
}

} // namespace plash
