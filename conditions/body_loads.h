#pragma once

#include "core/term.h"
#include "model/model.h"

namespace plash {

/// Inertia forces of an accelerated frame, on every node, on those of some parts or on a list of nodes
/// (*LOAD_BODY family, *LOAD_GRAVITY_PART). With base acceleration a, angular velocity w and acceleration
/// alpha of the frame, r from the centre and v relative to the frame (Goldstein, Classical Mechanics, ch. 4):
///     translation -m a, centrifugal -m w x (w x r), Coriolis -2 m w x v, Euler -m alpha x r.
class BodyLoads : public Term {
public:
    /// `state.mass` must already hold every mass of the scene, rigid bodies included; it is copied, because
    /// nodes of rigid bodies lose theirs to the body.
    BodyLoads(const Model& model, const State& state);

    std::string_view name() const override { return "body loads"; }
    std::size_t items() const override { return all_.mass.size() + some_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.external_work += work_; }
    void serialise(Archive& archive) override;

private:
    /// One load on a list of nodes.
    struct Local {
        const BodyLoad* load;
        std::vector<Index> nodes;
        std::vector<double> mass; ///< like `nodes` [mass]
        std::vector<Vec3> last;   ///< like `nodes`: its force at n-1 [force]
    };
    /// What all nodes share: the sum of the base accelerations that act on everything.
    struct Everywhere {
        std::vector<double> mass; ///< of each node; empty without such loads [mass]
        std::vector<const BodyLoad*> loads;
        Vec3 last_acceleration{};
    };
    const Model& model_;
    Everywhere all_;
    std::vector<Local> some_;
    double work_ = 0;

    void add_everywhere(const Clock& clock, State& state);
    void add_local(const Clock& clock, Local& local, State& state);
};

} // namespace plash
