#pragma once

#include "core/archive.h"
#include "math/symmetric_tensor.h"
#include "math/vector3.h"
#include "model/record.h"

#include <utility>
#include <vector>

namespace plash {

/// What a solid held when it was deleted. Its mass stays with its nodes unless somebody takes it from there.
struct LostSolid {
    Index solid = none;                           ///< of the Model
    std::vector<std::pair<Index, double>> masses; ///< of its nodes, without mass scaling [mass]
    SymmetricTensor<double> stress{};             ///< mean, global axes [stress]
    double internal = 0;                          ///< internal energy, without that of hourglassing [energy]
    std::vector<double> history;                  ///< variables of its law, mean of its points
};

/// Nodal arrays, one entry a node in the Model's order. Central difference in LS-DYNA's staggering: positions
/// and forces at step n, velocities at n - 1/2 until the loop advances them to n + 1/2.
/// The rotational arrays are empty unless some element of the scene has rotational freedoms.
struct State {
    std::vector<Vec3> position; ///< [length]
    std::vector<Vec3> velocity; ///< [velocity]
    std::vector<Vec3> force;    ///< [force], sum of all terms in this cycle
    std::vector<double> mass;   ///< [mass]; 0: the loop does not move the node (nobody or a rigid body does)

    std::vector<Vec3> angular_velocity; ///< [1/time]
    std::vector<Vec3> moment;           ///< [moment]
    std::vector<double> inertia;        ///< [mass length^2], isotropic

    /// Elements deleted so far, by the Model's order (1: gone); empty until something may erode. Whoever
    /// deletes an element marks it here and raises `deletions`, so that contacts see their surfaces change.
    /// `deleted_solids` are bricks: the solids and then, once one of them erodes, the thick shells.
    std::vector<std::uint8_t> deleted_shells, deleted_solids, deleted_beams;
    long deletions = 0;
    /// Solids that went in this cycle; only while somebody keeps them, who empties the list in `add_forces`.
    std::vector<LostSolid> lost_solids;
    bool keeps_lost_solids = false;

    std::size_t size() const { return position.size(); }
    bool rotational() const { return !angular_velocity.empty(); }

    /// Zeroes force and moment.
    void clear_forces();
    /// Allocates the rotational arrays if they are not there yet.
    void need_rotation();

    /// Positions and velocities between two cycles, masses, what is deleted.
    void serialise(Archive& archive);
};

} // namespace plash
