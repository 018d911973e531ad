#pragma once

#include "math/vector3.h"
#include "model/record.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace plash {

inline constexpr double forever = std::numeric_limits<double>::infinity();

struct NodeSet {
    Id id = 0;
    std::string title;
    std::vector<Index> nodes;
    std::array<double, 4> attribute{}; ///< DA1..DA4
};

struct SegmentSet {
    Id id = 0;
    std::string title;
    std::vector<std::array<Index, 4>> segments; ///< node indices; a triangle repeats the third
    std::array<double, 4> attribute{};
};

struct PartSet {
    Id id = 0;
    std::string title;
    std::vector<Index> parts;
    std::array<double, 4> attribute{};
};

/// Elements of one topology: positions in Model::shells, Model::solids ...
struct ElementSet {
    Id id = 0;
    std::string title;
    std::vector<Index> elements;
};

/// Six degrees of freedom as bits: 1, 2, 4 translations x, y, z; 8, 16, 32 rotations x, y, z.
using FreedomMask = unsigned;

/// *BOUNDARY_SPC and the TC/RC columns of *NODE: degrees of freedom held at zero.
struct FixedNodes {
    std::vector<Index> nodes;
    FreedomMask freedoms = 0;
    Index system = none; ///< coordinate system of the freedoms; none: global, or `axes`
    bool local = false;  ///< along `axes`
    std::array<Vec3, 3> axes{};
    double birth = 0;       ///< [time]
    double death = forever; ///< [time]
    Location where;
};

/// *BOUNDARY_PRESCRIBED_MOTION: one degree of freedom of some nodes follows scale * curve(t - birth).
struct PrescribedMotion {
    /// The last two: velocity as a function of the displacement so far (VAD = 3), and displacement of a rigid
    /// body from another one (VAD = 4).
    enum class Kind { velocity, acceleration, displacement, velocity_of_displacement, relative_displacement };
    std::vector<Index> nodes;
    Index rigid_part = none;    ///< _RIGID: number of the body that is driven, and `nodes` is empty
    Vec3 direction{};           ///< unit vector of the freedom
    bool rotation = false;      ///< about `direction` instead of along it
    bool only_component = true; ///< other components stay free
    bool local = false;         ///< _RIGID_LOCAL: `direction` turns with the body
    bool orbit = false;         ///< DOF 9 to 11: nodes go round the axis through `center` along `direction`
    Vec3 center{};
    Kind kind = Kind::velocity;
    Index lead = none; ///< VAD = 4: number of the body from which the displacement is measured
    /// VAD = 4: it is measured along the way from the first to the second of these nodes; none: along the
    /// line between the mass centers.
    std::array<Index, 2> line{none, none};
    Index curve = none;
    double scale = 1;
    double birth = 0;
    double death = forever;
    Location where;
};

/// *LOAD_NODE: force (or moment) scale * curve(t) along one axis on each node.
struct NodalLoad {
    std::vector<Index> nodes;
    Vec3 direction{}; ///< unit vector
    bool moment = false;
    Index curve = none;
    double scale = 1;
    Location where;
    Index system = none; ///< the load is along its `axis`, which turns with it; none: along `direction`
    int axis = 0;
    std::array<Index, 3> follows{none, none,
                                 none}; ///< DOF 4, 8: normal to the plane of these nodes (two: along)
};

/// *LOAD_BODY family, *LOAD_GRAVITY_PART: motion scale * curve(t) of the frame, whose inertia forces act.
struct BodyLoad {
    enum class Kind {
        translation,         ///< base acceleration along `direction`
        centrifugal,         ///< angular velocity about `direction` through `center`
        coriolis,            ///< the same
        angular_acceleration ///< the same
    };
    Kind kind = Kind::translation;
    Vec3 direction{}; ///< unit vector, times the component for *LOAD_BODY_GENERALIZED
    Vec3 center{};    ///< [length]
    Index curve = none;
    double scale = 1;
    std::vector<Index> parts; ///< empty (and no nodes): everything
    std::vector<Index> nodes;
    bool own_nodes = false; ///< *LOAD_BODY_PARTS does not speak of it
    /// Which phase of a run it acts in: as SIDR of its curve says, or the one that its card names.
    enum class Phase { of_curve, transient, relaxation };
    Phase phase = Phase::of_curve;
    Location where;
};

