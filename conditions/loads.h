#pragma once

#include "core/term.h"
#include "model/model.h"

namespace plash {

/// Forces and moments on nodes that follow curves (*LOAD_NODE_POINT, *LOAD_NODE_SET).
class NodalLoads : public Term {
public:
    explicit NodalLoads(const Model& model);

    std::string_view name() const override { return "nodal loads"; }
    std::size_t items() const override { return count_; }
    void add_forces(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override;
    void collect(const State& state, ElementResults& results) const override;

private:
    const Model& model_;
    std::vector<double> last_magnitude_;    ///< of each load at t_(n-1)
    std::vector<std::vector<double>> work_; ///< of each load on each of its nodes
    std::size_t count_ = 0;                 ///< loaded nodes
};

/// Base accelerations (*LOAD_BODY_X/Y/Z): force -mass * acceleration on every node, or on the nodes of some
/// parts.
class BodyLoads : public Term {
public:
    /// `state.mass` must already hold every mass of the scene, rigid bodies included; it is copied, because
    /// nodes of rigid bodies lose theirs to the body.
    BodyLoads(const Model& model, const State& state);

    std::string_view name() const override { return "body loads"; }
    std::size_t items() const override { return mass_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override { ledger.external_work += work_; }

private:
    Vec3 acceleration(double time) const;

    const Model& model_;
    std::vector<double> mass_; ///< loaded mass of each node [mass]
    Vec3 last_acceleration_{};
    double work_ = 0;
};

} // namespace plash
