#include "solver/cycle.h"

#include "core/run_error.h"
#include "rigid/rigid_bodies.h"
#include "solver/motion.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

using TermClock = std::chrono::steady_clock;

/// Calls one duty of every term and adds up the time that each takes.
template <class Duty>
void each_term(Scene& scene, std::vector<double>& seconds, Duty&& duty)
{
    for (std::size_t i = 0; i < scene.terms.size(); ++i) {
        const auto start = TermClock::now();
        duty(*scene.terms[i]);
        seconds[i] += std::chrono::duration<double>(TermClock::now() - start).count();
    }
}

/// Elements without stresses that move as a rigid body: the step that they asked for in the first cycle
/// stays theirs.
bool rests(const Scene& scene, const Clock& clock, const Term& term)
{
    if (!scene.switching || clock.last_step == 0) return false;
    const Index part = term.scaled_part();
    return part != none && scene.switching->switches().at_rest(part);
}

} // namespace

void sum_forces(Scene& scene, Clock& clock, StepControl& step_control, std::vector<double>& seconds)
{
    scene.state.clear_forces();
    each_term(scene, seconds, [&](Term& term) {
        if (!rests(scene, clock, term)) term.add_forces(clock, scene.state);
    });
    step_control.choose(clock, scene.terms);
}

void constrain_forces(Scene& scene, const Clock& clock, std::vector<double>& seconds)
{
    each_term(scene, seconds, [&](Term& term) { term.constrain(clock, scene.state); });
}

void move_nodes(Scene& scene, Clock& clock, std::vector<double>& seconds)
{
    advance_positions(clock, scene.state);
    each_term(scene, seconds, [&](Term& term) { term.after_motion(clock, scene.state); });
    clock.time += clock.step;
    clock.last_step = clock.step;
    ++clock.cycle;
}

void close_ledger(Scene& scene, double kinetic)
{
    scene.ledger.open_cycle(scene.model.parts.size());
    scene.ledger.kinetic = kinetic;
    for (const auto& term : scene.terms) term->report(scene.ledger);
    scene.ledger.close_cycle();
}

void check_finite(const Scene& scene)
{
    if (std::isfinite(scene.ledger.kinetic)) return;
    for (std::size_t node = 0; node < scene.state.size(); ++node) {
        const Vec3& velocity = scene.state.velocity[node];
        if (std::isfinite(dot(velocity, velocity))) continue;
        const Vec3& place = scene.model.nodes.position[node];
        throw RunError(fmt::format("node {} has no finite velocity any more (it started at ({:.6g}, {:.6g}, "
                                   "{:.6g})); the step may be too long or a material has failed",
                                   scene.model.nodes.id[node], place.x, place.y, place.z));
    }
    throw RunError("the kinetic energy is not a finite number any more");
}

} // namespace plash
