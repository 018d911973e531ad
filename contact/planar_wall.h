#pragma once

#include "core/term.h"
#include "core/work_sum.h"
#include "model/model.h"

namespace plash {

/// *RIGIDWALL_PLANAR: nodes may not pass the plane. A node that would pass within the step lands on the plane
/// instead (perfectly plastic, as LS-DYNA's wall), and is free to leave. Friction: Coulomb on the force that
/// stops it; FRIC >= 1 holds touching nodes, FRIC = 2 also keeps them from leaving.
class PlanarWallTerm : public Term {
public:
    PlanarWallTerm(const PlanarWall& wall, const Model& model, const State& state);

    std::string_view name() const override { return "rigid wall"; }
    std::size_t items() const override { return nodes_.size(); }
    void constrain(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.rigid_wall -= work_.done; }
    void collect(const State& state, ElementResults& results) const override;

private:
    const PlanarWall& wall_;
    std::vector<Index> nodes_;
    std::vector<bool> stuck_; ///< only with FRIC = 2: touched once
    Vec3 force_{};            ///< of the nodes on the wall at n [force]
    WorkSum work_;            ///< of the wall on the nodes
};

} // namespace plash
