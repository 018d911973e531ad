#pragma once

#include "core/term.h"
#include "model/model.h"

namespace plash {

/// External forces on the nodes of *DATABASE_NODAL_FORCE_GROUP, which nodfor shows: what loads, supports,
/// drives and rigid walls add to the forces of elements and contacts. Stands in the scene before all of
/// these, and changes nothing.
class NodalForces : public Term {
public:
    explicit NodalForces(const Model& model);

    std::string_view name() const override { return "nodal force groups"; }
    std::size_t items() const override { return nodes_.size(); }
    void add_forces(const Clock&, State& state) override;
    void after_motion(const Clock& clock, State& state) override;
    void collect(const State& state, ElementResults& results) const override;
    void serialise(Archive& archive) override { archive(nodes_); }

private:
    struct Node {
        Index node = none;
        Vec3 inner{};           ///< force of elements and contacts at n [force]
        Vec3 velocity_before{}; ///< at n - 1/2
        double work = 0;        ///< up to the last n [energy]
    };
    std::vector<Node> nodes_; ///< group by group
    double last_step_ = 0;
};

} // namespace plash
