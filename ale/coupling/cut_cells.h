#pragma once

#include "ale/box_fluid.h"
#include "ale/coupling/box_cuts.h"
#include "ale/hydrostatic.h"

namespace plash {

/// The cells of a box that a closed surface cuts, and what becomes of the fluid in their parts outside it
/// (Noh 1964). In place of springs the fluid of such a cell has a volume: that of the part, of which the
/// surface takes and gives what it sweeps, and through whose open faces the rest passes. Its pressure acts on
/// the nodes by the open faces and on the surface by the surface's area in the cell.
///
/// Parts of less than half a cell would be too stiff for the step: each joins the neighbour behind its widest
/// open face, and all that hang together have one density and one pressure (cell mixing as in Hu, Khoo, Adams
/// & Huang 2006, J. Comput. Phys. 219, 553-578, section 3.2, here by what passes the face between them, so
/// that momentum goes along).
class CutCells : public CutCellStep {
public:
    explicit CutCells(BoxFluid& fluid);

    /// Fluid that hangs together: one cell, or several that are joined.
    struct Group {
        double volume = 0; ///< of the open parts at t_n [volume]
        double swept = 0;  ///< rate at which the surface takes it, at t_n [volume/time]
        double structure_compliance =
            0;               ///< of the surface's nodes: squares of areas over mass [length^4/mass]
        double pressure = 0; ///< for the coming step, with bulk viscosity [pressure]
        double filled = 0;   ///< share of the volume
        double step = 1e300; ///< largest stable one [time]
        double density = 0;  ///< mean over the open parts [density]
        Vec3 middle{};       ///< where the pressure stands [length]
    };

    /// For a fluid that starts at rest below a level: fills the wet parts of the cells that the surface cuts,
    /// at the densities that they have, as exactly as cuts are known: what misses or is too much by a share e
    /// is a pressure e K. Returns the largest share of a cell that had to come or go.
    double fill_wet_parts(const BoxCuts& cuts, const StillLevel& level);
    /// For a structure that looks for its place beside fluid at rest: gives the cells that the surface cuts
    /// now as much fluid as their open parts have at the densities of the first call, so that the pressure
    /// stays that of the start.
    void fill_at_rest(const BoxCuts& cuts);
    /// What the surface cuts at t_n.
    void begin(const BoxCuts& cuts);
    Index group_of(std::ptrdiff_t place) const
    {
        return entry_[place] == none ? none : cells_[entry_[place]].group;
    }
    std::vector<Group>& groups() { return groups_; }
    /// Pressures, once it is known what the surface sweeps. step  that of the last cycle
    void find_pressures(double step);
    /// At a place in a group's fluid, whose weight it bears [pressure].
    double pressure_at(Index group, const Vec3& place, const Vec3& gravity) const
    {
        const Group& own = groups_[group];
        return own.pressure + own.density * dot(gravity, place - own.middle);
    }
    /// Adds the forces of the pressures on the nodes to add(node, axis, force). The weight of a cell, which
    /// the fluid's own step gives to all of its nodes alike, goes to those that its pressure moves, as the
    /// hydrostatic pressure on its open faces: else the nodes behind a wall would fall, and those before it
    /// rise.
    template <class Add>
    void press_nodes(const Vec3& gravity, Add&& add) const
    {
        for (const Cell& cell : cells_) {
            for (const std::ptrdiff_t node : nodes_of(cell))
                for (int axis = 0; axis < 3; ++axis)
                    add(node, axis,
                        -0.125 * fluid_.fields.total_mass()[cell.place] * (gravity.*vector_component[axis]));
            for (int side = 0; side < 6; ++side) {
                const Face& face = faces_[cell.face[side]];
                const double pressure = pressure_at(cell.group, face.middle, gravity);
                for (int n = 0; n < 4; ++n)
                    add(face.node[n], side / 2, (side % 2 == 0 ? -1 : 1) * pressure * face.weight[n]);
            }
        }
    }
    /// What the surface cuts at the end of the coming step.
    void end(const BoxCuts& cuts);
    double stable_step() const;

