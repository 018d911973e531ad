#pragma once

#include "math/symmetric_tensor.h"
#include "math/vector3.h"
#include "model/record.h"

#include <array>
#include <string_view>
#include <vector>

namespace plash {

/// What element terms hand to recorders on demand, by the Model's element order. A recorder sizes the arrays
/// that it wants; terms fill those that are not empty.
struct ElementResults {
    using Stress = SymmetricTensor<double>;

    /// Row of each element (by the Model's order) in the arrays below, `none` where the recorder does not
    /// want the element. Empty: every element is wanted and its row is its own index.
    std::vector<Index> shell_rows;
    std::vector<Index> solid_rows;
    std::vector<Index> beam_rows;
    std::vector<Index> thick_shell_rows;

    Index row_of_shell(Index shell) const { return shell_rows.empty() ? shell : shell_rows[shell]; }
    Index row_of_solid(Index solid) const { return solid_rows.empty() ? solid : solid_rows[solid]; }
    Index row_of_beam(Index beam) const { return beam_rows.empty() ? beam : beam_rows[beam]; }

    Index row_of_thick_shell(Index shell) const
    {
        return thick_shell_rows.empty() ? shell : thick_shell_rows[shell];
    }

    /// Shells carry their through-thickness points as `shell_layers` rows an element, from bottom to top.
    /// With three layers (LS-DYNA's MAXINT = 3) they are the middle, the innermost and the outermost
    /// integration point.
    int shell_layers = 0;
    std::vector<Stress> shell_stress;         ///< element x layer, global axes [stress]
    std::vector<double> shell_plastic_strain; ///< element x layer [-]
    /// Mxx Myy Mxy Qx Qy Nxx Nyy Nxy in local axes [force], [force/length] as in LS-DYNA's elout
    std::vector<std::array<double, 8>> shell_resultants;
    std::vector<double> shell_thickness; ///< [length]
    int shell_history_size = 0;          ///< NEIPS: history variables wanted of each layer, thick shells too
    std::vector<double> shell_history;   ///< element x layer x variable
    /// Strains since the start of the innermost and the outermost point, tensor components, global axes [-].
    std::vector<std::array<Stress, 2>> shell_strain;
    std::vector<double> shell_internal_energy; ///< density in the d3plot sense: [energy/volume]

    /// Thick shells likewise: the points through the thickness as `thick_shell_layers` rows an element.
    int thick_shell_layers = 0;
    std::vector<Stress> thick_shell_stress;         ///< element x layer, global axes [stress]
    std::vector<double> thick_shell_plastic_strain; ///< element x layer [-]
    std::vector<double> thick_shell_history;        ///< element x layer x variable
    std::vector<std::array<Stress, 2>> thick_shell_strain;

    std::vector<Stress> solid_stress;         ///< global axes [stress]
    std::vector<double> solid_plastic_strain; ///< [-]
    int solid_history_size = 0;               ///< NEIPH: history variables wanted of each solid
    std::vector<double> solid_history;        ///< element x variable, means over its points
    std::vector<Stress> solid_strain;         ///< since the start, tensor components, global axes [-]
    std::vector<double> solid_density;        ///< of Eulerian cells, with what is empty in them; 0 elsewhere
                                              ///< [density]
    /// Share of each group of the deck in the volume of Eulerian cells, group by group [-].
    std::vector<std::vector<double>> solid_fraction;

    /// Of a beam in its local axes r (from node 1 to 2), s and t. Bending moments are those at mid-length,
    /// about the axis that they are named after.
    struct BeamState {
        double axial = 0, shear_s = 0, shear_t = 0;     ///< [force]
        double moment_s = 0, moment_t = 0, torsion = 0; ///< [moment]
        double plastic_strain = 0;                      ///< largest of the points [-]
        double length = 0;                              ///< [length]
        int points = 0;                                 ///< of its cross section that have stresses
    };
    struct BeamPoint {
        double axial = 0, shear_rs = 0, shear_tr = 0; ///< [stress]
        double plastic_strain = 0;
    };
    std::vector<BeamState> beams;
    int beam_points = 0;                ///< points shown of each beam; 0: none
    std::vector<BeamPoint> beam_stress; ///< element x point

    std::vector<std::uint8_t> shell_deleted; ///< 1: eroded
    std::vector<std::uint8_t> solid_deleted;
    std::vector<std::uint8_t> beam_deleted;
    std::vector<std::uint8_t> thick_shell_deleted;

