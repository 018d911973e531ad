#pragma once

#include "ale/deck_groups.h"
#include "ale/fluid.h"
#include "ale/mesh_block.h"
#include "ale/node_smoothing.h"

namespace plash {

/// *ALE_REFERENCE_SYSTEM_GROUP and *ALE_STRUCTURED_MESH_MOTION: how an Eulerian mesh is carried along as a
/// whole, whatever flows through it. Meshes that only translate (`deforms` is false) have one velocity;
/// others are moved from step to step by an affine map.
struct MeshMotion {
    enum class Kind {
        none,
        material, ///< PRTYPE = 1: with the material
        smoothed, ///< PRTYPE = 2: with the material, smoothed as *CONTROL_ALE says
        delayed,  ///< PRTYPE = 8: with the material, and part of the way back to the start
        curves,   ///< PRTYPE = 3: velocities by *ALE_REFERENCE_SYSTEM_CURVE
        average,  ///< PRTYPE = 4: the mean velocity of the mass in the mesh; FOLLOW_GC: of some fluids
        node,     ///< PRTYPE = 5, BCROT = 7: with the first node of *ALE_REFERENCE_SYSTEM_NODE
        frame,    ///< PRTYPE = 5: with the system of its first three nodes, which turns
        extent,   ///< PRTYPE = 7: stretched along the axes as the box is that its nodes span
        enclosing ///< PRTYPE = 9: turns with a system of three nodes, and is stretched about a fourth one
                  ///< along the axes of that system as the other nodes reach away from it
    };
    struct Rule {
        Kind kind = Kind::none;
        /// LC1 to LC12 of v = f1 + f2 x + f3 y + f4 z and so on; none: zero.
        std::array<Index, 12> curves{none, none, none, none, none, none, none, none, none, none, none, none};
        std::vector<Index> nodes; ///< of the reference system
        unsigned fluids = ~0u;    ///< of `average`: bits of those that count

        bool follows() const
        {
            return kind == Kind::material || kind == Kind::smoothed || kind == Kind::delayed;
        }
    };
    /// One after the other, each until its time and the last for ever: PRTYPE = 6,
    /// *ALE_REFERENCE_SYSTEM_SWITCH.
    std::vector<Rule> rules;
    std::vector<double> until; ///< [time]
    unsigned held = 0;         ///< BCTRAN: axes along which it stays, bits 1, 2, 4
    unsigned stiff = 0;        ///< BCEXP: axes along which PRTYPE = 7 and 9 do not stretch it
    double back = 0;           ///< EFAC of PRTYPE = 8 [-]
    bool idle_back = false;    ///< the deck gives EFAC, and nothing is delayed
    bool idle_centre = false;  ///< the deck gives ICOORD, and nothing is enclosed
    Vec3 centre{};             ///< XC, YC, ZC: from which the coordinates of curves count [length]

    bool moves() const;
    bool deforms() const;
    /// At some time its nodes go with the material.
    bool follows() const;
    /// And at all others it stands.
    bool only_follows() const;
    bool smooths() const;
    std::size_t rule_number(double time) const;
    /// Velocity of a mesh that translates [velocity].
    /// nodes  velocities of all nodes [velocity]
    std::array<double, 3> velocity(const Model& model, const Fluid& fluid, const std::vector<Vec3>& nodes,
                                   double time) const;
};

/// x becomes to + gradient (x - from).
struct AffineStep {
    Vec3 from{}, to{};
    std::array<Vec3, 3> gradient{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}; ///< rows

    Vec3 operator()(const Vec3& x) const
    {
        const Vec3 arm = x - from;
        return to + Vec3{dot(gradient[0], arm), dot(gradient[1], arm), dot(gradient[2], arm)};
    }
};

/// How a mesh that deforms goes over a step: `before` and `after` are places of the rule's nodes,
/// `velocity` that of a mesh which translates.
AffineStep affine_step(const MeshMotion& motion, const Model& model, double time, double step,
                       const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                       const std::array<double, 3>& velocity);

/// DeckError for what is not there.
MeshMotion mesh_motion_of(const Model& model, const MeshBlock& block, const DeckGroups& groups);

} // namespace plash
