#pragma once

#include "core/archive.h"
#include "core/clock.h"
#include "core/state.h"
#include "model/model.h"
#include "rigid/rigid_body.h"

namespace plash {

/// What a butt or fillet weld breaks by: BETA sqrt(sigma_n^2 + 3 (tau_n^2 + tau_t^2)) >= SIGY with the
/// stresses in its plane, sigma_n in tension only (keyword manual, *CONSTRAINED_GENERALIZED_WELD).
struct WeldPlane {
    double area = 0;            ///< length times thickness or throat [length^2]; 0: a spot weld
    Vec3 normal{}, across{};    ///< of the plane, and in it across the weld, in body axes
    Vec3 along{};               ///< in the plane along the weld, in body axes
    double factor = 0;          ///< BETA [-]
    double strength = 0;        ///< SIGY [stress]
    std::vector<Index> of_side; ///< the nodes behind the plane, positions in `nodes`
};

/// *CONSTRAINED_SPOTWELD and *CONSTRAINED_GENERALIZED_WELD_SPOT, _BUTT, _FILLET: nodes that move as a rigid
/// body until the weld fails or its time is over. Spot welds: (normal force / SN)^N + (shear force / SS)^M >=
/// 1 (normal force in tension only; Hallquist 2006, 'Spot welds'), the normal runs from the first node to the
/// last. The others: WeldPlane.
struct Weld {
    Id id = 0;
    std::vector<Index> nodes;
    double normal_strength = 0, shear_strength = 0; ///< [force]; 0: no failure by it
    double normal_power = 2, shear_power = 2;
    WeldPlane plane;
    double end = 0; ///< [time]
    Location where;
    Index body = none;                        ///< position in the list of bodies
    double normal_force = 0, shear_force = 0; ///< at the last n [force]
    bool failed = false;

    void serialise(Archive& archive) { archive(normal_force, shear_force, failed); }
};

/// The welds of the deck (records in Model::others). DeckError for welds without two nodes, butt and fillet
/// welds without axes or without an area to carry stresses.
std::vector<Weld> read_welds(const Model& model);

/// Looks at the forces that the body puts on its nodes at n, once the body has moved; true when the weld has
/// to go.
bool weld_fails(Weld& weld, const RigidBody& body, const State& state, const Clock& clock);

} // namespace plash
