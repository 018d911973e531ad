#pragma once

#include "ale/deck_groups.h"

namespace plash {

/// *MAT_ALE_GAS_MIXTURE with the *INITIAL_GAS_MIXTURE of its group: up to eight ideal gases that share one
/// volume and temperature. With constant heat capacities they are one ideal gas, p = sum rho_i R_i T =
/// (gamma - 1) rho e, whose c_v and c_p are the means by mass; e = c_v T at the start.
/// number  of the group in the deck, from 1
void set_gas_mixture(DeckGroup& group, const Record& material, const Model& model, Id number);

} // namespace plash
