#pragma once

#include "contact/part_data.h"
#include "core/state.h"

namespace plash {

/// A quadrilateral or triangle that nodes may touch.
struct Segment {
    std::array<Index, 4> nodes{}; ///< State indices; a triangle repeats the third
    Index part = none;
    Index shell = none;        ///< element of the Model that it belongs to, or `none`
    Index solid = none;        ///< likewise; the normal by the order of nodes points out of the solid
    Index covered_by = none;   ///< inner face of solids: shows only once this solid has eroded
    bool rigid = false;        ///< of a rigid part, whose own nodes never touch it
    bool one_sided = false;    ///< acts only on the side that its normal points to
    double half_thickness = 0; ///< contact thickness on either side of the nodes' plane [length]
    double stiffness = 0; ///< unscaled penalty stiffness, K A / longest diagonal or K A^2 / V [force/length]
    double size = 0;      ///< square root of the area at the start [length]
    double depth = 0;     ///< how far behind the plane a node is still pushed back [length]
    double area_mass = 0; ///< of the shell, or of half the solid; 0: no element beneath [mass/area]
};

/// A node that may touch segments.
struct ContactNode {
    Index node = none;
    Index part = none;         ///< of the first segment or beam that has it; `none` for a lone node
    double half_thickness = 0; ///< [length]
    double stiffness = 0;      ///< largest of its segments [force/length]
};

/// One side of a contact, extracted from the Model. Knows elements only as the origin of segments.
struct Surface {
    std::vector<Segment> segments;
    std::vector<ContactNode> nodes; ///< by rising node index
};

/// How a contact looks at its surfaces.
struct SurfaceOptions {
    bool inner_faces = false;         ///< also faces between solids, which erosion may lay open
    bool orient_by_deck = false;      ///< non-automatic contact: shells act on the side of their normal only
    bool limit_thickness = false;     ///< shells at most 40 % of their shortest edge
    int thickness_option = 2;         ///< SHLTHK: 0 none, 1 deformable parts only, 2 all
    bool with_beams = false;          ///< nodes of beams belong to the surface
    bool spot_weld_beams = true;      ///< those of ELFORM 9 as well
    bool with_particles = false;      ///< SPH particles of the parts belong to the surface, as nodes
    double penetration_factor = 0;    ///< PENMAX: depth in thicknesses; 0: default
    double solid_thickness = 0;       ///< SLDTHK: faces of solids have it as a shell would [length]
    double solid_modulus = 0;         ///< SLDSTF: in place of the bulk modulus of solids [stress]; 0: none
    bool drop_symmetry_faces = false; ///< ISYM: no faces of solids in planes of symmetry
};

SurfaceOptions surface_options(const Contact& contact);

/// Segments and nodes of one side of a contact.
///
/// Segments come from shells, from faces of solids that no other solid of the Model shares, and from segment
/// sets, whose thickness and stiffness are those of the element beneath (a shell is preferred, as in
/// LS-DYNA). Contact thickness: OPTT of the part, else SST/MST, else the element's (times SFT or SFST); of
/// solids SLDTHK, else nothing.
/// SPH particles are nodes: thickness SST/MST, else with ITHK = 1 of *CONTROL_SPH the edge of a cube of their
/// volume, else zero; stiffness that of such a cube of their material.
/// Stiffness: Hallquist (2006) 'Contact-Impact Algorithm', without the factor SLSFAC SFS.
Surface make_surface(const Model& model, const std::vector<PartData>& parts, const ContactSide& side,
                     const SurfaceOptions& options);

/// Whether a segment is there: its own element is alive and none covers it.
inline bool is_exposed(const Segment& segment, const State& state)
{
    if (segment.shell != none && !state.deleted_shells.empty() && state.deleted_shells[segment.shell]) {
        return false;
    }
    const bool solids_erode = !state.deleted_solids.empty();
    if (segment.solid != none && solids_erode && state.deleted_solids[segment.solid]) return false;
    return segment.covered_by == none || (solids_erode && state.deleted_solids[segment.covered_by]);
}

} // namespace plash
