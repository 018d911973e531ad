#pragma once

#include "core/archive.h"
#include "core/clock.h"
#include "core/state.h"
#include "model/model.h"
#include "rigid/rigid_body.h"

namespace plash {

/// *CONSTRAINED_SPOTWELD and *CONSTRAINED_GENERALIZED_WELD_SPOT: nodes that move as a rigid body until the
/// weld fails: (normal force / SN)^N + (shear force / SS)^M >= 1 (normal force in tension only), or its time
/// is over (Hallquist 2006, 'Spot welds'). The normal runs from the first node to the last.
struct Weld {
    Id id = 0;
    std::vector<Index> nodes;
    double normal_strength = 0, shear_strength = 0; ///< [force]; 0: no failure by it
    double normal_power = 2, shear_power = 2;
    double end = 0; ///< [time]
    Location where;
    Index body = none;                        ///< position in the list of bodies
    double normal_force = 0, shear_force = 0; ///< at the last n
    bool failed = false;

    void serialise(Archive& archive) { archive(normal_force, shear_force, failed); }
};

/// The welds of the deck (records in Model::others). DeckError for welds without two nodes.
std::vector<Weld> read_welds(const Model& model);

/// Looks at the forces that the body puts on its nodes at n, once the body has moved; true when the weld has
/// to go.
bool weld_fails(Weld& weld, const RigidBody& body, const State& state, const Clock& clock);

} // namespace plash
