#pragma once

#include "ale/box_boundary.h"
#include "ale/fluid_law.h"
#include "ale/lagrange.h"
#include "ale/mesh_point.h"
#include "ale/remap.h"
#include "ale/slip_nodes.h"
#include "math/vector3.h"

namespace plash {

/// What a fluid has done so far [energy]. Kinetic and internal are at t_n.
struct FluidEnergies {
    double kinetic = 0;
    double internal = 0;
    double outside_work = 0;   ///< by gravity, outside pressure and driven nodes
    double coupling_work = 0;  ///< by outside forces
    double advection_loss = 0; ///< kinetic energy that the remap has taken
    double outflow = 0; ///< energy that has left through open sides and into ambient cells, less what came in
    std::vector<double> group_internal; ///< internal energy by group

    void serialise(Archive& archive);
};

/// A cell of a fluid's mesh as it stands at the start.
struct FluidCell {
    std::ptrdiff_t place = 0; ///< in the arrays over cells
    double volume = 0;        ///< [length^3]
    /// Places of its nodes; bit 0, 1, 2 of the number for the upper side along its first, second, third axis.
    std::array<std::ptrdiff_t, 8> corners{};
    std::array<Vec3, 8> points; ///< where they stand [length]
};

/// A node of an outer face of a mesh, for each such face; `axis` is the global axis along the face's normal,
/// -1 when there is none.
struct OuterNode {
    std::size_t number;
    int axis;
    Vec3 area{}; ///< outward, that the node has of the face; only without an axis [length^2]
};

/// A face behind a coupled surface: some fluids do not leave the cell through it. What moves through it while
/// the cell is full stands behind the surface, as deep as its springs are, and is kept as volume beyond that
/// of the cell: given back for nothing, the pressure would work on the springs without falling.
struct DryFace {
    std::ptrdiff_t cell; ///< storage place
    int axis, side;      ///< of the cell
    unsigned fluids;     ///< bit g for fluid g
};

/// A node of an outer face from which waves do not come back: the outside presses with what the fluid had at
/// the start and resists its motion along the normal with density times speed of sound (Lysmer & Kuhlemeyer
/// 1969, J. Eng. Mech. Div. 95, 859-877, eq. 5: exact for sound that arrives along the normal).
struct AbsorbingNode {
    std::ptrdiff_t place = 0;
    Vec3 area{};          ///< outward [length^2]
    Vec3 pressure_area{}; ///< sum of pressure at the start times area [force]
    double damping = 0;   ///< sum of density times speed of sound times area [force/velocity]
};

/// An Eulerian fluid on a mesh, whose kind is that of the class derived from this one (BoxFluid, HexFluid):
/// state, step and energies. All times t_n; see ale/lagrange.h and ale/remap.h for the two halves of a step.
class Fluid {
public:
    std::vector<FluidGroup> groups;
    LagrangeSettings lagrange;
    AdvectionOrder order = AdvectionOrder::van_leer;
    double smooth_square = 0;        ///< of the momentum's remap, see carried_velocities [velocity^2]
    std::array<double, 3> gravity{}; ///< [acceleration]
    bool open_sides = false;         ///< fluid may cross the outer faces
    double outside_pressure = 0;     ///< on the outer faces [pressure]
    FluidFields fields;
    std::vector<HeldNode> held;
    std::vector<SlipNode> slipping;
    std::vector<NodeForceFromOutside> outside_forces; ///< of the coming step; the owner fills and clears it
    std::vector<DryFace> dry_faces;                   ///< likewise
    std::vector<NodeForceFromOutside> loads;          ///< likewise, but on the fluid alone, over its own step
    std::vector<AbsorbingNode> absorbing;

    virtual ~Fluid() = default;
    Fluid(Fluid&&) = default;

    /// The kinetic energy that the remap takes shall become heat where it was taken.
    void conserve_total_energy() { fields.lost_motion.assign(fields.node_mass.size(), 0.0); }
    /// Slopes of the velocity stay as they are where it changes by less than this share of the smallest speed
    /// of sound of any group at rest: sets smooth_square.
    void keep_smooth_slopes(double share);
    /// Cells that keep the mass, energy and fractions which they have now, whatever flows through them.
    void keep_ambient(std::vector<std::ptrdiff_t> places);
    /// To be called once the initial masses, energies, fractions and velocities are set.
    void start();
    /// From t_n to t_n + step. Outside forces act with `impulse_step` (the loop's velocity step).
    void advance(double step, double impulse_step);
    void advance(double step) { advance(step, step); }

    /// Where the coming step accelerates fluid most, and how much along an axis, with the forces of outside
    /// as they are now; what the boundary drives or holds is not. Nodes with less than a thousandth of the
    /// heaviest one's mass do not count.
    struct Unrest {
        double acceleration = 0; ///< [acceleration]
        std::size_t node = 0;    ///< by its number
    };
    Unrest unrest();

