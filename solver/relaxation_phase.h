#pragma once

#include "core/recorder.h"
#include "solver/explicit_loop.h"

namespace plash {

/// Runs the phase of dynamic relaxation (*CONTROL_DYNAMIC_RELAXATION) of a scene that has just been set up:
/// from rest, with the loads whose curves act in it, until the kinetic energy of the distortion, the
/// largest in NRCYCK cycles, has fallen below DRTOL of its peak or DRTERM has come. Leaves the state with the
/// places that were found, the velocities of the start, and an energy book that begins anew.
///
/// The time of the phase is its own; that of the run begins at 0 afterwards, as in LS-DYNA.
/// term_seconds  by term of the scene; what each takes is added
RelaxationOutcome relax(Scene& scene, std::vector<std::unique_ptr<Recorder>>& recorders,
                        const RunOptions& options, std::vector<double>& term_seconds);

} // namespace plash
