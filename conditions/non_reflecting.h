#pragma once

#include "conditions/segment_forces.h"
#include "core/term.h"
#include "model/model.h"

namespace plash {

/// *BOUNDARY_NON_REFLECTING: dashpots on segments of solids that take up waves which leave the mesh: normal
/// traction -rho c_d v_n, tangential -rho c_s v_t with the wave speeds of the solid behind (Lysmer &
/// Kuhlemeyer 1969, eqs. 5-6: exact for normal incidence). Taken with the mean of the velocities before and
/// after the step.
class NonReflecting : public Term {
public:
    /// DeckError where a segment lies on no solid, or on one whose material has no elastic moduli.
    NonReflecting(const Model& model, const State& state);

    std::string_view name() const override { return "non-reflecting boundary"; }
    std::size_t items() const override { return nodes_.size(); }
    void constrain(const Clock& clock, State& state) override;
    /// What leaves through the boundary leaves the model: work done by it is lost.
    void report(EnergyLedger& ledger) const override { ledger.external_work += work_; }
    void serialise(Archive& archive) override { archive(last_, work_); }

private:
    /// Dashpots of one node, in the directions of its surface at the start.
    struct Node {
        Index node = none;
        Vec3 normal{};              ///< unit, of all its segments together
        double normal_damping = 0;  ///< sum of rho c_d A / 4 [force time/length]
        double tangent_damping = 0; ///< sum of rho c_s A / 4
    };
    std::vector<Node> nodes_;
    std::vector<Vec3> last_; ///< like nodes_: dashpot forces at n-1 [force]
    double work_ = 0;
};

} // namespace plash
