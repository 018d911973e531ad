#include "solver/explicit_loop.h"

#include "core/run_error.h"
#include "solver/cycle.h"
#include "solver/motion.h"
#include "solver/prescribed_geometry.h"
#include "solver/relaxation_phase.h"
#include "solver/restart.h"
#include "solver/sense_switches.h"
#include "solver/static_phase.h"
#include "solver/step_control.h"
#include "solver/terminations.h"

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

/// Writes what falls due before the next step would pass it, as LS-DYNA does.
void write_due(Recorders& recorders, const Snapshot& snapshot)
{
    const Clock& clock = snapshot.clock;
    for (auto& recorder : recorders) {
        if (clock.time + clock.step > recorder->next_time()) recorder->write(snapshot);
    }
}

/// What a person or the deck asks for between two cycles.
struct Requests {
    bool ended = false;      ///< the deck ends the run after the next cycle
    bool stop = false;       ///< a person does
    bool plot_state = false; ///< write one in the next cycle
};

bool at_end(const Scene& scene, const Outcome& outcome)
{
    const long last_cycle = scene.model.controls.time.end_cycle;
    return scene.model.controls.time.no_solution || outcome.clock.time >= outcome.end_time ||
           (last_cycle > 0 && outcome.clock.cycle >= last_cycle);
}

/// Writes the restart files that fall due, and does what sense switches ask for.
Requests between_cycles(RestartFiles& files, SenseSwitches& switches, const RunParts& run)
{
    Requests requests;
    Outcome& outcome = run.outcome;
    files.write_due(run);
    if (const auto reason = run.terminations.reason(outcome.clock)) {
        requests.ended = true;
        outcome.message = *reason;
    }
    if (run.scene.model.controls.output.restart.dump_cycles > 0 && at_end(run.scene, outcome)) {
        files.write_dump(run);
    }
    switch (switches.poll()) {
    case SenseSwitch::none:
        break;
    case SenseSwitch::end_with_restart_file:
        requests.stop = true;
        outcome.message = "stopped on request";
        if (files.on()) outcome.message += "; goes on with --restart " + files.write_dump(run);
        break;
    case SenseSwitch::tell_time:
        fmt::print("\n  cycle {}   t = {:.6e}   step {:.4e}\n", outcome.clock.cycle, outcome.clock.time,
                   outcome.clock.last_step);
        break;
    case SenseSwitch::restart_file:
        files.write_dump(run);
        break;
    case SenseSwitch::plot_state:
        requests.plot_state = true;
        break;
    case SenseSwitch::end_with_plot_state:
        requests.stop = requests.plot_state = true;
        outcome.message = "stopped on request";
        break;
    }
    return requests;
}

/// What the deck wants before the run, by IDRFLG.
RelaxationOutcome begin_at_rest(Scene& scene, Recorders& recorders, const RunOptions& options,
                                std::vector<double>& term_seconds)
{
    if (asks_for_statics(scene.model)) return find_equilibrium(scene, recorders, term_seconds);
    if (scene.model.controls.relaxation.flag == 2)
        return move_to_geometry(scene, options.geometry, recorders, term_seconds);
    return relax(scene, recorders, options, term_seconds);
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
    Terminations terminations(scene);
    const RunParts parts{scene, step_control, terminations, outcome, recorders};
    scene.ledger.open_cycle(scene.model.parts.size()); // for recorders, should the first cycle fail
    const bool restarted = !options.restart_from.empty();
    const int last_dump = restarted ? load_run(options.restart_from, parts) : 0;
    RestartFiles restart_files(options.restart, scene.model.controls.output.restart, last_dump);
    SenseSwitches switches(options.restart.directory, options.stop_requested);
    const double wall_before = outcome.wall_seconds;
    const auto snapshot = [&] {
        outcome.wall_seconds = wall_before + seconds_since(start);
        return Snapshot{scene.model,         clock, state, scene.ledger, scene.terms, step_control.owner(),
                        outcome.wall_seconds};
    };

    try {
        Requests requests;
        if (control.no_solution) outcome.message = "ends after the first cycle's forces (NOSOL)";
        if (scene.model.controls.relaxation.active() && !restarted && !control.no_solution)
            outcome.relaxation = begin_at_rest(scene, recorders, options, outcome.term_seconds);
        while (true) {
            sum_forces(scene, clock, step_control, outcome.term_seconds);
            constrain_forces(scene, clock, outcome.term_seconds);
            const double kinetic = advance_velocities(clock, state);
            close_ledger(scene, kinetic);
            check_finite(scene);
            write_due(recorders, snapshot());
            if (requests.plot_state) {
                for (auto& recorder : recorders) recorder->write_on_request(snapshot());
            }
            if (requests.stop) outcome.termination = Outcome::Termination::stopped;
            if (requests.stop || requests.ended || at_end(scene, outcome)) break;

            for (auto& recorder : recorders) recorder->follow(clock, state);
            move_nodes(scene, clock, outcome.term_seconds);
            requests = between_cycles(restart_files, switches, parts);
        }
    } catch (const RunError& error) {
        state.clear_forces(); // half-summed forces are no accelerations for the recorders' last state
        outcome.termination = Outcome::Termination::error;
        outcome.message = error.what();
        if (!restart_files.last_written().empty()) {
            outcome.message += "; the last restart file is " + restart_files.last_written();
        }
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
    outcome.wall_seconds = wall_before + seconds_since(start);
    return outcome;
}

} // namespace plash
