#pragma once

#include "core/term.h"
#include "core/work_sum.h"
#include "model/model.h"
#include "rigid/rigid_body.h"

namespace plash {

/// All rigid bodies of a scene. Their nodes have no mass of their own in the State, so the loop leaves them
/// alone; this term sums their forces, moves the bodies and gives the nodes the velocities that carry them to
/// their places at n+1.
class RigidBodies : public Term {
public:
    /// Takes the masses of the bodies' nodes out of the state.
    RigidBodies(const Model& model, std::vector<RigidBody> bodies, State& state);

    std::string_view name() const override { return "rigid bodies"; }
    std::size_t items() const override { return bodies_.size(); }
    void constrain(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override;
    void collect(const State& state, ElementResults& results) const override;
    void serialise(Archive& archive) override;

    const std::vector<RigidBody>& bodies() const { return bodies_; }

private:
    struct Drive {
        const PrescribedMotion* motion;
        std::size_t body;
        double travelled = 0;
        double force = 0; ///< along or about the direction that drives the body at n [force] or [moment]
        WorkSum work;
    };
    const Model& model_;
    std::vector<RigidBody> bodies_;
    std::vector<Drive> drives_;
    double kinetic_ = 0;

    void move(const Clock& clock, State& state, RigidBody& body, std::size_t number);
};

} // namespace plash
