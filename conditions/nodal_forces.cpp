#include "conditions/nodal_forces.h"

namespace plash {

NodalForces::NodalForces(const Model& model)
{
    for (const NodalForceGroup& group : model.nodal_force_groups) {
        for (Index node : group.nodes) nodes_.push_back({node});
    }
}

void NodalForces::add_forces(const Clock& clock, State& state)
{
    last_step_ = clock.last_step;
    for (Node& node : nodes_) {
        node.inner = state.force[node.node];
        node.velocity_before = state.velocity[node.node];
    }
}

/// The force at n acts over half of the last step and half of the next.
void NodalForces::after_motion(const Clock& clock, State& state)
{
    for (Node& node : nodes_) {
        const Vec3 force = state.force[node.node] - node.inner;
        node.work += 0.5 * (clock.last_step * dot(force, node.velocity_before) +
                            clock.step * dot(force, state.velocity[node.node]));
    }
}

void NodalForces::collect(const State& state, ElementResults& results) const
{
    if (!results.springs_wanted) return;
    for (const Node& node : nodes_) {
        const Vec3 force = state.force[node.node] - node.inner;
        results.nodal_forces.push_back(
            {force, node.work + 0.5 * last_step_ * dot(force, node.velocity_before)});
    }
}

} // namespace plash
