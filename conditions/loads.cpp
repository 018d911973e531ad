#include "conditions/loads.h"

#include "core/local_axes.h"
#include "core/prescribed_rate.h"

namespace plash {

NodalLoads::NodalLoads(const Model& model) : model_(model), last_(model.nodal_loads.size())
{
    for (const NodalLoad& load : model.nodal_loads) {
        count_ += load.nodes.size();
        work_.emplace_back(load.nodes.size());
    }
}

Vec3 NodalLoads::direction_of(const NodalLoad& load, const State& state) const
{
    if (load.follows[0] != none) {
        // Normal of the plane of the three nodes, or the line of two of them.
        const Vec3& a = state.position[load.follows[0]];
        const Vec3& b = state.position[load.follows[1]];
        if (load.follows[2] == none) return unit(b - a);
        return unit(cross(b - a, state.position[load.follows[2]] - a));
    }
    if (load.system == none) return load.direction;
    return axes_at(model_.coordinate_systems[load.system], state)[load.axis];
}

void NodalLoads::add_forces(const Clock& clock, State& state)
{
    for (std::size_t i = 0; i < last_.size(); ++i) {
        const NodalLoad& load = model_.nodal_loads[i];
        const auto& velocity = load.moment ? state.angular_velocity : state.velocity;
        auto& force = load.moment ? state.moment : state.force;
        if (load.moment && !state.rotational()) continue;
        const Vec3 now =
            load.scale * load_value(model_, load.curve, clock, clock.time) * direction_of(load, state);
        const Vec3 mean = 0.5 * (now + last_[i]);
        last_[i] = now;
        for (std::size_t k = 0; k < load.nodes.size(); ++k) {
            const Index node = load.nodes[k];
            work_[i][k] += dot(mean, velocity[node]) * clock.last_step;
            force[node] += now;
        }
    }
}

void NodalLoads::report(EnergyLedger& ledger) const
{
    for (const auto& load : work_) {
        for (double work : load) ledger.external_work += work;
    }
}

void NodalLoads::collect(const State&, ElementResults& results) const
{
    if (!results.boundary_forces_wanted) return;
    for (std::size_t i = 0; i < work_.size(); ++i) {
        const NodalLoad& load = model_.nodal_loads[i];
        for (std::size_t k = 0; k < load.nodes.size(); ++k) {
            ElementResults::BoundaryForce entry{load.nodes[k], none, {}, {}, work_[i][k]};
            (load.moment ? entry.moment : entry.force) = last_[i];
            results.loads.push_back(entry);
        }
    }
}

} // namespace plash
