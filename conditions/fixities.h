#pragma once

#include "core/term.h"
#include "model/model.h"

#include <array>

namespace plash {

/// Degrees of freedom held at zero (*BOUNDARY_SPC, TC and RC of *NODE, *BOUNDARY_SLIDING_PLANE, symmetry
/// planes): the force on a held freedom is replaced by what brings its velocity to zero in this step.
class Fixities : public Term {
public:
    explicit Fixities(const Model& model);

    std::string_view name() const override { return "fixities"; }
    std::size_t items() const override { return held_.size(); }
    void constrain(const Clock& clock, State& state) override;
    void list_held(const Clock& clock, const State& state, std::vector<HeldFreedom>& held) const override;
    void report(EnergyLedger& ledger) const override;
    void collect(const State& state, ElementResults& results) const override;
    void serialise(Archive& archive) override { archive(stopped_energy_); }

    bool empty() const { return held_.empty(); }
    /// Held freedoms start at rest.
    void stop_at_start(State& state);

private:
    using Axes = std::array<Vec3, 3>;
    struct Held {
        Index node;
        FreedomMask freedoms;
        Index axes; ///< into axes_; none: the global ones
        double birth, death;
    };
    struct Reaction {
        Vec3 force, moment;
    };
    const Model& model_;
    std::vector<Held> held_;
    std::vector<Axes> axes_;         ///< of the local systems, now
    std::vector<Index> axes_system_; ///< like axes_: the moving system they belong to, none: they stand
    std::vector<Reaction> reaction_; ///< like held_: force of the support on the node
    double stopped_energy_ = 0;      ///< kinetic energy taken when a support was born on a moving node

    bool acts(const Held& held, const Clock& clock) const
    {
        return clock.time >= held.birth && clock.time <= held.death;
    }
    /// Axes of a local system as they stand now.
    Axes axes_now(Index axes, const State& state) const;
    void turn_axes(const State& state);
};

} // namespace plash
