#include "conditions/fixities.h"

namespace plash {

namespace {

constexpr double Vec3::*axes[3] = {&Vec3::x, &Vec3::y, &Vec3::z};

/// Replaces the held components of `force` by what stops `velocity` within `velocity_step`; returns the
/// reaction and adds the kinetic energy that is stopped.
Vec3 hold(Vec3& force, const Vec3& velocity, double mass, FreedomMask freedoms, double velocity_step,
          double& stopped_energy)
{
    Vec3 reaction{};
    if (mass == 0) return reaction; // a node of a rigid body: the body holds it
    for (int axis = 0; axis < 3; ++axis) {
        if (!(freedoms >> axis & 1)) continue;
        const double v = velocity.*axes[axis];
        const double needed = v == 0 ? 0 : -mass * v / velocity_step;
        reaction.*axes[axis] = needed - force.*axes[axis];
        force.*axes[axis] = needed;
        stopped_energy += 0.5 * mass * v * v;
    }
    return reaction;
}

} // namespace

Fixities::Fixities(const Model& model)
{
    for (const FixedNodes& fixed : model.fixed_nodes) {
        for (Index node : fixed.nodes) held_.push_back({node, fixed.freedoms, fixed.birth, fixed.death});
    }
    reaction_.resize(held_.size());
}

void Fixities::constrain(const Clock& clock, State& state)
{
    for (std::size_t i = 0; i < held_.size(); ++i) {
        const Held& held = held_[i];
        reaction_[i] = {};
        if (clock.time < held.birth || clock.time > held.death) continue;
        const Index node = held.node;
        reaction_[i].force = hold(state.force[node], state.velocity[node], state.mass[node], held.freedoms,
                                  clock.velocity_step(), stopped_energy_);
        if (!state.rotational()) continue;
        reaction_[i].moment = hold(state.moment[node], state.angular_velocity[node], state.inertia[node],
                                   held.freedoms >> 3, clock.velocity_step(), stopped_energy_);
    }
}

void Fixities::report(EnergyLedger& ledger) const
{
    ledger.external_work -= stopped_energy_;
}

void Fixities::collect(const State&, ElementResults& results) const
{
    if (!results.boundary_forces_wanted) return;
    for (std::size_t i = 0; i < held_.size(); ++i) {
        results.supports.push_back({held_[i].node, none, reaction_[i].force, reaction_[i].moment});
    }
}

void Fixities::stop_at_start(State& state) const
{
    for (const Held& held : held_) {
        if (held.birth > 0) continue;
        for (int axis = 0; axis < 3; ++axis) {
            if (held.freedoms >> axis & 1) state.velocity[held.node].*axes[axis] = 0;
            if (state.rotational() && (held.freedoms >> (axis + 3) & 1)) {
                state.angular_velocity[held.node].*axes[axis] = 0;
            }
        }
    }
}

} // namespace plash
