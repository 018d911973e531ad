#pragma once

#include "ale/fluid.h"
#include "ale/mesh_block.h"

namespace plash {

/// *ALE_REFERENCE_SYSTEM_GROUP: how an Eulerian mesh is carried along as a whole. It translates; it is
/// neither scaled nor turned.
struct MeshMotion {
    enum class Kind {
        none,
        curves,  ///< PRTYPE = 3: velocities by *ALE_REFERENCE_SYSTEM_CURVE
        average, ///< PRTYPE = 4: the mean velocity of the mass in the mesh
        node     ///< PRTYPE = 5: with the first node of *ALE_REFERENCE_SYSTEM_NODE
    };
    struct Rule {
        Kind kind = Kind::none;
        std::array<Index, 3> curves{none, none, none}; ///< velocity of each axis; none: zero
        Index node = none;
    };
    /// One after the other, each until its time and the last for ever: PRTYPE = 6,
    /// *ALE_REFERENCE_SYSTEM_SWITCH.
    std::vector<Rule> rules;
    std::vector<double> until; ///< [time]
    unsigned held = 0;         ///< BCTRAN: axes along which it stays, bits 1, 2, 4

    bool moves() const;
    /// Velocity of the mesh [velocity].
    /// nodes  velocities of all nodes [velocity]
    std::array<double, 3> velocity(const Model& model, const Fluid& fluid, const std::vector<Vec3>& nodes,
                                   double time) const;
};

/// DeckError for what is not there.
MeshMotion mesh_motion_of(const Model& model, const MeshBlock& block);

} // namespace plash
