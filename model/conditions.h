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
    double birth = 0;       ///< [time]
    double death = forever; ///< [time]
    Location where;
};

/// *BOUNDARY_PRESCRIBED_MOTION: one degree of freedom of some nodes follows scale * curve(t).
struct PrescribedMotion {
    enum class Kind { velocity, acceleration, displacement };
    std::vector<Index> nodes;
    Index rigid_part = none;    ///< _RIGID: the part that is driven, and `nodes` is empty
    Vec3 direction{};           ///< unit vector of the freedom
    bool rotation = false;      ///< about `direction` instead of along it
    bool only_component = true; ///< other components stay free
    Kind kind = Kind::velocity;
    Index curve = none;
    double scale = 1;
    double birth = 0;
    double death = forever;
    Location where;
};

/// *LOAD_NODE: force (or moment) scale * curve(t) along one global axis on each node.
struct NodalLoad {
    std::vector<Index> nodes;
    Vec3 direction{}; ///< unit vector
    bool moment = false;
    Index curve = none;
    double scale = 1;
    Location where;
};

/// *LOAD_BODY_X/Y/Z: base acceleration scale * curve(t) along an axis; the body force acts against it.
struct BodyLoad {
    Vec3 direction{}; ///< unit vector
    Index curve = none;
    double scale = 1;
    std::vector<Index> parts; ///< empty: everything
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
    Location where;
};

/// *INITIAL_VELOCITY_RIGID_BODY: motion of a rigid part at its centre of mass, over all other entries.
struct RigidBodyVelocity {
    Index part = none;
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

/// *RIGIDWALL_PLANAR: half space behind a plane that nodes may not enter.
struct PlanarWall {
    Id id = 0;
    std::string title;
    Vec3 tail{};         ///< a point of the plane
    Vec3 normal{};       ///< unit, pointing to the side of the nodes
    double friction = 0; ///< Coulomb; >= 1: no sliding once touched (LS-DYNA's FRIC = 1)
    bool all_nodes = true;
    std::vector<Index> nodes;    ///< when not all_nodes
    std::vector<Index> excluded; ///< never touch this wall
    double offset = 0;           ///< nodes within this distance are taken as slave nodes [length]; 0: all
    double birth = 0;
    double death = forever;
    double added_energy_scale = 1; ///< unused by physics: RWKSF
    Location where;
};

} // namespace plash
