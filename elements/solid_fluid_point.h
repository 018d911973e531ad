#pragma once

#include "elements/solid_step.h"
#include "eos/memory.h"
#include "materials/null_fluid.h"

#include <limits>

namespace plash {

/// Material point of a fluid: pressure from an equation of state, viscous shear stress 2 MU times the
/// deviator of the strain rate.
template <class Eos>
struct FluidPoint {
    NullFluid fluid;
    Eos eos;

    static constexpr int history_size = eos_history_size<Eos>;
    static constexpr int constant_size = 0;
    static constexpr bool modulus_changes = true;
    static constexpr bool can_fail = true;
    static constexpr int plastic_strain = -1;

    template <class Lane>
    void start(const SolidModes<Lane>&, Lane* history, Lane* constants) const
    {
        const double compression = 1 / eos.relative_volume;
        const double pressure = respond(eos, compression, &compression).pressure(eos.energy);
        if constexpr (eos_history_size < Eos >> 0) history[point_history] = broadcast<Lane>(compression);
        for (int i = 0; i < 3; ++i) history[stress_history + i] = broadcast<Lane>(-pressure);
        history[internal_energy_history] = eos.energy / constants[inverse_volume_constant];
    }

    template <class Lane>
    Lane wave_modulus(const SolidMotion<Lane>& motion, HistoryView<Lane> history) const
    {
        const Lane compression = 1.0 / motion.relative_volume;
        const PressureResponse<Lane> response = respond(eos, compression, history.values);
        const Lane pressure =
            max(response.pressure(motion.energy_density), broadcast<Lane>(fluid.lowest_pressure));
        const Lane stiffness = response.stiffness(compression, pressure, motion.energy_density);
        // A gas without energy carries no waves; a negative modulus has no speed either.
        return max(stiffness, Lane{}) * compression;
    }

    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, HistoryView<Lane> history,
                const SolidMotion<Lane>& motion) const
    {
        const Lane pressure_before = (-1.0 / 3) * trace(stress);
        const SymmetricTensor<Lane> shear_before = deviator(stress);
        const double per_step = motion.time_step > 0 ? 2 * fluid.viscosity / motion.time_step : 0;
        const SymmetricTensor<Lane> shear = broadcast<Lane>(per_step) * deviator(motion.increment);
        const Lane middle_volume = motion.relative_volume - 0.5 * motion.volume_change;
        const Lane other_work =
            0.5 * middle_volume * contract(shear_before + shear, motion.increment) + motion.viscous_work;
        const PressureStep<Lane> end =
            advance_pressure(respond_and_remember(eos, Lane{1.0 / motion.relative_volume}, history.values),
                             motion.energy_density, other_work, pressure_before, motion.change_at_start,
                             motion.change_at_end, fluid.lowest_pressure);
        stress = {shear.xx - end.pressure,
                  shear.yy - end.pressure,
                  shear.zz - end.pressure,
                  shear.xy,
                  shear.yz,
                  shear.zx};
    }

    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane>, const SolidMotion<Lane>& motion) const
    {
        const double largest =
            fluid.largest_volume > 0 ? fluid.largest_volume : std::numeric_limits<double>::infinity();
        return max(motion.relative_volume - largest, fluid.smallest_volume - motion.relative_volume) >= 0.0;
    }
};

} // namespace plash
