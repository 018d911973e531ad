#pragma once

#include "model/conditions.h"

#include <optional>

namespace plash {

/// *DEFINE_BOX: an axis-parallel box; [length].
struct Box {
    Vec3 low{}, high{};

    bool holds(const Vec3& point) const
    {
        return point.x >= low.x && point.x <= high.x && point.y >= low.y && point.y <= high.y &&
               point.z >= low.z && point.z <= high.z;
    }
};

/// One side of a contact (SSID/SSTYP or MSID/MSTYP with sets already resolved) and its scale factors.
struct ContactSide {
    enum class Kind {
        none,     ///< this side is not there (single surface)
        all,      ///< every part of the Model
        parts,    ///< `parts`
        shells,   ///< `shells`
        segments, ///< `segments`
        nodes     ///< `nodes`
    };
    Kind kind = Kind::none;
    std::vector<Index> parts;
    std::vector<Index> shells;
    std::vector<std::array<Index, 4>> segments; ///< node indices; a triangle repeats the third
    std::vector<Index> nodes;
    std::optional<Box> box; ///< SBOXID: only what lies in it at the start

    double stiffness_scale = 1; ///< SFS, SFM
    double thickness = 0;       ///< SST, MST [length]; 0: of the elements
    double thickness_scale = 1; ///< SFST, SFMT
};

/// How nodes of one side stay with the segments of the other.
struct Tie {
    enum class Method {
        none,
        constrained,        ///< kinematic, nodes are moved onto the segment (TIED_NODES_TO_SURFACE ...)
        constrained_offset, ///< kinematic with arm and moment
        penalty             ///< springs, offset allowed (_OFFSET, _BEAM_OFFSET, TIEBREAK)
    };
    Method method = Method::none;
    bool rotations = false;     ///< shell-edge ties: rotations follow as well
    bool moment_offset = false; ///< _BEAM_OFFSET: the offset carries a moment

    /// TIEBREAK OPTION: 0 no failure; 1, 2, 3, 4, 6, 8 as in the manual.
    int failure = 0;
    double normal_strength = 0;  ///< NFLS [stress], or NFLF [force] for nodes
    double shear_strength = 0;   ///< SFLS, SFLF
    double normal_exponent = 2;  ///< NEN
    double shear_exponent = 2;   ///< MES
    double parameter = 0;        ///< PARAM: critical distance, exponent ... by option
    double normal_energy = 0;    ///< ERATEN [energy/area]
    double shear_energy = 0;     ///< ERATES
    double stiffness_ratio = 1;  ///< CT2CN
    double normal_stiffness = 0; ///< CN [stress/length]; 0: penalty stiffness
    bool by_force = false;       ///< strengths are forces on the node (ties of nodes), not stresses
};

/// *CONTACT_...: which surfaces act on each other, and how.
struct Contact {
    enum class Kind {
        single_surface, ///< every node against every segment of one surface
        two_way,        ///< nodes of each side against segments of the other
        one_way,        ///< nodes of the slave side against segments of the master side
        general,        ///< single surface with edges and beams
        tied,           ///< `tie` holds slave nodes on master segments, no contact beside it
        transducer,     ///< measures what other contacts do
        interior        ///< inside of solids of the slave parts
    };
    Id id = 0;
    std::string title;
    std::string keyword; ///< without options, e.g. "CONTACT_AUTOMATIC_SINGLE_SURFACE"
    Location where;

    Kind kind = Kind::single_surface;
    bool automatic = true; ///< both sides of shells act; false: only the side that the normal points to
    bool eroding = false;
    bool constraint = false; ///< CONSTRAINT_NODES_TO_SURFACE: kinematic, no penalty
    ContactSide slave, master;
    Tie tie;

