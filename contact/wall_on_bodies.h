#pragma once

#include "core/term.h"
#include "model/model.h"

namespace plash {

/// *RIGIDWALL_PLANAR against nodes of rigid bodies, which have no mass of their own and so cannot be stopped
/// one by one. Each node below the plane feels the spring m / dt^2 of its lumped mass m with the first step
/// dt: however many nodes of a body touch, their springs together are no stiffer than the body's mass and
/// inertia over dt^2, so the step stays stable, and the energy of the impact comes back (LS-DYNA treats such
/// nodes by a penalty too, but only when RWPNAL > 0; Plash always does). Friction: Coulomb on the spring's
/// force, never more than stops the node.
class WallOnBodies : public Term {
public:
    /// `state` still holds the lumped masses of the bodies' nodes.
    WallOnBodies(const PlanarWall& wall, const Model& model, const State& state);

    std::string_view name() const override { return "rigid wall on bodies"; }
    std::size_t items() const override { return nodes_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.rigid_wall -= work_; }
    void collect(const State& state, ElementResults& results) const override;

private:
    const PlanarWall& wall_;
    std::vector<Index> nodes_;
    std::vector<double> mass_;  ///< lumped, of each of them [mass]
    std::vector<Vec3> force_;   ///< on each at the last n [force]
    double reference_step_ = 0; ///< of the springs [time]
    double work_ = 0;           ///< of the wall on the nodes [energy]
};

} // namespace plash
