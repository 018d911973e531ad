#pragma once

#include "math/vector3.h"
#include "model/record.h"

#include <array>
#include <vector>

namespace plash {

/// Nodes in deck order.
struct Nodes {
    std::vector<Id> id;
    std::vector<Vec3> position; ///< [length], at the start

    std::size_t size() const { return id.size(); }
};

/// Elements of one topology in deck order; `part` and `nodes` are indices into the Model.
/// Degenerate shapes repeat nodes (triangle: n4 = n3; tetrahedron: n5..n8 = n4).
template <int Corners>
struct Elements {
    std::vector<Id> id;
    std::vector<Index> part;
    std::vector<std::array<Index, Corners>> nodes;

    std::size_t size() const { return id.size(); }
};

/// One ply of a composite part or element.
struct Layer {
    Index material = none;
    double thickness = 0; ///< [length]
    double angle = 0;     ///< of the material axes [degree]
};

struct ShellElements : Elements<4> {
    /// [length] at the four corners; empty unless some element of the deck has its own thickness.
    /// A zero first entry means: as the section says.
    std::vector<std::array<double, 4>> thickness;
    std::vector<double> material_angle;     ///< BETA [degree]; empty unless some element has one
    std::vector<Index> material_system;     ///< _MCID, into coordinate_systems; empty or as above
    std::vector<std::vector<Layer>> layers; ///< _COMPOSITE, bottom first; empty or as above
    std::vector<double> offset; ///< of the reference surface along the normal [length]; empty or as above
    std::vector<std::array<Index, 4>> mid_nodes; ///< of eight-node shells; empty unless there are any
};

/// Axes of an element's own material directions, as *ELEMENT_SOLID_ORTHO gives them.
struct MaterialAxes {
    Vec3 a{}, d{};
};

struct SolidElements : Elements<8> {
    std::vector<MaterialAxes> axes; ///< empty unless some element has its own
    std::vector<Index> ten_nodes;   ///< into Model::tetrahedra, `none` for others; empty unless there are any
};

/// Ten-node tetrahedra: four corners, then the nodes on the edges 12, 23, 31, 14, 24, 34. Each is a solid of
/// its corners too (SolidElements::ten_nodes), under the same number.
using TetrahedronElements = Elements<10>;

struct ThickShellElements : Elements<8> {
    std::vector<double> material_angle; ///< BETA [degree]; empty unless some element has one
    std::vector<std::vector<Layer>>
        layers; ///< _COMPOSITE, bottom first; empty unless some element has its own
};

/// Two end nodes and the node that turns the cross section (`none`: the section has no direction).
struct BeamElements : Elements<3> {
    std::vector<Vec3>
        orientation; ///< _ORIENTATION: in place of the third node; empty unless some element has one
    std::vector<Index> options; ///< into `others`: the element's own card with its releases, thicknesses,
                                ///< section, offsets ...; empty unless some element has more than its nodes
};

/// *ELEMENT_DISCRETE: springs and dampers between two nodes (second one `none`: to the ground).
struct DiscreteElements : Elements<2> {
    std::vector<Index>
        orientation; ///< VID as index into `others` of *DEFINE_SD_ORIENTATION; none: along the nodes
    std::vector<double> scale;          ///< S: factor on the forces
    std::vector<double> initial_offset; ///< OFFSET [length] or [angle]
    std::vector<std::uint8_t> silent;   ///< PF = 1: not shown in deforc; empty: all are shown
};

/// *ELEMENT_MASS: masses added to nodes.
struct NodalMasses {
    std::vector<Id> id;
    std::vector<Index> node;
    std::vector<double> mass; ///< [mass]

    std::size_t size() const { return id.size(); }
};

/// *ELEMENT_SPH: particles, each a node of its own.
struct ParticleElements {
    std::vector<Index> node;
    std::vector<Index> part;
    std::vector<double> mass; ///< [mass]; negative: minus the volume [length^3]

    std::size_t size() const { return node.size(); }
};

/// A part: which section, material and so on its elements have (indices into the Model, or `none`).
struct Part {
    Id id = 0;
    std::string title;
    Location where;
    Index section = none;
    Index material = none;
    Index equation_of_state = none;
    Index hourglass = none;    ///< none: as *CONTROL_HOURGLASS says
    std::vector<Layer> layers; ///< *PART_COMPOSITE, bottom first; such a part has no section and no material
    Index composite = none;    ///< into `others`: the *PART_COMPOSITE itself (formulation, shear factor ...)
    bool made_rigid = false;   ///< *DEFORMABLE_TO_RIGID: rigid from the start whatever its material
};

/// *PART_INERTIA: mass properties of a rigid part in place of those of its elements.
struct PartInertia {
    double mass = 0;                                                       ///< TM [mass]
    Vec3 center{};                                                         ///< [length]
    Index center_node = none;                                              ///< NODEID in place of `center`
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;                 ///< [mass length^2]
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}; ///< of the tensor
    Vec3 velocity{};                                                       ///< at the start [velocity]
    Vec3 angular_velocity{};                                               ///< at the start [1/time]
    Location where;
};

} // namespace plash