    /// A particle (smoothed particle hydrodynamics).
    struct Particle {
        double smoothing = 0;       ///< smoothing length h [length]
        double pressure = 0;        ///< [stress]
        double density = 0;         ///< [mass/volume]
        double mass = 0;            ///< [mass]
        double internal_energy = 0; ///< of the whole particle [energy]
        double plastic_strain = 0;  ///< of solids; of fluids, as in LS-DYNA, ln(density / reference) [-]
        Stress stress{};            ///< Cauchy, global axes [stress]
        int neighbours = 0;         ///< particles closer than the kernel's radius
        bool active = false;        ///< takes part in the run
    };
    std::vector<Particle> particles; ///< by the Model's order (Model::particles); every row or none

    /// By part of the Model: mass, kinetic energy and momentum of the element masses, and what eroded
    /// elements of the part held when they went.
    struct PartMotion {
        double mass = 0, kinetic = 0;
        double momentum[3] = {0, 0, 0};
        bool outside_state = false;                     ///< this mass is not in State::mass
        double eroded_internal = 0, eroded_kinetic = 0; ///< [energy]
    };
    std::vector<PartMotion> part_motion;

    /// What the elements of a cross section exert on its nodes, by section of the Model; sized (with the
    /// centroids set) by whoever wants it.
    struct SectionForce {
        Vec3 force{};
        Vec3 moment{}; ///< about the centroid [moment]
        Vec3 centroid{};
    };
    std::vector<SectionForce> sections;

    /// Stable steps of single elements at the start [time], before the deck's safety factor.
    struct ElementStep {
        std::string_view kind{}; ///< "shell", "solid" ...
        Id element = 0, part = 0;
        double step = 0;
    };
    bool steps_wanted = false;
    std::vector<ElementStep> steps; ///< appended by the element groups

    /// Force of the nodes on each rigid wall; `normal` is its share against the wall's normal [force].
    struct WallForce {
        Id wall = 0;
        double normal = 0;
        Vec3 force{};
        double energy = 0; ///< taken out of the motion so far [energy]
        Vec3 moved{};      ///< of the wall since the start [length]
    };
    std::vector<WallForce> walls; ///< appended by the walls' terms

    /// Force and moment of a support, a load or a driven motion on a node, or of a driven motion on a whole
    /// rigid part (then `node` is none). A node held or driven several times has several entries.
    struct BoundaryForce {
        Index node = none;
        Index rigid_part = none;
        Vec3 force{}, moment{};
        double energy = 0; ///< put in so far; 0 for supports [energy]
    };
    bool boundary_forces_wanted = false; ///< the three lists below are filled only then
    std::vector<BoundaryForce> supports; ///< appended by the fixities' term
    std::vector<BoundaryForce> loads;    ///< appended by the nodal loads' term
    std::vector<BoundaryForce> motions;  ///< appended by the prescribed motions' and the rigid bodies' terms

    /// Forces and energies of one contact (*CONTACT_...).
    struct ContactForce {
        Id contact = 0;
        bool two_sides = true;                ///< false: single surface, whose resultants say nothing
        Vec3 slave_force{}, master_force{};   ///< on each side at n [force]
        Vec3 slave_moment{}, master_moment{}; ///< about the origin [moment]
        double slave_mass = 0, master_mass = 0;
        double slave_energy = 0, master_energy = 0; ///< taken out of the motion of each side so far [energy]
        double friction_energy = 0;                 ///< the part of both that friction has taken
    };
    std::vector<ContactForce> contacts; ///< appended by the contacts' terms, in deck order

    /// A spring or damper (*ELEMENT_DISCRETE) at n.
    struct SpringState {
        Index element = none; ///< of the Model
        bool torsional = false;
        Vec3 force{};          ///< on its first node, or moment
        double magnitude = 0;  ///< tension, or opening, positive [force] or [moment]
        double deflection = 0; ///< [length] or [angle]
    };
    bool springs_wanted = false; ///< the two lists below are filled only then
    std::vector<SpringState> springs;

    /// A discrete beam at n: three components along, and three about, its local axes.
    struct DiscreteBeam {
        Index beam = none;                 ///< of the Model
        std::array<double, 6> way{};       ///< [length], [angle]
        std::array<double, 6> resultant{}; ///< [force], [moment]
        std::array<Vec3, 3> axes{};
    };
    std::vector<DiscreteBeam> discrete_beams;

    /// External force on a node of a *DATABASE_NODAL_FORCE_GROUP at n, group by group in deck order.
    struct NodalForce {
        Vec3 force{};      ///< of loads, supports, drives and walls [force]
        double energy = 0; ///< work that it has done so far [energy]
    };
    std::vector<NodalForce> nodal_forces;

