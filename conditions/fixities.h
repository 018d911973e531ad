#pragma once

#include "core/term.h"
#include "model/model.h"

#include <array>

namespace plash {

/// Degrees of freedom held at zero (*BOUNDARY_SPC, TC and RC of *NODE): the force on a held freedom is
/// replaced by what brings its velocity to zero in this step.
class Fixities : public Term {
public:
    explicit Fixities(const Model& model);

    std::string_view name() const override { return "fixities"; }
    std::size_t items() const override { return held_.size(); }
    void constrain(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override;
    void collect(const State& state, ElementResults& results) const override;

    bool empty() const { return held_.empty(); }
    /// Held freedoms start at rest.
    void stop_at_start(State& state) const;

private:
    struct Held {
        Index node;
        FreedomMask freedoms;
        double birth, death;
    };
    struct Reaction {
        Vec3 force, moment;
    };
    std::vector<Held> held_;
    std::vector<Reaction> reaction_; ///< like held_: force of the support on the node
    double stopped_energy_ = 0;      ///< kinetic energy taken when a support was born on a moving node
};

} // namespace plash