/// *INITIAL_VELOCITY family, in deck order; a later entry overwrites an earlier one where both speak of a
/// node.
struct InitialVelocity {
    std::vector<Index> nodes;
    Vec3 translation{}; ///< [velocity]
    double spin = 0;    ///< [1/time] about the axis through `center` along `axis`; adds spin x r
    Vec3 center{};
    Vec3 axis{0, 0, 1};
    Vec3 angular_velocity{}; ///< [1/time] of the nodes' own rotational freedoms
    bool set_rotation = false;
    bool over_inertia = false; ///< IRIGID = 1: also for bodies whose own card gives a velocity
    Location where;
};

/// *INITIAL_VELOCITY_RIGID_BODY: motion of a rigid part at its centre of mass, over all other entries.
struct RigidBodyVelocity {
    Index part = none;       ///< number of the body
    Vec3 translation{};      ///< [velocity]
    Vec3 angular_velocity{}; ///< [1/time]
    Location where;
};

/// *INITIAL_AXIAL_FORCE_BEAM: axial force scale * curve(t) of some beams until the curve ends.
struct BeamPreload {
    std::vector<Index> beams;
    Index curve = none;
    double scale = 1;
    bool keeps_bending = false; ///< KBEND = 1: only the mean axial stress is prescribed
    Location where;
};

/// *RIGIDWALL_PLANAR and *RIGIDWALL_GEOMETRIC: a body that nodes may not enter.
struct RigidWall {
    enum class Shape { plane, finite_plane, prism, cylinder, sphere };
    Id id = 0;
    std::string title;
    Shape shape = Shape::plane;
    Vec3 tail{};   ///< a point of the plane, corner of a finite one, end of a cylinder's axis, centre of a
                   ///< sphere
    Vec3 normal{}; ///< unit, pointing to the side of the nodes; axis of a cylinder
    Vec3 edge{};   ///< unit, of finite planes and prisms along l; m = normal x edge
    std::array<double, 3> length{}; ///< along l, along m, against the normal; cylinder: the first; 0: endless
    double radius = 0;              ///< [length]
    bool interior = false;          ///< nodes stay within the cylinder

    double friction = 0;      ///< Coulomb; 1: no sliding once touched, 2: welded but sliding, 3: welded
    double weld_velocity = 0; ///< WVEL: nodes weld that come in faster [velocity]
    bool orthotropic = false; ///< the friction below in place of `friction`, along `friction_axis` and across
    Vec3 friction_axis{};
    std::array<double, 2> static_friction{}, dynamic_friction{}, friction_decay{};

    bool all_nodes = true;
    std::vector<Index> nodes;    ///< when not all_nodes
    std::vector<Index> excluded; ///< never touch this wall
    double offset = 0;           ///< nodes within this distance are taken as slave nodes [length]; 0: all
    double birth = 0;
    double death = forever;

    Index motion_curve = none; ///< velocity or displacement along motion_direction
    bool motion_is_displacement = false;
    Vec3 motion_direction{};   ///< unit
    double mass = 0;           ///< _MOVING: of the wall, which moves along its normal [mass]; 0: it does not
    double start_velocity = 0; ///< of the mass, along the normal [velocity]
    Location where;
};

/// *LOAD_SEGMENT, *LOAD_SEGMENT_SET, *LOAD_SHELL: pressure scale * curve(t - arrival) against the segments'
/// normals.
struct PressureLoad {
    std::vector<std::array<Index, 4>> segments; ///< node indices; a triangle repeats the third
    Index curve = none;
    double scale = 1;
    double arrival = 0; ///< AT [time]
    Location where;
};

