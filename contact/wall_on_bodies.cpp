#include "contact/wall_on_bodies.h"

#include "core/parallel.h"

#include <algorithm>

namespace plash {

namespace {

/// Spring of a node over its mass / dt^2: a flat impact then takes pi / sqrt(0.1) = 10 steps, and speed comes
/// back within half a percent.
constexpr double spring_share = 0.1;

} // namespace

WallOnBodies::WallOnBodies(const PlanarWall& wall, const Model& model, const State& state) : wall_(wall)
{
    std::vector<bool> candidate(state.size(), wall.all_nodes);
    for (Index node : wall.nodes) candidate[node] = true;
    for (Index node : wall.excluded) candidate[node] = false;
    for (std::size_t node = 0; node < state.size(); ++node) {
        const double gap = dot(model.nodes.position[node] - wall.tail, wall.normal);
        if (wall.offset > 0 && gap > wall.offset) continue;
        if (!candidate[node] || state.mass[node] == 0) continue;
        nodes_.push_back(static_cast<Index>(node));
        mass_.push_back(state.mass[node]);
    }
    force_.resize(nodes_.size());
}

void WallOnBodies::add_forces(const Clock& clock, State& state)
{
    if (clock.last_step == 0) return; // the step is not known yet
    // A step that has grown needs softer springs to stay stable.
    if (reference_step_ == 0 || clock.last_step > 1.5 * reference_step_) reference_step_ = clock.last_step;
    const double per_mass = spring_share / (reference_step_ * reference_step_);
    const bool alive = clock.time >= wall_.birth && clock.time <= wall_.death;
    work_ += sum_chunks(nodes_.size(), [&](std::size_t begin, std::size_t end) {
        double work = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const Index node = nodes_[i];
            if (state.mass[node] != 0) continue; // moved by the loop: the wall stops it
            const Vec3 last = force_[i];
            Vec3 force{};
            const double gap = dot(state.position[node] - wall_.tail, wall_.normal);
            if (alive && gap < 0) {
                const double normal = -mass_[i] * per_mass * gap;
                force = normal * wall_.normal;
                const Vec3& velocity = state.velocity[node];
                const Vec3 sliding = velocity - dot(velocity, wall_.normal) * wall_.normal;
                const double speed = norm(sliding);
                if (wall_.friction > 0 && speed > 0) {
                    const double stopping = mass_[i] * speed / clock.last_step;
                    const double limit = wall_.friction >= 1 ? stopping : wall_.friction * normal;
                    force -= (std::min(stopping, limit) / speed) * sliding;
                }
            }
            work += 0.5 * clock.last_step * dot(force + last, state.velocity[node]);
            state.force[node] += force;
            force_[i] = force;
        }
        return work;
    });
}

void WallOnBodies::collect(const State&, ElementResults& results) const
{
    Vec3 sum{};
    for (const Vec3& force : force_) sum -= force;
    ElementResults::WallForce own{wall_.id, -dot(sum, wall_.normal), sum, -work_};
    // The wall's own term stands just before this one: its row is the last.
    if (results.walls.empty() || results.walls.back().wall != wall_.id) {
        results.walls.push_back(own);
        return;
    }
    ElementResults::WallForce* row = &results.walls.back();
    row->normal += own.normal;
    row->force += own.force;
    row->energy += own.energy;
}

} // namespace plash
