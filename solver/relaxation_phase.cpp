#include "solver/relaxation_phase.h"

#include "conditions/relaxation.h"
#include "core/run_error.h"
#include "solver/cycle.h"
#include "solver/first_velocities.h"
#include "solver/motion.h"
#include "solver/step_control.h"

#include <algorithm>
#include <chrono>

namespace plash {

namespace {

const Relaxation& damping_of(const Scene& scene)
{
    for (const auto& term : scene.terms) {
        if (const auto* found = dynamic_cast<const Relaxation*>(term.get())) return *found;
    }
    throw RunError("the scene was set up without dynamic relaxation");
}

} // namespace

RelaxationOutcome relax(Scene& scene, std::vector<std::unique_ptr<Recorder>>& recorders,
                        const RunOptions& options, std::vector<double>& term_seconds)
{
    const RelaxationControls& control = scene.model.controls.relaxation;
    const double scale = value_or(control.step_scale, scene.model.controls.time.step_scale);
    const Relaxation& damping = damping_of(scene);
    StepControl step_control(scene.model, scale);
    FirstVelocities first(scene);
    State& state = scene.state;
    RelaxationOutcome outcome;
    outcome.ran = true;
    Clock clock;
    clock.relaxing = true;
    RelaxationLook look;
    double since_look = 0; // largest energy since the last look: at a turning point of a swing there is none
    const auto start = std::chrono::steady_clock::now();
    while (true) {
        sum_forces(scene, clock, step_control, term_seconds);
        constrain_forces(scene, clock, term_seconds);
        close_ledger(scene, advance_velocities(clock, state));
        check_finite(scene);

        since_look = std::max(since_look, damping.distortional_energy());
        look.energy = since_look;
        look.peak = std::max(look.peak, look.energy);
        look.ratio = look.peak > 0 ? look.energy / look.peak : 0;
        const bool stopped = options.stop_requested && *options.stop_requested;
        const bool timed_out = control.end_time > 0 && clock.time >= control.end_time;
        const bool due = clock.cycle > 0 && clock.cycle % control.check_cycles == 0;
        if (due || stopped || timed_out) {
            outcome.converged = due && look.ratio <= control.tolerance;
            look.last = outcome.converged || stopped || timed_out;
            const double seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            const Snapshot snapshot{scene.model,          clock,  state, scene.ledger, scene.terms,
                                    step_control.owner(), seconds};
            for (auto& recorder : recorders) recorder->write_relaxation(snapshot, look);
            since_look = 0;
        }
        if (look.last) break;
        move_nodes(scene, clock, term_seconds);
    }
    outcome.cycles = clock.cycle;
    outcome.time = clock.time;
    outcome.ratio = look.ratio;
    outcome.lost_kinetic = scene.ledger.kinetic;
    outcome.balance_error = scene.ledger.balance_error();
    first.restore();
    return outcome;
}

} // namespace plash
