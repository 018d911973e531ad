#include "conditions/prescribed_motion.h"

#include "core/prescribed_rate.h"
#include "math/matrix3.h"

namespace plash {

namespace {

/// Velocity over the step that carries a place by `angle` on its circle about an axis.
Vec3 orbit_velocity(const Vec3& arm, const Vec3& axis, double rate, double step)
{
    return (1 / step) * (rotation(rate * step * axis) * arm - arm);
}

} // namespace

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
            if (motion.orbit) {
                const Vec3 spin = target * motion.direction;
                velocity[node] = dot(velocity[node], motion.direction) * motion.direction +
                                 cross(spin, state.position[node] - motion.center);
                continue;
            }
            velocity[node] += (target - dot(velocity[node], motion.direction)) * motion.direction;
            if (!motion.only_component) velocity[node] = target * motion.direction;
        }
    }
}

/// Force that must be added so that the node moves as prescribed.
Vec3 PrescribedMotions::drive(const PrescribedMotion& motion, DrivenNode& driven, Index node,
                              const Clock& clock, const State& state) const
{
    const Vec3& force = (motion.rotation ? state.moment : state.force)[node];
    const Vec3& velocity = (motion.rotation ? state.angular_velocity : state.velocity)[node];
    const double mass = (motion.rotation ? state.inertia : state.mass)[node];
    if (mass == 0) return {};
    const double per_velocity = mass / clock.velocity_step();
    const auto towards = [&](const Vec3& target) { return per_velocity * (target - velocity) - force; };
    const auto along = [&](const Vec3& direction, double target) {
        return (per_velocity * (target - dot(velocity, direction)) - dot(force, direction)) * direction;
    };
    const Vec3& axis = motion.direction;
    if (!motion.orbit) {
        const double next = prescribed_rate(model_, motion, clock, dot(velocity, axis), driven.travelled);
        return motion.only_component ? along(axis, next) : towards(next * axis);
    }
    const Vec3 offset = state.position[node] - motion.center;
    const Vec3 arm = offset - dot(offset, axis) * axis;
    const double radius = norm(arm);
    if (radius == 0) return {}; // on the axis: nowhere to go
    const Vec3 tangent = (1 / radius) * cross(axis, arm);
    const double rate =
        prescribed_rate(model_, motion, clock, dot(velocity, tangent) / radius, driven.travelled);
    if (motion.only_component) return along(tangent, radius * rate);
    const Vec3 added = towards(orbit_velocity(arm, axis, rate, clock.step));
    return added - dot(added, axis) * axis; // the freedom along the axis stays free
}

bool PrescribedMotions::acts(const PrescribedMotion& motion, const Clock& clock) const
{
    return clock.time >= motion.birth && clock.time <= motion.death && acts_now(model_, motion.curve, clock);
}

void PrescribedMotions::list_held(const Clock& clock, const State& state,
                                  std::vector<HeldFreedom>& held) const
{
    for (const Driven& driven : motions_) {
        const PrescribedMotion& motion = *driven.motion;
        const auto& masses = motion.rotation ? state.inertia : state.mass;
        if (!acts(motion, clock) || masses.empty()) continue;
        const Vec3& axis = motion.direction;
        for (std::size_t i = 0; i < motion.nodes.size(); ++i) {
            const Index node = motion.nodes[i];
            if (masses[node] == 0) continue;
            DrivenNode driven_node = driven.nodes[i]; // drive() advances it
            const Vec3 total = (motion.rotation ? state.moment : state.force)[node] +
                               drive(motion, driven_node, node, clock, state);
            const auto hold = [&](const Vec3& direction) {
                held.push_back({node, motion.rotation, direction, dot(total, direction) / masses[node]});
            };
            if (motion.orbit) {
                const Vec3 arm = cross(axis, state.position[node] - motion.center);
                if (norm(arm) == 0) continue; // on the axis: not driven
                const Vec3 tangent = (1 / norm(arm)) * arm;
                hold(tangent);
                if (!motion.only_component) hold(cross(tangent, axis));
            } else if (motion.only_component) {
                hold(axis);
            } else {
                for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) hold(direction);
            }
        }
    }
}

void PrescribedMotions::constrain(const Clock& clock, State& state)
{
    for (Driven& driven : motions_) {
        const PrescribedMotion& motion = *driven.motion;
        const bool active = acts(motion, clock);
        auto& velocities = motion.rotation ? state.angular_velocity : state.velocity;
        auto& forces = motion.rotation ? state.moment : state.force;
        if (velocities.empty()) continue;
        for (std::size_t i = 0; i < motion.nodes.size(); ++i) {
            DrivenNode& driven_node = driven.nodes[i];
            const Index node = motion.nodes[i];
            const Vec3 added = active ? drive(motion, driven_node, node, clock, state) : Vec3{};
            driven_node.work += 0.5 * clock.last_step * dot(added + driven_node.force, velocities[node]);
            driven_node.force = added;
            forces[node] += added;
        }
    }
}

void PrescribedMotions::report(EnergyLedger& ledger) const
{
    for (const Driven& driven : motions_) {
        for (const DrivenNode& node : driven.nodes) ledger.external_work += node.work;
    }
}

void PrescribedMotions::collect(const State&, ElementResults& results) const
{
    if (!results.boundary_forces_wanted) return;
    for (const Driven& driven : motions_) {
        const PrescribedMotion& motion = *driven.motion;
        for (std::size_t i = 0; i < motion.nodes.size(); ++i) {
            const DrivenNode& node = driven.nodes[i];
            ElementResults::BoundaryForce entry{motion.nodes[i], none, {}, {}, node.work};
            (motion.rotation ? entry.moment : entry.force) = node.force;
            results.motions.push_back(entry);
        }
    }
}

void PrescribedMotions::serialise(Archive& archive)
{
    for (Driven& driven : motions_) archive(driven.nodes);
}

} // namespace plash
