#pragma once

#include "ale/box_fields.h"
#include "ale/fluid_law.h"

#include <span>

/// The Lagrangian half of a step on a box: the mesh would move with the fluid, and the work of the pressure
/// at half step takes exactly as much from the internal energy as it gives to the motion. That is the
/// compatible form of Caramana, Burton, Shashkov & Whalen (1998), J. Comput. Phys. 146, 227-262: velocities,
/// densities and energies all stand at t_n, the pressure is carried to the middle of the step by its rate at
/// t_n, and volumes change with the mean of the old and the new velocity.
namespace plash {

struct LagrangeSettings {
    double quadratic_viscosity = 1.5;      ///< Q1 of *CONTROL_BULK_VISCOSITY
    double linear_viscosity = 0.06;        ///< Q2
    std::array<double, 3> mesh_velocity{}; ///< of the box itself in this and the coming step [velocity]
    bool void_allowed = false;             ///< cells may be partly or wholly empty
    bool viscous = false;                  ///< some group has a viscosity
};

/// What limits the step: the largest rate at which a signal or the flow crosses a cell.
struct CrossingRate {
    double rate = 0;          ///< [1/time]
    std::ptrdiff_t place = 0; ///< storage place of the cell
};

/// Pressures at t_n and their rates, from mass, energy and fraction of the groups and from the present
/// velocities. Brings the groups of mixed cells to one pressure, and opens void where a liquid would be torn.
CrossingRate evaluate_state(const BoxGrid&, FluidFields&, BoxContents&, std::span<const FluidGroup>,
                            const LagrangeSettings&, double last_step);

/// New nodal velocities after `step` under pressure, viscous stress and `gravity`; also nodal masses and mean
/// velocities. Forces from outside and fixed nodes follow in a second stroke (ale/box_boundary.h).
/// Returns the work of gravity.
double accelerate(const BoxGrid&, FluidFields&, const BoxContents&, double step,
                  const std::array<double, 3>& gravity);

/// Volumes that pass the faces with the mean velocity, and what that does to internal energies and fractions.
/// mesh  velocity of the box itself: what passes a face is seen from there
void deform(const BoxGrid&, FluidFields&, const BoxContents&, double step,
            const std::array<double, 3>& mesh = {});

/// Kinetic energy of the nodes with the masses of `node_mass`.
double kinetic_energy(const BoxGrid&, const FluidFields&, const BoxContents&);
/// Nodal masses from the masses of the cells.
void find_node_masses(const BoxGrid&, FluidFields&, const BoxContents&);
/// Internal energy of a group.
double internal_energy(const BoxGrid&, const FluidFields&, const BoxContents&, int group);

} // namespace plash
