#include "conditions/relaxation.h"

#include "core/parallel.h"

namespace plash {

namespace {

/// What the loop over the nodes sums up.
struct RelaxationSums {
    double power = 0, energy = 0, mass = 0;
    Vec3 momentum{};

    RelaxationSums& operator+=(const RelaxationSums& other)
    {
        power += other.power;
        energy += other.energy;
        mass += other.mass;
        momentum += other.momentum;
        return *this;
    }
};

} // namespace

Relaxation::Relaxation(const Model& model, const State& state) : factor_(model.controls.relaxation.factor)
{
    const std::vector<Index>& parts = model.controls.relaxation.parts;
    std::vector<bool> wanted(model.parts.size(), parts.empty());
    for (Index part : parts) wanted[part] = true;
    std::vector<bool> decides(model.nodes.size(), parts.empty());
    if (!parts.empty()) {
        for_each_topology(model, [&](const auto& elements) {
            for (std::size_t i = 0; i < elements.size(); ++i) {
                if (!wanted[elements.part[i]]) continue;
                for (Index node : elements.nodes[i]) {
                    if (node != none) decides[node] = true;
                }
            }
        });
    }
    for (std::size_t node = 0; node < state.size(); ++node) {
        const double inertia = state.rotational() ? state.inertia[node] : 0;
        if (state.mass[node] + inertia == 0) continue;
        nodes_.push_back({static_cast<Index>(node), state.mass[node], inertia, decides[node]});
    }
    force_.resize(nodes_.size());
    if (state.rotational()) moment_.resize(nodes_.size());
}

void Relaxation::constrain(const Clock& clock, State& state)
{
    if (!clock.relaxing) return;
    const double rate = (1 - factor_) / clock.velocity_step();
    std::vector<RelaxationSums> partial((nodes_.size() + chunk_length - 1) / chunk_length);
    for_chunks(nodes_.size(), [&](std::size_t begin, std::size_t end) {
        RelaxationSums& sums = partial[begin / chunk_length];
        for (std::size_t i = begin; i < end; ++i) {
            const Node& node = nodes_[i];
            const Vec3& velocity = state.velocity[node.node];
            const Vec3 force = (-rate * node.mass) * velocity;
            sums.power += dot(force + force_[i], velocity);
            force_[i] = force;
            state.force[node.node] += force;
            if (!moment_.empty()) {
                const Vec3& spin = state.angular_velocity[node.node];
                const Vec3 moment = (-rate * node.inertia) * spin;
                sums.power += dot(moment + moment_[i], spin);
                moment_[i] = moment;
                state.moment[node.node] += moment;
            }
            if (!node.decides) continue;
            sums.energy += 0.5 * node.mass * dot(velocity, velocity);
            sums.mass += node.mass;
            sums.momentum += node.mass * velocity;
        }
    });
    RelaxationSums sums;
    for (const RelaxationSums& part : partial) sums += part;
    work_ += 0.5 * clock.last_step * sums.power;
    const double whole = sums.mass > 0 ? 0.5 * dot(sums.momentum, sums.momentum) / sums.mass : 0;
    distortional_ = sums.energy - whole;
}

} // namespace plash