    /// Largest stable step at t_n, before any safety factor [time], and the cell that limits it.
    double stable_step() const { return limit_.rate > 0 ? 1 / limit_.rate : 1e300; }
    /// By its number; negative: none.
    std::ptrdiff_t limiting_cell() const { return limit_.rate > 0 ? number_of(limit_.place) : -1; }
    const FluidEnergies& energies() const { return energies_; }
    long steps_done() const { return steps_; }

    /// Sets a cell to hold `fraction` of a group at the given density and energy per mass.
    void fill_place(std::ptrdiff_t place, double volume, int group, double fraction, double density,
                    double energy_per_mass);
    virtual double total_mass(int group) const = 0;
    virtual std::array<double, 3> momentum() const = 0;

    /// The mesh as the deck numbers it: cells and nodes in the order of the MeshBlock.
    virtual std::size_t cell_count() const = 0;
    virtual std::size_t node_count() const = 0;
    virtual FluidCell cell(std::size_t number) const = 0;
    virtual double volume_of(std::ptrdiff_t place) const = 0;
    virtual std::ptrdiff_t node_place(std::size_t number) const = 0;
    virtual std::vector<OuterNode> outer_nodes() const = 0;
    /// Nothing passes outer faces between nodes that slip, though their walls be curved. To be called before
    /// the start.
    virtual void close_curved_walls() {}
    /// Moves the mesh as a whole.
    virtual void shift(const std::array<double, 3>& distance) = 0;
    /// In the coming step, whose length is given, the nodes go to these places. Not on a box.
    virtual void move_nodes(std::vector<Vec3> next, double step) = 0;

    /// Where a point lies in the mesh; looks first in the cell where it was before.
    virtual MeshPoint locate(const Vec3& point, const std::array<int, 3>& guess) const = 0;
    virtual std::ptrdiff_t place_of(const MeshPoint& point) const = 0;
    /// The cell beyond a face of the point's cell; negative: the mesh ends there.
    virtual std::ptrdiff_t cell_beyond(const MeshPoint& point, int axis, int side) const = 0;
    /// The nodes of the point's cell with trilinear weights.
    virtual PlaceWeights node_weights(const MeshPoint& point) const = 0;
    /// Cells around the point whose values, so weighted, vary continuously with it.
    virtual PlaceWeights cell_weights(const MeshPoint& point) const = 0;
    /// Edges of the point's cell along its three axes [length].
    virtual std::array<Vec3, 3> edges(const MeshPoint& point) const = 0;
    /// Whether none of these fluids (bit g for fluid g) stands so near a box between two corners that a point
    /// in it might meet them: within two cells of it and of what is half a cell away. False: not known.
    /// guess  cell to look in first
    virtual bool dry_around(const Vec3& /*low*/, const Vec3& /*high*/, const std::array<int, 3>& /*guess*/,
                            unsigned /*fluids*/) const
    {
        return false;
    }
    /// Largest distance of coupling points along the edge of a segment from `a` to `b` [length].
    virtual double point_spacing(const Vec3& a, const Vec3& b) const = 0;

    /// All that goes from step to step.
    virtual void serialise(Archive& archive);

protected:
    Fluid(std::vector<FluidGroup> groups, LagrangeSettings settings, FluidFields fields);

    /// The parts of a step, each on the mesh of the derived class; see the functions of the same names in
    /// ale/lagrange.h, ale/remap.h and ale/box_boundary.h.
    virtual double accelerate(double step) = 0;
    /// What gravity has done besides its work on the masses of the nodes, once mean velocities are known.
    virtual double further_gravity_work(double) const { return 0; }
    virtual void deform(double step) = 0;
    virtual double work_on_sides(double step) const = 0;
    /// Returns the kinetic energy that has left through open sides.
    virtual double sweep() = 0;
    virtual double return_lost_motion() = 0;
    virtual void find_node_masses() = 0;
    virtual CrossingRate evaluate(double last_step) = 0;
    virtual std::ptrdiff_t number_of(std::ptrdiff_t place) const = 0;
    virtual void update_contents() = 0;
    /// Once the shares of what leaves the cells are known, those of a dry face.
    void close(const DryFace& face);
    /// Forces of outside have done the work of the pressure of some cells, which is not booked as theirs.
    void book_cut_work(double work) { energies_.coupling_work -= work; }
    virtual double kinetic_energy() const = 0;
    virtual double internal_energy(int group) const = 0;

private:
    CrossingRate limit_;
    FluidEnergies energies_;
    long steps_ = 0;
    std::vector<NodeForceFromOutside> absorbing_forces_; ///< of the present step

    /// Cells in a kept state, and that state by group: mass, energy, fraction.
    std::vector<std::ptrdiff_t> ambient_places_;
    std::vector<std::array<double, 3>> ambient_state_;
    std::vector<double> ambient_volume_; ///< in which that is [length^3]

    double remap();
    double restore_ambient();
    void sum_energies();
    double sum_internal() const;
};

/// Order in which the `count` directions of a mesh are swept in a step: round the ring so that none is
/// favoured, forth and back for second order (Strang 1968).
inline int swept_direction(long step, int position, int count)
{
    const long turn = step / 2 % count;
    return static_cast<int>((step % 2 == 0 ? turn + position : turn + count - 1 - position) % count);
}

} // namespace plash