/// *LOAD_BLAST_ENHANCED: an explosion in air, and the surfaces that it loads (*LOAD_BLAST_SEGMENT, _SET).
struct BlastLoad {
    /// One of the deck's units in those of the blast's data.
    struct Units {
        double pounds = 1, feet = 1, milliseconds = 1, psi = 1;
    };
    struct Surface {
        std::vector<std::array<Index, 4>> segments; ///< node indices; a triangle repeats the third
        double scale = 1;                           ///< SCALEP [-]
    };
    Id id = 0;
    bool on_the_ground = false; ///< a hemisphere on the ground (BLAST = 1), or a sphere in air (2)
    double mass = 0;            ///< of TNT [mass]
    Vec3 centre{};              ///< [length]
    Index node = none;          ///< NIDBO: where the charge is in place of the centre
    double start = 0;           ///< TBO: the explosion [time]
    double death = forever;     ///< no load any more [time]
    bool negative_phase = true; ///< NEGPHS = 0
    Units units;
    std::vector<Surface> surfaces;
    Location where;
};

/// *DAMPING_GLOBAL, *DAMPING_PART_MASS, *DAMPING_RELATIVE: force -rate * curve(t) * scale * m v.
struct NodeDamping {
    std::vector<Index> parts; ///< empty: everything
    double rate = 1;          ///< [1/time]
    Index curve = none;
    std::array<double, 6> scale{1, 1, 1, 1, 1, 1}; ///< x, y, z, about x, about y, about z
    std::vector<Index>
        reference_nodes; ///< nodes of the rigid part whose motion is not damped; empty: at rest
    double birth = 0;
    double death = forever;
    Location where;
};

/// *DAMPING_PART_STIFFNESS: stresses in proportion to elastic moduli and strain rates.
struct StiffnessDamping {
    Index part = none;
    /// COEF: above 0 the share of critical damping in the fastest motion that a step resolves [-]; below 0
    /// minus Rayleigh's coefficient of the stiffness [time].
    double coefficient = 0;
    Location where;
};

/// *BOUNDARY_NON_REFLECTING: waves leave through these segments of solids.
struct NonReflectingBoundary {
    std::vector<std::array<Index, 4>> segments;
    bool dilatational = true; ///< AD = 0
    bool shear = true;        ///< AS = 0
    Location where;
};

/// *DATABASE_CROSS_SECTION_SET, _PLANE: the force that some elements exert on some of their nodes.
struct CrossSection {
    Id id = 0;
    std::string title;
    std::vector<Index> nodes;
    std::vector<Index> solids, shells, beams, thick_shells, discretes;
    double area = 0; ///< of the cut, at the start [length^2]; 0 where it is not known
    Location where;
};

/// *DATABASE_NODAL_FORCE_GROUP: nodes whose external forces nodfor shows.
struct NodalForceGroup {
    Id id = 0;
    std::string title;
    std::vector<Index> nodes;
    Index system = none; ///< in which the sum is shown besides
    Location where;
};

/// *TERMINATION_...: the run ends when this comes true.
struct Termination {
    enum class Kind { node, body, deleted_shells, deleted_solids, curve, contact };
    Kind kind = Kind::node;
    Index index = none;                            ///< node, part, curve or contact of the Model
    std::vector<Index> parts;                      ///< of deleted elements
    int axis = 0;                                  ///< 0 to 2: x, y, z; of `node`, 3: any contact
    double largest = forever, smallest = -forever; ///< coordinate of a node, displacement of a body [length]
    long count = 0;                                ///< deleted elements that end the run; 0: all of the parts
    double time = 0;                               ///< activation (curve, contact) [time]
    double duration = 0;  ///< a contact must have been without force for so long [time]
    double threshold = 0; ///< of the contact force [force]
    Location where;
};

} // namespace plash
