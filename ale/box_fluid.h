#pragma once

#include "ale/box_boundary.h"
#include "ale/lagrange.h"
#include "ale/remap.h"

#include <functional>

namespace plash {

/// What a box of fluid has done so far [energy]. Kinetic and internal are at t_n.
struct FluidEnergies {
    double kinetic = 0;
    double internal = 0;
    double outside_work = 0;   ///< by gravity, outside pressure and driven nodes
    double coupling_work = 0;  ///< by outside forces
    double advection_loss = 0; ///< kinetic energy that the remap has taken
    double outflow = 0;        ///< internal energy that has left through open sides; only with open_sides
    std::vector<double> group_internal; ///< internal energy by group
};

/// An Eulerian fluid on one box: state, step and energies. All times t_n; see ale/lagrange.h and ale/remap.h
/// for the two halves of a step.
class BoxFluid {
public:
    BoxGrid grid;
    std::vector<FluidGroup> groups;
    LagrangeSettings lagrange;
    AdvectionOrder order = AdvectionOrder::van_leer;
    std::array<double, 3> gravity{}; ///< [acceleration]
    bool open_sides = false;         ///< fluid may cross the outer faces
    double outside_pressure = 0;     ///< on the outer faces [pressure]
    BoxFields fields;
    BoxContents contents;
    std::vector<HeldNode> held;
    std::vector<NodeForceFromOutside> outside_forces; ///< of the coming step; the owner fills and clears it

    BoxFluid(BoxGrid grid, std::vector<FluidGroup> groups, LagrangeSettings settings);

    /// The kinetic energy that the remap takes shall become heat where it was taken.
    void conserve_total_energy();
    /// To be called once the initial masses, energies, fractions and velocities are set.
    void start();
    /// From t_n to t_n + step. Outside forces act with `impulse_step` (the loop's velocity step).
    void advance(double step, double impulse_step);
    void advance(double step) { advance(step, step); }

    /// Largest stable step at t_n, before any safety factor [time], and the cell that limits it.
    double stable_step() const { return limit_.rate > 0 ? 1 / limit_.rate : 1e300; }
    std::ptrdiff_t limiting_cell() const { return limit_.place; }
    const FluidEnergies& energies() const { return energies_; }
    long steps_done() const { return steps_; }

    /// Sets a cell to hold `fraction` of a group at the given density and energy per mass.
    void fill_cell(int i, int j, int k, int group, double fraction, double density, double energy_per_mass);
    double total_mass(int group) const;
    std::array<double, 3> momentum() const;

private:
    RemapScratch scratch_;
    CrossingRate limit_;
    FluidEnergies energies_;
    long steps_ = 0;

    void remap();
    void evaluate(double last_step);
    void sum_energies();
    double sum_internal() const;
};

} // namespace plash
