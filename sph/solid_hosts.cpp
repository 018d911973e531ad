#include "sph/solid_hosts.h"

#include "model/measures.h"

#include <algorithm>

namespace plash {

SolidHosts::SolidHosts(const Model& model, State& state) : model_(&model)
{
    if (model.stand_ins.empty()) return;
    state.keeps_lost_solids = true;
    host_of_node_.assign(state.size(), none);
    host_of_solid_.assign(model.solids.size(), none);
    for (const StandIns& stand_ins : model.stand_ins) {
        Host host;
        host.stand_ins = stand_ins;
        const auto& nodes = model.solids.nodes[stand_ins.solid];
        host.weights = stand_in_weights(nodes, stand_ins.per_edge);
        host.volume = solid_volume(nodes, model.nodes.position);
        const auto number = static_cast<Index>(hosts_.size());
        host_of_solid_[stand_ins.solid] = number;
        std::fill_n(host_of_node_.begin() + first_node(host), host.weights.size(), number);
        hosts_.push_back(std::move(host));
    }
}

std::vector<std::pair<Index, LostSolid>> SolidHosts::take_lost(State& state)
{
    std::vector<std::pair<Index, LostSolid>> taken;
    for (LostSolid& lost : state.lost_solids) {
        const Index number = host_of_solid_[lost.solid];
        if (number == none) continue;
        hosts_[number].lost = true;
        taken.emplace_back(number, std::move(lost));
    }
    state.lost_solids.clear();
    return taken;
}

SolidHosts::Motion SolidHosts::motion_of(Index node, const State& state) const
{
    const auto& nodes = model_->solids.nodes[host_of(node).stand_ins.solid];
    const auto& weights = weights_of(node);
    Motion motion;
    for (int i = 0; i < 8; ++i) {
        motion.position += weights[i] * state.position[nodes[i]];
        motion.velocity += weights[i] * state.velocity[nodes[i]];
    }
    return motion;
}

double SolidHosts::relative_volume(const Host& host, const State& state) const
{
    constexpr double smallest = 0.3, largest = 3; // a solid that has turned inside out has no volume
    const double now = solid_volume(model_->solids.nodes[host.stand_ins.solid], state.position);
    return std::clamp(now / host.volume, smallest, largest);
}

void SolidHosts::pass_on(const Vec3& force, Index node, State& state) const
{
    const auto& nodes = model_->solids.nodes[host_of(node).stand_ins.solid];
    const auto& weights = weights_of(node);
    for (int i = 0; i < 8; ++i) state.force[nodes[i]] += weights[i] * force;
}

void SolidHosts::serialise(Archive& archive)
{
    for (Host& host : hosts_) archive(host.lost);
}

} // namespace plash
