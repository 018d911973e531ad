#include "solver/motion.h"

#include "core/parallel.h"

namespace plash {

namespace {

/// One kind of freedom: translations with masses or rotations with inertias.
double advance(const std::vector<Vec3>& force, const std::vector<double>& mass, std::vector<Vec3>& velocity,
               const Clock& clock)
{
    const double velocity_step = clock.velocity_step();
    const bool first = clock.last_step == 0;
    const double change = first ? 0 : clock.step_change();
    return sum_chunks(mass.size(), [&](std::size_t begin, std::size_t end) {
        double kinetic = 0;
        for (std::size_t node = begin; node < end; ++node) {
            if (mass[node] == 0) continue;
            const Vec3 before = velocity[node];
            const Vec3 after = before + (velocity_step / mass[node]) * force[node];
            velocity[node] = after;
            // The first velocity is that of n = 0; the force at 0 gives the one at -1/2 that belongs to it.
            const Vec3 half_step_before = first ? 2.0 * before - after : before;
            kinetic += 0.5 * mass[node] *
                       (dot(half_step_before, after) + change * (dot(after, after) - dot(before, before)));
        }
        return kinetic;
    });
}

} // namespace

double advance_velocities(const Clock& clock, State& state)
{
    double kinetic = advance(state.force, state.mass, state.velocity, clock);
    if (state.rotational()) {
        kinetic += advance(state.moment, state.inertia, state.angular_velocity, clock);
    }
    return kinetic;
}

void advance_positions(const Clock& clock, State& state)
{
    for_chunks(state.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t node = begin; node < end; ++node) {
            state.position[node] += clock.step * state.velocity[node];
        }
    });
}

} // namespace plash
