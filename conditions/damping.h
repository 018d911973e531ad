#pragma once

#include "core/term.h"
#include "model/model.h"

namespace plash {

/// Damping proportional to mass (*DAMPING_GLOBAL, *DAMPING_PART_MASS, *DAMPING_RELATIVE): force -D m (v -
/// v_0) along each axis of a node, with v_0 zero or the motion of a rigid part. Taken with the mean of the
/// velocities before and after the step, so that it is stable for every D and an oscillator decays as it
/// should to second order in the step; LS-DYNA takes the velocity before. Nodes of rigid bodies, whose new
/// velocity is not known here, are damped by the velocity before.
class Damping : public Term {
public:
    /// As BodyLoads: before rigid bodies take the masses of their nodes.
    Damping(const Model& model, const State& state);

    std::string_view name() const override { return "damping"; }
    std::size_t items() const override { return nodes_.size(); }
    void constrain(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.damping -= work_; }
    void serialise(Archive& archive) override { archive(last_, work_); }

    bool empty() const { return nodes_.empty(); }

private:
    struct Node {
        Index node = none;
        double mass = 0, inertia = 0; ///< of nodes of rigid bodies
    };
    struct Wrench {
        Vec3 force{}, moment{};
    };
    /// One damping on its nodes: nodes_[begin] .. nodes_[end].
    struct Group {
        const NodeDamping* damping;
        std::size_t begin, end;
    };
    const Model& model_;
    std::vector<Node> nodes_;
    std::vector<Group> groups_;
    std::vector<Wrench> last_; ///< like nodes_: damping force and moment at n-1
    double work_ = 0;          ///< of the damping forces [energy]

    Wrench damp(const NodeDamping& damping, double rate, const Node& node, const Clock& clock, State& state,
                const Vec3& reference, const Vec3& reference_spin) const;
};

} // namespace plash
