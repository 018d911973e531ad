#pragma once

#include "core/clock.h"
#include "core/energy_ledger.h"
#include "core/state.h"
#include "core/term.h"
#include "model/model.h"

#include <memory>
#include <vector>

namespace plash {

/// What recorders may look at when they write: everything, changing nothing.
struct Snapshot {
    const Model& model;
    const Clock& clock;
    const State& state; ///< positions at n, velocities at n+1/2, accelerations below
    const EnergyLedger& ledger;
    const std::vector<std::unique_ptr<Term>>& terms;
    const StepVote& step_owner; ///< who limited the step
    double wall_seconds = 0;    ///< since the loop began

    /// Fills `results` from all terms.
    void collect(ElementResults& results) const;
};

/// How far dynamic relaxation has come at one of its looks.
struct RelaxationLook {
    double energy = 0; ///< kinetic, without that of the motion as a whole [energy]
    double peak = 0;   ///< the largest so far [energy]
    double ratio = 0;  ///< energy over peak [-]
    bool last = false; ///< the phase ends here
};

/// Whoever writes results. The loop knows output only as recorders.
class Recorder {
public:
    virtual ~Recorder() = default;

    /// Next time at which this recorder wants a snapshot [time]. As in LS-DYNA it is due in the last cycle
    /// that does not pass this time: t_n <= next_time() < t_n + clock.step.
    virtual double next_time() const = 0;
    /// Writes one state; called when next_time() has come, at the start and at the end.
    virtual void write(const Snapshot&) = 0;
    /// Called in every cycle after its snapshots, for what is summed over cycles (angles of rotation).
    virtual void follow(const Clock&, const State&) {}
    /// Called at each look of dynamic relaxation at its convergence, before the run proper.
    virtual void write_relaxation(const Snapshot&, const RelaxationLook&) {}
    /// A state now, whatever is due (sense switch sw4); for recorders of whole states.
    virtual void write_on_request(const Snapshot&) {}
    /// Saves or loads what the recorder carries from cycle to cycle, and how much of its files belongs to the
    /// run so far: loading cuts off what was written later.
    virtual void serialise(Archive&) {}
    /// After the last write; the run ended normally or not.
    virtual void finish(const Snapshot&) {}
};

} // namespace plash
