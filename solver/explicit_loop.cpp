#include "solver/explicit_loop.h"

#include "core/run_error.h"
#include "solver/motion.h"
#include "solver/step_control.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

using WallClock = std::chrono::steady_clock;

double seconds_since(WallClock::time_point start)
{
    return std::chrono::duration<double>(WallClock::now() - start).count();
}

/// Calls one duty of every term and adds up the time that each takes.
template <class Duty>
void each_term(Scene& scene, std::vector<double>& seconds, Duty&& duty)
{
    for (std::size_t i = 0; i < scene.terms.size(); ++i) {
        const auto start = WallClock::now();
        duty(*scene.terms[i]);
        seconds[i] += seconds_since(start);
    }
}

void close_ledger(Scene& scene, double kinetic)
{
    scene.ledger.open_cycle(scene.model.parts.size());
    scene.ledger.kinetic = kinetic;
    for (const auto& term : scene.terms) term->report(scene.ledger);
    scene.ledger.close_cycle();
}

/// A kinetic energy that is not a number: says at which node it began.
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

/// Writes what falls due before the next step would pass it, as LS-DYNA does.
void write_due(Recorders& recorders, const Snapshot& snapshot)
{
    const Clock& clock = snapshot.clock;
    for (auto& recorder : recorders) {
        if (clock.time + clock.step > recorder->next_time()) recorder->write(snapshot);
    }
}

} // namespace

Outcome run(Scene& scene, Recorders& recorders, const RunOptions& options)
{
    const TimeControls& control = scene.model.controls.time;
    Outcome outcome;
    outcome.term_seconds.resize(scene.terms.size());
    outcome.end_time = std::min(control.end_time, options.end_time);
    const auto start = WallClock::now();
    State& state = scene.state;
    Clock& clock = outcome.clock;
    StepControl step_control(scene.model);
    const auto snapshot = [&] {
        return Snapshot{scene.model,         clock, state, scene.ledger, scene.terms, step_control.owner(),
                        seconds_since(start)};
    };

    try {
        while (true) {
            state.clear_forces();
            each_term(scene, outcome.term_seconds, [&](Term& term) { term.add_forces(clock, state); });
            step_control.choose(clock, scene.terms);
            each_term(scene, outcome.term_seconds, [&](Term& term) { term.constrain(clock, state); });
            const double kinetic = advance_velocities(clock, state);
            close_ledger(scene, kinetic);
            check_finite(scene);
            write_due(recorders, snapshot());

            const bool stop = options.stop_requested && options.stop_requested->load();
            const bool last_cycle = control.end_cycle > 0 && clock.cycle >= control.end_cycle;
            if (stop) outcome.termination = Outcome::Termination::stopped;
            if (stop) outcome.message = "stopped on request";
            if (stop || last_cycle || clock.time >= outcome.end_time) break;

            for (auto& recorder : recorders) recorder->follow(clock, state);
            advance_positions(clock, state);
            each_term(scene, outcome.term_seconds, [&](Term& term) { term.after_motion(clock, state); });
            clock.time += clock.step;
            clock.last_step = clock.step;
            ++clock.cycle;
        }
    } catch (const RunError& error) {
        state.clear_forces(); // half-summed forces are no accelerations for the recorders' last state
        outcome.termination = Outcome::Termination::error;
        outcome.message = error.what();
    }
    for (auto& recorder : recorders) {
        try {
            recorder->finish(snapshot());
        } catch (const RunError& error) { // a full disk must not keep the other files from their end
            if (outcome.termination != Outcome::Termination::error) outcome.message = error.what();
            outcome.termination = Outcome::Termination::error;
        }
    }
    outcome.first_step = step_control.first_step();
    outcome.last_step = clock.step;
    outcome.wall_seconds = seconds_since(start);
    return outcome;
}

} // namespace plash
