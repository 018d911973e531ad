#pragma once

#include "core/energy_ledger.h"
#include "core/recorder.h"
#include "core/state.h"
#include "core/term.h"
#include "model/model.h"
#include "output/model_summary.h"

#include <memory>
#include <vector>

namespace plash {

class RigidBodies;

/// The state and exactly the terms that a Model needs.
struct Scene {
    const Model& model;
    State state;
    std::vector<std::unique_ptr<Term>> terms;
    EnergyLedger ledger;
    double added_mass_ratio = 0; ///< mass added for *CONTROL_TIMESTEP DT2MS over the mass of the deck [-]
    MassSummary masses;
    const RigidBodies* switching = nullptr; ///< the term that makes parts rigid while the run goes on
};

/// *CONTROL_DYNAMIC_RELAXATION IDRFLG = 5: the run begins in an equilibrium that is solved for.
inline bool asks_for_statics(const Model& model)
{
    return model.controls.relaxation.flag == 5;
}

/// Builds the scene at t = 0: masses, terms, initial velocities. DeckError where the deck asks for physics
/// that is not there or makes no sense. The Model must outlive the scene.
Scene make_scene(const Model& model);

} // namespace plash
