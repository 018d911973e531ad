#pragma once

#include "ale/fluid_fields.h"
#include "ale/lagrange.h"
#include "ale/mixture.h"

/// Pressure of a batch of cells at t_n, whatever the mesh they belong to.
namespace plash {

/// Pressure and stiffness of the cell as a whole.
template <class Lane>
struct CellState {
    Lane pressure, stiffness, signal_square, density;
};

/// Cells that are full of one group.
template <class Lane>
inline CellState<Lane> pure_state(const FluidFields& fields, std::span<const FluidGroup> groups,
                                  std::ptrdiff_t place, int group, Lane volume)
{
    const GroupFields& own = fields.groups[group];
    const Lane mass = load<Lane>(&own.mass[place]);
    const auto has = mass > 0.0;
    const Lane inverse = 1.0 / (has ? mass : broadcast<Lane>(1));
    const FluidGroup& fluid = groups[group];
    const Lane density = has ? mass / volume : broadcast<Lane>(fluid.reference_density);
    const Lane energy = load<Lane>(&own.energy[place]) * inverse;
    const auto state = fluid_state(fluid, density, energy);
    return {has ? state.pressure : Lane{}, has ? state.stiffness : Lane{}, state.stiffness / density,
            has ? density : Lane{}};
}

/// Cells of several groups, or partly empty ones; see close_mixture for `open` and `closing`.
template <class Lane>
inline CellState<Lane> mixed_state(FluidFields& fields, std::span<const FluidGroup> groups, bool void_allowed,
                                   std::ptrdiff_t place, Lane volume, Lane open, Lane closing)
{
    const std::size_t count = fields.groups.size();
    Mixture<Lane> mix;
    Lane mass{};
    for (std::size_t g = 0; g < count; ++g) {
        mix.fraction[g] = load<Lane>(&fields.groups[g].fraction[place]);
        mix.mass[g] = load<Lane>(&fields.groups[g].mass[place]);
        mix.energy[g] = load<Lane>(&fields.groups[g].energy[place]);
        mass += mix.mass[g];
    }
    close_mixture(mix, groups, volume, void_allowed, open, closing);
    for (std::size_t g = 0; g < count; ++g) {
        store(&fields.groups[g].fraction[place], mix.fraction[g]);
        store(&fields.groups[g].energy[place], mix.energy[g]);
        store(&fields.groups[g].share[place], mix.share[g]);
    }
    return {mix.pressure, mix.stiffness, mix.signal_square, mass / volume};
}

/// How fast a cell is strained along its three axes.
template <class Lane>
struct CellStrain {
    Lane rate[3];    ///< [1/time]
    Lane width[3];   ///< [length]
    Lane divergence; ///< [1/time]
};

template <class Lane>
struct CellPressure {
    Lane pressure; ///< with bulk viscosity [pressure]
    Lane rate;     ///< [pressure/time]
    Lane signal;   ///< speed of a signal [velocity]
};

/// Bulk viscosity by the velocity jump across the cell in the direction in which it is compressed, and the
/// signal speed of LS-DYNA's step for solids (Hallquist 2006, section 'Time step calculations').
template <class Lane>
inline CellPressure<Lane> cell_pressure(const CellState<Lane>& state, const CellStrain<Lane>& strain,
                                        const LagrangeSettings& settings)
{
    const Lane zero{};
    const Lane squeeze_x = max(-strain.rate[0], zero), squeeze_y = max(-strain.rate[1], zero),
               squeeze_z = max(-strain.rate[2], zero);
    const Lane squeeze = squeeze_x + squeeze_y + squeeze_z;
    const Lane length =
        (squeeze_x * strain.width[0] + squeeze_y * strain.width[1] + squeeze_z * strain.width[2]) /
        max(squeeze, broadcast<Lane>(1e-300));
    const Lane jump = max(-strain.divergence, zero) * length;
    const Lane sound = sqrt(state.signal_square);
    const Lane viscous_speed = settings.quadratic_viscosity * jump + settings.linear_viscosity * sound;
    const auto resists = (state.stiffness > 0.0) & (jump > 0.0);
    const Lane bulk_viscosity = resists ? state.density * jump * viscous_speed : zero;
    const Lane q = resists ? viscous_speed : zero;
    return {state.pressure + bulk_viscosity, -state.stiffness * strain.divergence,
            q + sqrt(q * q + state.signal_square)};
}

/// Energy and fractions of a batch of cells whose volume grows by `growth` and which do `work` on the motion.
/// only_group  of cells that are full of it; negative: several groups, or void
template <class Lane>
inline void deform_cells(FluidFields& fields, std::ptrdiff_t place, int only_group, Lane volume, Lane growth,
                         Lane work)
{
    if (only_group >= 0) {
        double* energy = &fields.groups[only_group].energy[place];
        store(energy, load<Lane>(energy) - work);
        return;
    }
    // Groups take the work in proportion to their shares of the change of volume; where none takes part
    // (enclosed void gives way alone) there is only viscous heat, and it goes by mass.
    Lane shares{}, mass{}, filled_before{};
    for (const GroupFields& group : fields.groups) {
        shares += load<Lane>(&group.share[place]);
        mass += load<Lane>(&group.mass[place]);
        filled_before += load<Lane>(&group.fraction[place]);
    }
    const auto shared = shares > 0.0;
    const Lane weights = shared ? shares : mass;
    const Lane per_weight = weights > 0.0 ? work / weights : Lane{};
    const Lane relative = growth / volume;
    const Lane shrink = 1.0 / (1.0 + relative);
    Lane filled{};
    for (GroupFields& group : fields.groups) {
        const Lane share = load<Lane>(&group.share[place]);
        const Lane weight = shared ? share : load<Lane>(&group.mass[place]);
        store(&group.energy[place], load<Lane>(&group.energy[place]) - weight * per_weight);
        const Lane fraction = (load<Lane>(&group.fraction[place]) + share * relative) * shrink;
        store(&group.fraction[place], max(fraction, Lane{}));
        filled += fraction;
    }
    // Void that closes within the step leaves its cell full, and the rest of the squeeze to the fluid. What
    // dry faces have kept back keeps the volume that it has beyond that of the cell; sums of several groups
    // have round-off.
    const auto brimful = filled_before > (fields.groups.size() > 1 ? 1 + 1e-9 : 1.0);
    const Lane excess = (filled > 1.0) & !brimful ? 1.0 / filled : broadcast<Lane>(1);
    for (GroupFields& group : fields.groups) {
        const Lane fraction = load<Lane>(&group.fraction[place]) * excess;
        // A full cell stays full to the last bit, whatever stands beside it in its batch.
        const auto full = (fraction > 1 - 1e-13) & (fraction < 1 + 1e-13);
        store(&group.fraction[place], full ? broadcast<Lane>(1) : fraction);
    }
}

/// Largest kinematic viscosity of all groups [length^2/time].
inline double largest_kinematic_viscosity(std::span<const FluidGroup> groups)
{
    double largest = 0;
    for (const FluidGroup& group : groups) largest = max(largest, group.viscosity / group.reference_density);
    return largest;
}

/// Stores the viscous stress 2 mu (rate of strain - a third of its trace) of a Newtonian fluid, from the
/// velocity gradient in the middle of the cell.
template <class Lane>
inline void store_viscous_stress(FluidFields& fields, std::span<const FluidGroup> groups,
                                 std::ptrdiff_t place, const Lane (&gradient)[3][3])
{
    Lane viscosity{};
    for (std::size_t g = 0; g < fields.groups.size(); ++g) {
        const GroupFields& own = fields.groups[g];
        const Lane fraction = own.fraction.empty() ? broadcast<Lane>(1) : load<Lane>(&own.fraction[place]);
        // Ghosts at the end of a row have no mass.
        viscosity += load<Lane>(&own.mass[place]) > 0.0 ? groups[g].viscosity * fraction : Lane{};
    }
    const Lane third = (gradient[0][0] + gradient[1][1] + gradient[2][2]) * (1.0 / 3);
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3;
        store(&fields.viscous[axis][place], 2.0 * viscosity * (gradient[axis][axis] - third));
        store(&fields.viscous[3 + axis][place], viscosity * (gradient[axis][next] + gradient[next][axis]));
    }
}

} // namespace plash