    /// Motion of one rigid body at its center; `axes` are those of the body now.
    struct RigidMotion {
        Id body = 0;
        bool nodal = false; ///< *CONSTRAINED_NODAL_RIGID_BODY
        Vec3 place{}, displacement{}, velocity{}, acceleration{};
        Vec3 angle{}, angular_velocity{}, angular_acceleration{}; ///< angle: integral of the angular velocity
        std::array<Vec3, 3> axes{};
    };
    double rigid_mass = 0;             ///< of all rigid bodies, whose nodes have no mass in the State [mass]
    Vec3 rigid_momentum{};             ///< of these [momentum]
    bool rigid_motions_wanted = false; ///< the two lists below are filled only then
    std::vector<RigidMotion> rigid_bodies;

    /// Force and moment of one joint on its second body at its first node, global axes.
    struct JointForce {
        Id joint = 0;
        Vec3 force{}, moment{};
        double energy = 0; ///< put into the bodies so far (motors) [energy]
    };
    std::vector<JointForce> joints;

    /// Force of all contacts on each node, summed by the contacts' terms; empty unless wanted [force].
    std::vector<Vec3> contact_force;
    /// Pressure of all contacts on each node: normal forces over the area of its exposed segments; empty
    /// unless wanted [stress].
    std::vector<double> contact_pressure;

    /// Force of Eulerian fluids on each node, summed by the couplings' terms; empty unless wanted [force].
    std::vector<Vec3> coupling_force;

    /// A tracer (*DATABASE_TRACER) at n.
    struct Tracer {
        Vec3 place{}, velocity{};
        Stress stress{};
        double plastic_strain = 0;  ///< [-]
        double density = 0;         ///< of the material without the void beside it [density]
        double relative_volume = 0; ///< its reference density over it [-]
        bool active = false;        ///< there is material where it is
        /// Of a structure; then stress, plastic strain and density are the element's, and not filled here.
        Index solid = none;
    };
    bool tracers_wanted = false; ///< the list below is filled only then
    std::vector<Tracer> tracers; ///< by the deck's order

    /// Sums over cells of Eulerian meshes of what one group of the deck has there.
    struct FluidSum {
        double volume = 0, mass = 0, kinetic = 0, internal = 0;
        double momentum[3] = {0, 0, 0};
        double lowest_pressure = 0, highest_pressure = 0; ///< of cells that hold some of it [pressure]
    };
    struct FluidRegion {
        std::vector<bool> solids;     ///< of the Model that count; empty: all
        std::vector<FluidSum> groups; ///< by the deck's order, sized by whoever wants them
    };
    std::vector<FluidRegion> fluid_regions;

    /// What an Eulerian cell holds.
    struct FluidCellSum {
        double mass = 0, volume = 0, internal = 0, kinetic = 0, pressure = 0;
    };
    std::vector<FluidCellSum> fluid_cells; ///< by solid of the Model; every row or none

    /// By node: change of the velocity from n-1/2 to n+1/2 over that span [length/time^2]. Recorders put in
    /// force / mass; terms that move nodes themselves (rigid bodies) overwrite the entries of their nodes.
    std::vector<Vec3> acceleration;
    /// By node: velocity at n. Recorders put in that of the State; terms whose material flows through a mesh
    /// overwrite the entries of its nodes. Empty unless the deck has such a mesh.
    std::vector<Vec3> material_velocity;
    std::vector<Vec3> angular_acceleration; ///< [1/time^2], only with rotations

    /// The content of an airbag at n (*AIRBAG family).
    struct AirbagState {
        Id airbag = 0;
        double volume = 0;
        double pressure = 0;            ///< gauge [pressure]
        double internal_energy = 0;     ///< [energy]
        double inflow = 0, outflow = 0; ///< [mass/time]
        double mass = 0;
        double temperature = 0;
        double area = 0; ///< of the surface
    };
    std::vector<AirbagState> airbags; ///< appended by the airbags' term, in deck order

    /// An exposed segment of a contact with what acts on it.
    struct ContactFace {
        Id contact = 0;
        Index part = none;
        int sides = 1;                ///< 1 of the first surface, 2 of the second, 3 of both
        std::array<Index, 4> nodes{}; ///< State indices; a triangle repeats the third
        double pressure = 0;          ///< mean of its corners' [stress]
        Vec3 shear{};                 ///< friction on the face, likewise [stress]
        double penetration = 0;       ///< deepest of its touches [length]
        double friction_energy = 0;   ///< that friction has taken so far, half on each side [energy/area]
    };
    bool contact_faces_wanted = false; ///< the list below is filled only then
    std::vector<ContactFace> contact_faces;
};

} // namespace plash
