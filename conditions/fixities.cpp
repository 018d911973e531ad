#include "conditions/fixities.h"

#include "core/local_axes.h"

namespace plash {

namespace {

/// Replaces the held components of `force` by what stops `velocity` within `velocity_step`; returns the
/// reaction and adds the kinetic energy that is stopped. `axes`: null for the global ones.
Vec3 hold(Vec3& force, const Vec3& velocity, double mass, FreedomMask freedoms,
          const std::array<Vec3, 3>* axes, double velocity_step, double& stopped_energy)
{
    Vec3 reaction{};
    if (mass == 0) return reaction; // a node of a rigid body: the body holds it
    for (int axis = 0; axis < 3; ++axis) {
        if (!(freedoms >> axis & 1)) continue;
        const double v = axes ? dot(velocity, (*axes)[axis]) : velocity.*vector_component[axis];
        const double needed = v == 0 ? 0 : -mass * v / velocity_step;
        stopped_energy += 0.5 * mass * v * v;
        if (axes) {
            const Vec3 added = (needed - dot(force, (*axes)[axis])) * (*axes)[axis];
            reaction += added;
            force += added;
        } else {
            reaction.*vector_component[axis] = needed - force.*vector_component[axis];
            force.*vector_component[axis] = needed;
        }
    }
    return reaction;
}

void stop(Vec3& velocity, FreedomMask freedoms, const std::array<Vec3, 3>* axes)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (!(freedoms >> axis & 1)) continue;
        if (axes) {
            velocity -= dot(velocity, (*axes)[axis]) * (*axes)[axis];
        } else {
            velocity.*vector_component[axis] = 0;
        }
    }
}

} // namespace

Fixities::Fixities(const Model& model) : model_(model)
{
    for (const FixedNodes& fixed : model.fixed_nodes) {
        Index axes = none;
        if (fixed.system != none || fixed.local) {
            axes = static_cast<Index>(axes_.size());
            const bool moves =
                fixed.system != none && model.coordinate_systems[fixed.system].nodes[0] != none;
            axes_.push_back(fixed.system != none ? model.coordinate_systems[fixed.system].axes : fixed.axes);
            axes_system_.push_back(moves ? fixed.system : none);
        }
        for (Index node : fixed.nodes)
            held_.push_back({node, fixed.freedoms, axes, fixed.birth, fixed.death});
    }
    reaction_.resize(held_.size());
}

Fixities::Axes Fixities::axes_now(Index axes, const State& state) const
{
    const Index system = axes_system_[axes];
    return system == none ? axes_[axes] : axes_at(model_.coordinate_systems[system], state);
}

void Fixities::turn_axes(const State& state)
{
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        axes_[i] = axes_now(static_cast<Index>(i), state);
    }
}

void Fixities::constrain(const Clock& clock, State& state)
{
    turn_axes(state);
    for (std::size_t i = 0; i < held_.size(); ++i) {
        const Held& held = held_[i];
        reaction_[i] = {};
        if (!acts(held, clock)) continue;
        const Index node = held.node;
        const Axes* axes = held.axes == none ? nullptr : &axes_[held.axes];
        reaction_[i].force = hold(state.force[node], state.velocity[node], state.mass[node], held.freedoms,
                                  axes, clock.velocity_step(), stopped_energy_);
        if (!state.rotational()) continue;
        reaction_[i].moment = hold(state.moment[node], state.angular_velocity[node], state.inertia[node],
                                   held.freedoms >> 3, axes, clock.velocity_step(), stopped_energy_);
    }
}

void Fixities::list_held(const Clock& clock, const State& state, std::vector<HeldFreedom>& list) const
{
    constexpr Axes global{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (const Held& held : held_) {
        if (!acts(held, clock)) continue;
        const Axes axes = held.axes == none ? global : axes_now(held.axes, state);
        for (int freedom = 0; freedom < (state.rotational() ? 6 : 3); ++freedom) {
            if (!(held.freedoms >> freedom & 1)) continue;
            const bool rotation = freedom >= 3;
            const Vec3& direction = axes[freedom % 3];
            const Vec3& velocity = (rotation ? state.angular_velocity : state.velocity)[held.node];
            list.push_back(
                {held.node, rotation, direction, -dot(velocity, direction) / clock.velocity_step()});
        }
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

void Fixities::stop_at_start(State& state)
{
    turn_axes(state);
    for (const Held& held : held_) {
        if (held.birth > 0) continue;
        const Axes* axes = held.axes == none ? nullptr : &axes_[held.axes];
        stop(state.velocity[held.node], held.freedoms, axes);
        if (state.rotational()) stop(state.angular_velocity[held.node], held.freedoms >> 3, axes);
    }
}

} // namespace plash
