#include "conditions/loads.h"

#include "core/parallel.h"
#include "core/prescribed_rate.h"

namespace plash {

NodalLoads::NodalLoads(const Model& model) : model_(model), last_magnitude_(model.nodal_loads.size())
{
    for (const NodalLoad& load : model.nodal_loads) {
        count_ += load.nodes.size();
        work_.emplace_back(load.nodes.size());
    }
}

void NodalLoads::add_forces(const Clock& clock, State& state)
{
    for (std::size_t i = 0; i < last_magnitude_.size(); ++i) {
        const NodalLoad& load = model_.nodal_loads[i];
        const double magnitude = load.scale * curve_value(model_, load.curve, clock.time);
        const double mean = 0.5 * (magnitude + last_magnitude_[i]);
        last_magnitude_[i] = magnitude;
        const auto& velocity = load.moment ? state.angular_velocity : state.velocity;
        auto& force = load.moment ? state.moment : state.force;
        if (load.moment && !state.rotational()) continue;
        for (std::size_t k = 0; k < load.nodes.size(); ++k) {
            const Index node = load.nodes[k];
            work_[i][k] += mean * dot(load.direction, velocity[node]) * clock.last_step;
            force[node] += magnitude * load.direction;
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
        const Vec3 vector = last_magnitude_[i] * load.direction;
        for (std::size_t k = 0; k < load.nodes.size(); ++k) {
            ElementResults::BoundaryForce entry{load.nodes[k], none, {}, {}, work_[i][k]};
            (load.moment ? entry.moment : entry.force) = vector;
            results.loads.push_back(entry);
        }
    }
}

BodyLoads::BodyLoads(const Model& model, const State& state) : model_(model), mass_(state.mass)
{
    for (const BodyLoad& load : model.body_loads) {
        if (load.parts.empty()) return;
    }
    std::vector<bool> wanted(model.parts.size());
    for (const BodyLoad& load : model.body_loads) {
        for (Index part : load.parts) wanted[part] = true;
    }
    std::vector<bool> loaded(state.size());
    const auto mark = [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (!wanted[elements.part[i]]) continue;
            for (Index node : elements.nodes[i]) loaded[node] = true;
        }
    };
    mark(model.shells);
    mark(model.solids);
    for (std::size_t node = 0; node < mass_.size(); ++node) {
        if (!loaded[node]) mass_[node] = 0;
    }
}

Vec3 BodyLoads::acceleration(double time) const
{
    Vec3 sum{};
    for (const BodyLoad& load : model_.body_loads) {
        sum += (load.scale * curve_value(model_, load.curve, time)) * load.direction;
    }
    return sum;
}

void BodyLoads::add_forces(const Clock& clock, State& state)
{
    const Vec3 now = -acceleration(clock.time);
    const Vec3 mean = 0.5 * (now + last_acceleration_);
    last_acceleration_ = now;
    work_ += clock.last_step * sum_chunks(mass_.size(), [&](std::size_t begin, std::size_t end) {
                 Vec3 momentum{};
                 for (std::size_t node = begin; node < end; ++node) {
                     momentum += mass_[node] * state.velocity[node];
                     state.force[node] += mass_[node] * now;
                 }
                 return dot(mean, momentum);
             });
}

} // namespace plash
