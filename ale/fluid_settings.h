#pragma once

#include "ale/mesh_block.h"
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
    MeshSmoothing mesh_smoothing;        ///< of *CONTROL_ALE
    double smooth = 0;                   ///< SMOOTH of *PLASH_ALE_FORMULATION: Fluid::keep_smooth_slopes [-]
};

/// Smoothing of a mesh: that of *SECTION_SOLID_ALE where AFAC to DFAC are given there, which all its parts
/// have to agree about, or else of *CONTROL_ALE.
MeshSmoothing mesh_smoothing_of(const Model& model, const MeshBlock& block, const FluidSettings& settings);

/// DeckError for what is not there.
FluidSettings fluid_settings_of(const Model& model);

} // namespace plash
