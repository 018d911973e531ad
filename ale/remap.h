#pragma once

#include "ale/box_fields.h"

#include <vector>

/// The second half of a step on a box: what has left its cell goes to the next one, axis by axis. Each sweep
/// is one-dimensional, so that with outflow taken from what a cell has, nothing overshoots: fractions stay
/// between 0 and 1, densities, energies per mass and velocities between their neighbours' values. Source: van
/// Leer (1977) for the profiles; Benson (1992), Comput. Methods Appl. Mech. Engrg. 99, 235-394; DeBar (1974),
/// UCIR-760, for sweeps over volumes that shrink and grow from axis to axis.
namespace plash {

/// Below this a node has no mass. A motion spreads by a node in a cycle and falls by orders of magnitude each
/// time: what it carries into empty cells would otherwise end in numbers whose inverses overflow.
inline constexpr double smallest_node_mass = 1e-200;

enum class AdvectionOrder { donor_cell, van_leer };

/// Scratch rows of every thread, kept over the run.
class RemapScratch {
public:
    RemapScratch(const BoxGrid& grid, int group_count);
    /// Rows of the calling thread.
    double* row(int number) { return rows_[thread()].data() + lane_count + number * row_length_; }
    int row_length() const { return row_length_; }

private:
    static int thread();
    int row_length_;
    std::vector<AlignedDoubles> rows_;
};

/// Moves mass, internal energy and fractions of all groups along one axis, and notes the mass that passes
/// each face for the momentum.
void sweep_cells(const BoxGrid&, FluidFields&, const BoxContents&, RemapScratch&, int axis, AdvectionOrder);

/// Moves the momentum along one axis with the masses that sweep_cells has noted: Benson's half-index shift
/// (1992), J. Comput. Phys. 100, 143-162, in the form it takes on a box, where the fluxes of all shifted
/// cells with one pair of velocities add up to one flux between two nodes. Nodal masses and momenta stay
/// consistent, and momentum is conserved to round-off. smooth_square  see carried_velocities [velocity^2];
/// holds where all cells are full of one fluid
void sweep_momentum(const BoxGrid&, FluidFields&, const BoxContents&, RemapScratch&, int axis, AdvectionOrder,
                    double smooth_square);

/// Gives the kinetic energy that nodes have lost in the sweeps to the internal energies of the cells around
/// them, by mass: the remap then conserves total energy (DeBar 1974; METH = 3 of *CONTROL_ALE). Only with
/// fields.lost_motion. Returns the sum.
double return_lost_motion(const BoxGrid&, FluidFields&, const BoxContents&);

/// Shares of the groups in what leaves cells that hold an interface, by Youngs' planes (ale/interface.cpp).
void find_outflow_shares(const BoxGrid&, FluidFields&, const BoxContents&, int axis);

} // namespace plash
