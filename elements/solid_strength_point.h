#pragma once

#include "elements/solid_step.h"
#include "eos/memory.h"

namespace plash {

/// Material point of a solid whose pressure comes from an equation of state and whose deviator from a law
/// with `update_deviator` (materials/johnson_cook.h): elastic-plastic solids under shock.
template <class Strength, class Eos>
struct StrengthPoint {
    Strength law;
    Eos eos;

    static constexpr int history_size = Strength::history_size + eos_history_size<Eos>;
    static constexpr int memory = Strength::history_size; ///< of the equation of state
    static constexpr int constant_size = 0;
    static constexpr bool modulus_changes = true;
    static constexpr bool can_fail = true;
    static constexpr int plastic_strain = Strength::plastic_strain;

    template <class Lane>
    void start(const SolidModes<Lane>&, Lane* history, Lane* constants) const
    {
        const double compression = 1 / eos.relative_volume;
        const double pressure = respond(eos, compression, &compression).pressure(eos.energy);
        if constexpr (eos_history_size < Eos >> 0)
            history[point_history + memory] = broadcast<Lane>(compression);
        for (int i = 0; i < 3; ++i) history[stress_history + i] = broadcast<Lane>(-pressure);
        history[internal_energy_history] = eos.energy / constants[inverse_volume_constant];
        const auto values = law.initial_history();
        for (std::size_t i = 0; i < values.size(); ++i)
            history[point_history + i] = broadcast<Lane>(values[i]);
    }

    template <class Lane>
    Lane wave_modulus(const SolidMotion<Lane>& motion, HistoryView<Lane> history) const
    {
        const Lane compression = 1.0 / motion.relative_volume;
        const PressureResponse<Lane> response = respond(eos, compression, history.values + memory);
        const Lane pressure =
            max(response.pressure(motion.energy_density), broadcast<Lane>(law.lowest_pressure()));
        const Lane stiffness = response.stiffness(compression, pressure, motion.energy_density);
        return max(stiffness, Lane{}) * compression + 4.0 / 3 * law.shear_modulus;
    }

    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, HistoryView<Lane> history,
                const SolidMotion<Lane>& motion) const
    {
        const Lane pressure_before = (-1.0 / 3) * trace(stress);
        const SymmetricTensor<Lane> shear_before = deviator(stress);
        SymmetricTensor<Lane> shear = shear_before;
        law.update_deviator(shear, deviator(motion.increment), pressure_before, history, motion.time_step);
        const Lane middle_volume = motion.relative_volume - 0.5 * motion.volume_change;
        const Lane other_work =
            0.5 * middle_volume * contract(shear_before + shear, motion.increment) + motion.viscous_work;
        const PressureStep<Lane> end = advance_pressure(
            respond_and_remember(eos, Lane{1.0 / motion.relative_volume}, history.values + memory),
            motion.energy_density, other_work, pressure_before, motion.change_at_start, motion.change_at_end,
            law.lowest_pressure());
        // What has broken bears no tension.
        Lane pressure = law.broken(history) ? max(end.pressure, Lane{}) : end.pressure;
        law.spall.apply(shear, pressure, history[Strength::spalled]);
        stress = {
            shear.xx - pressure, shear.yy - pressure, shear.zz - pressure, shear.xy, shear.yz, shear.zx};
    }

    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history, const SolidMotion<Lane>&) const
    {
        return law.failed(history);
    }
};

} // namespace plash
