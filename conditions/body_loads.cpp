#include "conditions/body_loads.h"

#include "core/parallel.h"
#include "core/prescribed_rate.h"

namespace plash {

namespace {

/// Every node of the elements, particles and masses of some parts.
std::vector<bool> nodes_of_parts(const Model& model, const std::vector<Index>& parts)
{
    std::vector<bool> wanted(model.parts.size()), loaded(model.nodes.size());
    for (Index part : parts) wanted[part] = true;
    for_each_topology(model, [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (!wanted[elements.part[i]]) continue;
            for (Index node : elements.nodes[i]) {
                if (node != none) loaded[node] = true;
            }
        }
    });
    for (std::size_t i = 0; i < model.particles.size(); ++i) {
        if (wanted[model.particles.part[i]]) loaded[model.particles.node[i]] = true;
    }
    return loaded;
}

/// Force per mass of a load on a node.
Vec3 force_of(const BodyLoad& load, double value, const Vec3& position, const Vec3& velocity)
{
    switch (load.kind) {
    case BodyLoad::Kind::translation:
        return -value * load.direction;
    case BodyLoad::Kind::centrifugal: {
        const Vec3 spin = value * load.direction;
        return -cross(spin, cross(spin, position - load.center));
    }
    case BodyLoad::Kind::coriolis:
        return -2 * value * cross(load.direction, velocity);
    case BodyLoad::Kind::angular_acceleration:
        return -value * cross(load.direction, position - load.center);
    }
    return {};
}

} // namespace

BodyLoads::BodyLoads(const Model& model, const State& state) : model_(model)
{
    for (const BodyLoad& load : model.body_loads) {
        const bool everywhere = load.parts.empty() && load.nodes.empty();
        if (everywhere && load.kind == BodyLoad::Kind::translation) {
            all_.loads.push_back(&load);
            continue;
        }
        std::vector<bool> loaded(model.nodes.size(), everywhere);
        if (!load.parts.empty()) loaded = nodes_of_parts(model, load.parts);
        for (Index node : load.nodes) loaded[node] = true;
        Local local{&load, {}, {}, {}};
        for (std::size_t node = 0; node < loaded.size(); ++node) {
            if (!loaded[node] || state.mass[node] == 0) continue;
            local.nodes.push_back(static_cast<Index>(node));
            local.mass.push_back(state.mass[node]);
        }
        local.last.resize(local.nodes.size());
        some_.push_back(std::move(local));
    }
    if (!all_.loads.empty()) all_.mass = state.mass;
}

void BodyLoads::add_everywhere(const Clock& clock, State& state)
{
    Vec3 sum{};
    for (const BodyLoad* load : all_.loads) {
        sum += body_load_value(model_, *load, clock) * load->direction;
    }
    const Vec3 now = -sum;
    const Vec3 mean = 0.5 * (now + all_.last_acceleration);
    all_.last_acceleration = now;
    work_ += clock.last_step * sum_chunks(all_.mass.size(), [&](std::size_t begin, std::size_t end) {
                 Vec3 momentum{};
                 for (std::size_t node = begin; node < end; ++node) {
                     momentum += all_.mass[node] * state.velocity[node];
                     state.force[node] += all_.mass[node] * now;
                 }
                 return dot(mean, momentum);
             });
}

void BodyLoads::add_local(const Clock& clock, Local& local, State& state)
{
    const double value = body_load_value(model_, *local.load, clock);
    work_ += clock.last_step * sum_chunks(local.nodes.size(), [&](std::size_t begin, std::size_t end) {
                 double power = 0;
                 for (std::size_t i = begin; i < end; ++i) {
                     const Index node = local.nodes[i];
                     const Vec3 force = local.mass[i] * force_of(*local.load, value, state.position[node],
                                                                 state.velocity[node]);
                     power += 0.5 * dot(force + local.last[i], state.velocity[node]);
                     local.last[i] = force;
                     state.force[node] += force;
                 }
                 return power;
             });
}

void BodyLoads::add_forces(const Clock& clock, State& state)
{
    if (!all_.loads.empty()) add_everywhere(clock, state);
    for (Local& local : some_) add_local(clock, local, state);
}

void BodyLoads::serialise(Archive& archive)
{
    archive(all_.last_acceleration, work_);
    for (Local& local : some_) archive(local.last);
}

} // namespace plash