    double static_friction = 0;  ///< FS; -1: by the parts (*PART_CONTACT)
    double dynamic_friction = 0; ///< FD
    double friction_decay = 0;   ///< DC [time/length]
    double friction_stress =
        0; ///< VC VSF [stress]: limit of the friction force over the segment's area; 0: none
    double friction_scale = 1; ///< FSF
    double damping = 0;        ///< VDC [percent of critical]
    double birth = 0;          ///< BT [time]
    double death = forever;    ///< DT [time]

    int soft = 0;                   ///< SOFT: 0 penalty, 1 soft constraint, 2 segment based
    double soft_scale = 0.1;        ///< SOFSCL
    double soft_step = 0;           ///< DTSTIF: step of the stiffness by SOFT = 1 and 2 [time]; 0: of the run
    double penalty_scale = 0.1;     ///< SLSFAC of *CONTROL_CONTACT
    int penalty_option = 1;         ///< PENOPT of *CONTROL_CONTACT: which side's stiffness counts
    double largest_penetration = 0; ///< PENMAX, times the thickness; 0: default
    int thickness_option = 2;       ///< SHLTHK: 0 no shell thickness, 1 deformable parts only, 2 all
    bool limit_thickness = true;    ///< SSTHK = 0: single surface shells at most 40 % of their shortest edge
    int initial_penetration = 0;    ///< IGNORE: 0 nodes are moved, 1 tracked as a baseline, 2 and reported
    bool square_edges = false;      ///< SHLEDG
    bool spot_weld_beams = false;   ///< CPARM8 = 2: beams of ELFORM 9 act in general contact
    bool exclude_same_part_beams = false; ///< CPARM8 = 1: beams of one part do not touch one another
    bool edges = false;                   ///< edges touch edges: general contact; SOFT = 2 where DEPTH asks
    bool inner_edges = false;             ///< _INTERIOR of general contact: sides between shells act as well
    bool keep_eroded_nodes = false;       ///< ENMASS: nodes that have lost their elements stay in the contact
    bool drop_symmetry_faces = false; ///< ISYM: faces of solids that lie in a plane of symmetry do not act
    bool friction_energy = false;     ///< FRCENG: what friction takes is summed up by face

    double solid_thickness = 0;      ///< SLDTHK: as if shells of this thickness covered the solids [length]
    double solid_modulus = 0;        ///< SLDSTF: in place of the bulk modulus of solids [stress]; 0: none
    bool stiffness_of_nodes = false; ///< PSTIFF: SOFT = 2 takes the masses of segments from their nodes
    /// DPRFAC, SOFT = 2: by what share penetrations that gave no force when they began come to give one, per
    /// cycle.
    double baseline_decay = 0;
    double edge_stiffness_scale = 1;     ///< EDGEK, SOFT = 2: of edges on edges
    double friction_stiffness_scale = 1; ///< FRICSF, SOFT = 2: of the tangential springs
    bool larger_part_scale = false;      ///< SSFTYP, SOFT = 2: of two parts' SSF the larger one counts
};

/// *PART_CONTACT: what a part brings into every contact.
struct PartContact {
    double static_friction = 0, dynamic_friction = 0, friction_decay = 0, friction_stress = 0;
    double thickness = 0;       ///< OPTT [length]; 0: of the element
    double thickness_scale = 1; ///< SFT
    double stiffness_scale = 1; ///< SSF

    bool operator==(const PartContact&) const = default;
};

/// Whether segments press on segments: SOFT = 2 of surfaces (not of nodes or beams) that neither stick nor
/// are held by constraints.
inline bool presses_by_segments(const Contact& contact)
{
    using Kind = Contact::Kind;
    const bool surfaces = contact.kind == Kind::single_surface || contact.kind == Kind::two_way ||
                          contact.kind == Kind::one_way;
    const auto is_named = [&](const char* part) { return contact.keyword.find(part) != std::string::npos; };
    return contact.soft == 2 && surfaces && !contact.constraint && contact.tie.method == Tie::Method::none &&
           contact.slave.kind != ContactSide::Kind::nodes && !is_named("NODES_TO") && !is_named("BEAMS_TO");
}

} // namespace plash
