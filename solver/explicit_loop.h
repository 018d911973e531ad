#pragma once

#include "core/recorder.h"
#include "model/displacement.h"
#include "solver/scene.h"

#include <atomic>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace plash {

using Recorders = std::vector<std::unique_ptr<Recorder>>;

/// Where restart files go, and how often one is written though the deck does not ask for it.
struct RestartOptions {
    std::string directory; ///< empty: none are written, and no sense switch is looked for
    double minutes = 0;    ///< of wall clock between runrsf files; 0: as the deck says
};

/// How and how far to run.
struct RunOptions {
    double end_time = std::numeric_limits<double>::infinity(); ///< overrides a later ENDTIM [time]
    const std::atomic<bool>* stop_requested = nullptr;         ///< set from outside (Ctrl-C) to end in order
    RestartOptions restart;
    std::string restart_from; ///< path of the restart file with which the run goes on; empty: from the start
    std::vector<NodeDisplacement> geometry; ///< IDRFLG = 2: with which the run begins
};

/// What dynamic relaxation before the run came to.
struct RelaxationOutcome {
    bool ran = false;
    bool converged = false; ///< else it was ended by DRTERM, or on request
    long cycles = 0;
    double time = 0;          ///< of the phase [time]
    double ratio = 0;         ///< kinetic energy of the distortion over its peak
    double lost_kinetic = 0;  ///< thrown away at its end [energy]
    double balance_error = 0; ///< of the phase, as EnergyLedger::balance_error
    bool geometry = false;    ///< the nodes went to a prescribed geometry (IDRFLG = 2)
    bool statics = false;     ///< an equilibrium was solved for (IDRFLG = 5); then these count:
    double reference = 0;     ///< what accelerations are measured by [acceleration]
    double first_acceleration = 0, last_acceleration = 0; ///< the largest, over the reference [-]
    double last_angular = 0;       ///< the largest of nodes that turn, by their radius of gyration [-]
    double fluid_acceleration = 0; ///< the largest of Eulerian fluids, over the reference [-]
    Vec3 fluid_place{};            ///< where that is [length]

    /// Below this, relative to the reference, a start counts as one at rest.
    static constexpr double allowed_unrest = 1e-4;
};

/// How a run ended, and what it took.
struct Outcome {
    enum class Termination { normal, error, stopped };
    Termination termination = Termination::normal;
    std::string message;
    Clock clock;
    double end_time = 0;
    double first_step = 0;
    double last_step = 0;
    RelaxationOutcome relaxation;
    double wall_seconds = 0;          ///< of all parts of a run that was restarted
    std::vector<double> term_seconds; ///< by term of the scene
};

/// Central difference in LS-DYNA's staggering: velocities at n+1/2, positions and forces at n
/// (Hallquist 2006, chapter 'Time integration').
Outcome run(Scene& scene, Recorders& recorders, const RunOptions& options = {});

} // namespace plash
