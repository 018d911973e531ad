#include "contact/planar_wall.h"

#include "core/parallel.h"

#include <algorithm>

namespace plash {

PlanarWallTerm::PlanarWallTerm(const PlanarWall& wall, const Model& model, const State& state) : wall_(wall)
{
    std::vector<bool> candidate(state.size(), wall.all_nodes);
    for (Index node : wall.nodes) candidate[node] = true;
    for (Index node : wall.excluded) candidate[node] = false;
    for (std::size_t node = 0; node < state.size(); ++node) {
        const double gap = dot(model.nodes.position[node] - wall.tail, wall.normal);
        if (wall.offset > 0 && gap > wall.offset) continue;
        if (candidate[node] && state.mass[node] > 0) nodes_.push_back(static_cast<Index>(node));
    }
    if (wall.friction == 2) stuck_.resize(nodes_.size());
}

void PlanarWallTerm::constrain(const Clock& clock, State& state)
{
    force_ = {};
    if (clock.time < wall_.birth || clock.time > wall_.death) {
        work_.add(0, clock.last_step, 0, clock.step);
        return;
    }
    struct Sums {
        Vec3 force{};
        double power_before = 0, power_after = 0;
    };
    std::vector<Sums> partial((nodes_.size() + chunk_length - 1) / chunk_length);
    const double velocity_step = clock.velocity_step();
    for_chunks(nodes_.size(), [&](std::size_t begin, std::size_t end) {
        Sums& sums = partial[begin / chunk_length];
        for (std::size_t i = begin; i < end; ++i) {
            const Index node = nodes_[i];
            const double mass = state.mass[node];
            if (mass == 0) continue;
            const double gap = dot(state.position[node] - wall_.tail, wall_.normal);
            const Vec3 free_velocity = state.velocity[node] + (velocity_step / mass) * state.force[node];
            const double approach = dot(free_velocity, wall_.normal);
            const bool held = !stuck_.empty() && stuck_[i];
            if (gap + approach * clock.step >= 0 && !held) continue;

            const double landing = gap > 0 ? -gap / clock.step : 0.0;
            const double normal_force = mass * (landing - approach) / velocity_step;
            Vec3 force = normal_force * wall_.normal;
            const Vec3 sliding = free_velocity - approach * wall_.normal;
            const double speed = norm(sliding);
            if (wall_.friction > 0 && speed > 0) {
                const double stopping = mass * speed / velocity_step;
                const double limit = wall_.friction >= 1 ? stopping : wall_.friction * std::abs(normal_force);
                force -= (std::min(stopping, limit) / speed) * sliding;
            }
            if (!stuck_.empty()) stuck_[i] = true;
            const Vec3 next = free_velocity + (velocity_step / mass) * force;
            sums.power_before += dot(force, state.velocity[node]);
            sums.power_after += dot(force, next);
            sums.force -= force;
            state.force[node] += force;
        }
    });
    double power_before = 0, power_after = 0;
    for (const Sums& sums : partial) {
        force_ += sums.force;
        power_before += sums.power_before;
        power_after += sums.power_after;
    }
    work_.add(power_before, clock.last_step, power_after, clock.step);
}

void PlanarWallTerm::collect(const State&, ElementResults& results) const
{
    results.walls.push_back({wall_.id, -dot(force_, wall_.normal), force_, -work_.done});
}

} // namespace plash
