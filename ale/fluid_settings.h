#pragma once

#include "ale/node_smoothing.h"
#include "ale/remap.h"
#include "model/model.h"

namespace plash {

/// *CONTROL_ALE and *PLASH_ALE_FORMULATION as far as Plash honours them.
struct FluidSettings {
    AdvectionOrder order = AdvectionOrder::van_leer; ///< METH = 2, -2, 3, 4; 1: donor cell
    bool conserve_total_energy = false;              ///< METH = 3, 4
    enum class Boundary { open, stick, slip };
    Boundary boundary = Boundary::open;  ///< EBC: nodes of the mesh's outer faces
    std::vector<bool> exempt;            ///< NSIDEBC: nodes of the Model that EBC leaves alone; empty: none
    double outside_pressure = 0;         ///< PREF, on the outer faces [pressure]
    Index outside_pressure_curve = none; ///< PREF < 0: it by time; then `outside_pressure` is unused
    NodeSmoothing mesh_smoothing;        ///< AFAC to DFAC, of meshes of PRTYPE = 2
    double smoothing_start = 0;          ///< START [time]
    double smoothing_end = 1e20;         ///< END [time]
    double smooth = 0;                   ///< SMOOTH of *PLASH_ALE_FORMULATION: Fluid::keep_smooth_slopes [-]
};

/// DeckError for what is not there.
FluidSettings fluid_settings_of(const Model& model);

} // namespace plash
