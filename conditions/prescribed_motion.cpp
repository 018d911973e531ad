#include "conditions/prescribed_motion.h"

#include "core/prescribed_rate.h"

namespace plash {

PrescribedMotions::PrescribedMotions(const Model& model, const State&) : model_(model)
{
    for (const PrescribedMotion& motion : model.prescribed_motions) {
        if (motion.rigid_part != none) continue;
        motions_.push_back({&motion, std::vector<DrivenNode>(motion.nodes.size())});
        count_ += motion.nodes.size();
    }
}

void PrescribedMotions::start(State& state) const
{
    for (const Driven& driven : motions_) {
        const PrescribedMotion& motion = *driven.motion;
        if (motion.kind != PrescribedMotion::Kind::velocity || motion.birth > 0) continue;
        auto& velocity = motion.rotation ? state.angular_velocity : state.velocity;
        if (velocity.empty()) continue;
        const double target = motion.scale * curve_value(model_, motion.curve, 0);
        for (Index node : motion.nodes) {
            velocity[node] += (target - dot(velocity[node], motion.direction)) * motion.direction;
        }
    }
}

void PrescribedMotions::constrain(const Clock& clock, State& state)
{
    for (Driven& driven : motions_) {
        const PrescribedMotion& motion = *driven.motion;
        const bool active = clock.time >= motion.birth && clock.time <= motion.death;
        auto& velocities = motion.rotation ? state.angular_velocity : state.velocity;
        auto& forces = motion.rotation ? state.moment : state.force;
        const auto& masses = motion.rotation ? state.inertia : state.mass;
        if (velocities.empty()) continue;
        for (std::size_t i = 0; i < motion.nodes.size(); ++i) {
            DrivenNode& driven_node = driven.nodes[i];
            const Index node = motion.nodes[i];
            const double mass = masses[node];
            if (mass == 0 || !active) {
                driven_node.force = 0;
                driven_node.work.add(0, clock.last_step, 0, clock.step);
                continue;
            }
            const double velocity = dot(velocities[node], motion.direction);
            const double force = dot(forces[node], motion.direction);
            const double next = prescribed_rate(model_, motion, clock, velocity, driven_node.travelled);
            const double added = mass * (next - velocity) / clock.velocity_step() - force;
            forces[node] += added * motion.direction;
            driven_node.force = added;
            driven_node.work.add(added * velocity, clock.last_step, added * next, clock.step);
        }
    }
}

void PrescribedMotions::report(EnergyLedger& ledger) const
{
    for (const Driven& driven : motions_) {
        for (const DrivenNode& node : driven.nodes) ledger.external_work += node.work.done;
    }
}

void PrescribedMotions::collect(const State&, ElementResults& results) const
{
    if (!results.boundary_forces_wanted) return;
    for (const Driven& driven : motions_) {
        const PrescribedMotion& motion = *driven.motion;
        for (std::size_t i = 0; i < motion.nodes.size(); ++i) {
            const DrivenNode& node = driven.nodes[i];
            ElementResults::BoundaryForce entry{motion.nodes[i], none, {}, {}, node.work.done};
            (motion.rotation ? entry.moment : entry.force) = node.force * motion.direction;
            results.motions.push_back(entry);
        }
    }
}

} // namespace plash
