#pragma once

#include "core/term.h"
#include "model/model.h"

namespace plash {

/// Forces and moments on nodes that follow curves (*LOAD_NODE_POINT, *LOAD_NODE_SET): along fixed directions,
/// along axes that turn with three nodes (CID with FLAG = 1), or normal to a plane of three nodes that moves
/// (DOF 4 and 8).
class NodalLoads : public Term {
public:
    explicit NodalLoads(const Model& model);

    std::string_view name() const override { return "nodal loads"; }
    std::size_t items() const override { return count_; }
    void add_forces(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override;
    void collect(const State& state, ElementResults& results) const override;
    void serialise(Archive& archive) override { archive(last_, work_); }

private:
    const Model& model_;
    std::vector<Vec3> last_;                ///< of each load at t_(n-1) [force] or [moment]
    std::vector<std::vector<double>> work_; ///< of each load on each of its nodes
    std::size_t count_ = 0;                 ///< loaded nodes

    Vec3 direction_of(const NodalLoad& load, const State& state) const;
};

} // namespace plash
