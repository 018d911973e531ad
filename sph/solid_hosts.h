#pragma once

#include "core/term.h"
#include "model/model.h"

#include <vector>

namespace plash {

/// Solids whose stand-ins (*DEFINE_ADAPTIVE_SOLID_TO_SPH) are particles of a body.
class SolidHosts {
public:
    /// A solid with the places of its stand-ins.
    struct Host {
        StandIns stand_ins;
        std::vector<std::array<double, 8>> weights; ///< of the solid's nodes, by stand-in
        double volume = 0;                          ///< at the start [length^3]
        bool lost = false;
    };
    /// Where a stand-in is and how it moves.
    struct Motion {
        Vec3 position{}, velocity{};
    };

    SolidHosts() = default;
    /// From now on the State keeps what lost solids held.
    SolidHosts(const Model& model, State& state);

    bool any() const { return !hosts_.empty(); }
    /// Whether solids have gone since `take_lost` was asked last.
    bool someone_lost(const State& state) const { return any() && !state.lost_solids.empty(); }
    /// Those of the State's lost solids that have stand-ins, with their hosts; empties the State's list.
    std::vector<std::pair<Index, LostSolid>> take_lost(State& state);

    const Host& host(Index number) const { return hosts_[number]; }
    /// First node of a host's stand-ins in the State; the others follow.
    Index first_node(const Host& host) const { return model_->particles.node[host.stand_ins.first]; }
    /// Whether the particle of a node waits in a solid.
    bool waits(Index node) const
    {
        return any() && host_of_node_[node] != none && !hosts_[host_of_node_[node]].lost;
    }
    /// Host of a particle that waits, or waited, by its node.
    const Host& host_of(Index node) const { return hosts_[host_of_node_[node]]; }
    /// What holds a particle that waits and the solids beside it together.
    StandIns::Bond bond_of(Index node) const
    {
        return waits(node) ? host_of(node).stand_ins.bond : StandIns::Bond::none;
    }

    Motion motion_of(Index node, const State& state) const;
    /// Volume over that of the start, within bounds that no solid in good order leaves.
    double relative_volume(const Host& host, const State& state) const;
    /// Adds a force on a particle that waits to the nodes of its solid.
    void pass_on(const Vec3& force, Index node, State& state) const;

    void serialise(Archive& archive);

private:
    const Model* model_ = nullptr;
    std::vector<Host> hosts_;
    std::vector<Index> host_of_node_;  ///< by node of the State
    std::vector<Index> host_of_solid_; ///< by solid of the Model

    const std::array<double, 8>& weights_of(Index node) const
    {
        return host_of(node).weights[node - first_node(host_of(node))];
    }
};

} // namespace plash
