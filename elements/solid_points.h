#pragma once

#include "elements/solid_axes.h"
#include "elements/solid_step.h"

namespace plash {

/// Material point of a solid whose law is in rate form (materials/history.h).
template <class Law>
struct RatePoint {
    Law law;

    static constexpr int history_size = Law::history_size;
    static constexpr int constant_size = 0;
    static constexpr bool modulus_changes = false;
    /// Whether the stress may be given at the start (*INITIAL_STRESS_SOLID).
    static constexpr bool stress_is_free = !requires { Law::pressure_from_volume; };
    static constexpr bool can_fail = requires(const Law& l, HistoryView<double> h) { l.failed(h); };
    static constexpr int plastic_strain = [] {
        if constexpr (requires { Law::plastic_strain; }) return int{Law::plastic_strain};
        return -1;
    }();

    /// Initial history of a batch.
    /// position  at the start
    /// history   of the whole element (SolidHistory), all zero on entry
    template <class Lane>
    void start([[maybe_unused]] const SolidModes<Lane>& position, Lane* history, Lane* /*constants*/) const
    {
        const auto values = law.initial_history();
        for (std::size_t i = 0; i < values.size(); ++i)
            history[point_history + i] = broadcast<Lane>(values[i]);
        if constexpr (requires { law.axes; }) start_solid_axes(law.axes, position, history + point_history);
    }

    /// Density times the square of the speed of compression waves [stress].
    template <class Lane>
    Lane wave_modulus(const SolidMotion<Lane>&, HistoryView<Lane>) const
    {
        const double twice_shear = law.young_modulus / (1 + law.poisson_ratio);
        return broadcast<Lane>(twice_shear * (1 - law.poisson_ratio) / (1 - 2 * law.poisson_ratio));
    }

    /// stress  turned with the material, in and out
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, HistoryView<Lane> history,
                const SolidMotion<Lane>& motion) const
    {
        if constexpr (requires { law.rotate_history(history, motion.rotation); }) {
            law.rotate_history(history, motion.rotation);
        }
        law.update(stress, motion.increment, history, motion.time_step);
    }

    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history, const SolidMotion<Lane>&) const
    {
        return law.failed(history);
    }
};

} // namespace plash
