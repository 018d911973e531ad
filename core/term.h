#pragma once

#include "core/archive.h"
#include "core/clock.h"
#include "core/energy_ledger.h"
#include "core/results.h"
#include "core/selective_masses.h"
#include "core/state.h"

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace plash {

/// A stable step with who asks for it.
struct StepVote {
    double step = std::numeric_limits<double>::infinity(); ///< [time], before the deck's safety factor
    std::string_view kind{};                               ///< "shell", "solid" ...
    Id element = 0;
    Id part = 0;

    static StepVote nothing() { return {}; }
};

template <>
inline constexpr bool is_plain<StepVote> = false; // its `kind` is an address

/// One physical effect: an element group, a wall, a load, a constraint. The loop knows physics only as terms.
/// Several calls of one kind never overlap; a term parallelises inside its own call.
class Term {
public:
    virtual ~Term() = default;

    /// As shown in timings and step reports.
    virtual std::string_view name() const = 0;

    /// Number of things (elements, nodes, particles) the term works on each cycle.
    virtual std::size_t items() const { return 0; }

    /// Adds this term's forces and moments at t_n to the state, and integrates its own energies over the last
    /// step: work = (mean of the forces at n-1 and n) . velocity(n-1/2) * last_step.
    virtual void add_forces(const Clock&, State&) {}

    /// Changes summed forces so that the velocities they lead to are admissible (fixities, walls, rigid
    /// bodies); clock.step is known here. Terms act in the order of the scene.
    virtual void constrain(const Clock&, State&) {}

    /// After positions have moved to n+1: remap, erosion, moving domains.
    virtual void after_motion(const Clock&, State&) {}

    /// Largest stable step at t_n; valid after add_forces.
    virtual StepVote stable_step() const { return StepVote::nothing(); }

    /// Adds mass to the State so that no stable step of this term is below `step` (DT2MS); with `only_small`
    /// false also takes mass away where it is longer. Called once, before the first cycle. Returns the added
    /// mass.
    virtual double scale_mass(double /*step*/, bool /*only_small*/, State&) { return 0; }

    /// As scale_mass, but lists the mass that would be added instead of adding it. False: this term cannot,
    /// and nothing has changed.
    virtual bool scale_selectively(double /*step*/, bool /*only_small*/, const State&, SelectiveMasses&)
    {
        return false;
    }

    /// The part whose elements this term has; none: it is not that kind of term.
    virtual Index scaled_part() const { return none; }

    /// Adds the freedoms whose acceleration `constrain` will set in this cycle whatever the forces are.
    virtual void list_held(const Clock&, const State&, std::vector<HeldFreedom>&) const {}

    /// What the user should know before the first cycle, a line each (initial penetrations and the like);
    /// called once the whole scene is there.
    virtual std::vector<std::string> notices(const State&) const { return {}; }

    /// A run begins with dynamic relaxation, at rest (`relaxing`), or goes on from there to the transient
    /// phase, at time 0 with the places and forces that were found and the velocities of the start: whoever
    /// keeps velocities of its own sets them.
    virtual void begin_phase(bool /*relaxing*/, State&) {}

    /// Books every energy this term holds or has spent so far.
    virtual void report(EnergyLedger&) const {}

    /// Saves or loads what this term carries from cycle to cycle beyond the State, as it stands between two
    /// cycles (positions at n, before add_forces). Loading comes after the scene was built from the same
    /// deck, so whatever the constructor makes need not be saved. Default: nothing.
    virtual void serialise(Archive&) {}

    /// Fills the arrays that the recorder has sized.
    virtual void collect(const State&, ElementResults&) const {}
};

} // namespace plash
