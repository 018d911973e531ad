#pragma once

#include "core/term.h"
#include "model/model.h"

namespace plash {

/// Nodes whose velocity, acceleration or displacement follows a curve (*BOUNDARY_PRESCRIBED_MOTION_NODE,
/// _SET): along or about a direction (DOF 1 to 8), or on circles about an axis (DOF 9 to 11); with negative
/// DOF the other components of the same kind are held. The force on the driven freedom is replaced by what
/// makes the new velocity the prescribed one.
class PrescribedMotions : public Term {
public:
    /// Takes the motions of nodes; those of rigid parts belong to the rigid bodies.
    PrescribedMotions(const Model& model, const State& state);

    std::string_view name() const override { return "prescribed motion"; }
    std::size_t items() const override { return count_; }
    void constrain(const Clock& clock, State& state) override;
    void list_held(const Clock& clock, const State& state, std::vector<HeldFreedom>& held) const override;
    void report(EnergyLedger& ledger) const override;
    void collect(const State& state, ElementResults& results) const override;
    void serialise(Archive& archive) override;

    bool empty() const { return motions_.empty(); }
    /// Driven freedoms start with the velocity that their curve has at t = 0.
    void start(State& state) const;

private:
    struct DrivenNode {
        double travelled = 0; ///< displacement (or angle) along the direction so far
        Vec3 force{};         ///< that drives the node at n [force] or [moment]
        double work = 0;      ///< put in so far [energy]
    };
    struct Driven {
        const PrescribedMotion* motion;
        std::vector<DrivenNode> nodes; ///< like motion->nodes
    };
    const Model& model_;
    std::vector<Driven> motions_;
    std::size_t count_ = 0;

    bool acts(const PrescribedMotion& motion, const Clock& clock) const;
    Vec3 drive(const PrescribedMotion& motion, DrivenNode& driven, Index node, const Clock& clock,
               const State& state) const;
};

} // namespace plash
