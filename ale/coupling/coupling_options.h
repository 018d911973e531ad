#pragma once

#include "ale/deck_groups.h"
#include "ale/fluid_term.h"
#include "model/contact.h"

#include <vector>

namespace plash {

/// One *CONSTRAINED_LAGRANGE_IN_SOLID or *ALE_STRUCTURED_FSI: a surface of the structure and a fluid that may
/// not pass it.
struct CouplingOptions {
    Id id = 0;
    Location where;
    ContactSide structure;
    std::vector<bool> mesh_parts; ///< by part of the Model: the Eulerian meshes that take part

    enum class Direction { normal, compression, all };
    Direction direction = Direction::normal; ///< DIREC
    bool stiffest = false;                   ///< CTYPE 1, 2: as stiff and as damped as the step allows
    double penalty = 0.1;                    ///< PFAC
    Index pressure_curve = none;             ///< PFAC < 0: pressure over penetration
    double friction = 0;                     ///< FRIC, Coulomb
    double damping = 0;                      ///< DAMP, share of critical
    double least_fraction = 0.5;             ///< FRCMIN
    double leak_control =
        0; ///< ILEAK, PLEAK: share of what stands behind the surface that a cycle takes back
    bool with_thickness = false;     ///< THKF: the fluid meets shells half their thickness before their plane
    bool turned = false;             ///< NORM, FLIP: normals point away from the fluid
    int points_per_edge = 0;         ///< NQUAD; more are taken where segments are long. 0: as many as needed
    unsigned fluids = ~0u;           ///< MCOUP: bit g for fluid g
    double start = 0, end = forever; ///< [time]
    /// Of couplings that stand for a contact (docs/fluids.md): shells act on both of their sides, and the
    /// force is reported under the contact's number, structure as master; negative: as slave. 0: not reported
    /// so.
    bool both_sides = false;
    Id contact = 0;
    bool cut_cells = false; ///< CUTCELLS of *PLASH_ALE_FORMULATION
};

/// All couplings of a Model, in deck order; the groups are those of its Eulerian meshes.
std::vector<CouplingOptions> coupling_options_of(const Model& model, const DeckGroups& groups);

} // namespace plash