    void before_forces() override;
    double deform(double step) override;
    void share_outflow(int axis) override;
    void keep() override;
    void restore() override;

    void serialise(Archive& archive);

private:
    struct Face {
        std::ptrdiff_t place;
        int axis;
        double open;
        std::array<std::ptrdiff_t, 4> node;
        std::array<double, 4> weight; ///< of the nodes' velocities in what passes [length^2]
        bool joint = false;           ///< between parts that have joined
        Vec3 middle{};                ///< of the open part [length]
        double flux = 0;              ///< in this step [volume]
    };
    struct Cell {
        std::array<int, 3> index;
        std::ptrdiff_t place;
        double volume;     ///< of the whole cell
        double open, next; ///< share at t_n and at the end of the step
        std::array<Index, 6> face;
        Index parent = none; ///< cell that it has joined
        int to_parent = 0;   ///< side
        Index group = none;
    };
    /// What a group has of one fluid.
    struct Content {
        double mass = 0, energy = 0, volume = 0, share = 0;
    };
    /// What a cell has of one fluid.
    struct Filling {
        double mass, energy, fraction;
    };
    /// Fluid of a cell at rest, in its open part.
    struct Resting {
        std::array<int, 3> index;
        double open;
        std::vector<Filling> fluids;
    };
    /// A cell that has been covered, and where it passed its fluid.
    struct Covered {
        std::array<int, 3> index;
        int to_parent; ///< side
    };
    struct Kept {
        std::ptrdiff_t place;
        int fluid;
        double fraction, energy;
    };

    BoxFluid& fluid_;
    std::vector<Cell> cells_;
    std::vector<Face> faces_;
    std::vector<Group> groups_;
    std::vector<Content> contents_; ///< by group and fluid
    std::vector<Kept> kept_;
    std::vector<Covered> covered_;
    std::vector<Resting> resting_;        ///< only while a structure looks for its place
    std::vector<std::ptrdiff_t> slivers_; ///< likewise: those that had no fluid
    std::vector<Index> entry_;            ///< of cells, by storage place
    std::array<std::vector<Index>, 3> face_entry_;
    std::vector<Index> by_size_; ///< cells from the smallest open share up
    std::vector<std::ptrdiff_t> touched_next_;
    const BoxCuts* cuts_ = nullptr;   ///< at t_n
    std::vector<unsigned> held_axes_; ///< of nodes, by storage place

    int fluid_count() const { return static_cast<int>(fluid_.groups.size()); }
    Content& content(Index group, int fluid) { return contents_[std::size_t(group) * fluid_count() + fluid]; }
    void clear();
    void keep_resting(const BoxCuts& cuts);
    void fill(std::ptrdiff_t place, int fluid, const Filling& filling);
    double fill_slivers(const BoxCuts& cuts);
    double filled_share(std::ptrdiff_t place) const;
    std::array<std::ptrdiff_t, 8> nodes_of(const Cell& cell) const;
    Index add_cell(const std::array<int, 3>& index, double open);
    Index add_face(int axis, const std::array<int, 3>& index);
    bool is_pressed_alike(const Face& face) const;
    void spare_light_nodes_from(std::size_t first_face);
    std::array<int, 3> beyond(const Cell& cell, int side) const;
    double fluid_at(std::ptrdiff_t node) const;
    bool in_box(const std::array<int, 3>& index) const;
    void join(Index cell, const BoxCuts& cuts);
    void find_covered();
    void join_covered();
    Index root(Index cell) const;
    double out_rate(const Cell& cell, const std::array<AlignedDoubles, 3>& velocity) const;
    double filled_beyond(const Cell& cell, int side, double own) const;
    double openness_of(const Cell& cell, double own) const;
    void find_pressure(Index group, const Cell& largest, double out, double node_stiffness, double step);
    void pass_to_parents();
};

} // namespace plash
