#pragma once

#include "materials/hardening.h"
#include "materials/history.h"
#include "materials/parameters.h"
#include "materials/plane_stress_return.h"
#include "materials/plastic_return.h"
#include "materials/von_mises.h"
#include "model/model.h"

#include <array>

namespace plash {

/// *MAT_PLASTICITY_COMPRESSION_TENSION (124): von Mises plasticity with one flow curve in compression (LCIDC)
/// and one in tension (LCIDT): the first from the pressure PC upwards, the second from the pressure -PT
/// downwards, between them their mean weighted linearly by the pressure (one or the other by the sign of the
/// pressure when PC = PT = 0). Cowper & Symonds (1957) scale the flow stress by the rate of the total strain.
/// Source: LS-DYNA keyword manual, volume II, *MAT_124. The pressure is the elastic one of the step.
struct CompressionTension {
    double density = 0;       ///< [mass/volume]
    double young_modulus = 0; ///< [stress]
    double poisson_ratio = 0;
    Hardening pressed, pulled; ///< flow stress over plastic strain
    double pressed_from = 0;   ///< PC [stress]
    double pulled_from = 0;    ///< PT [stress]
    double reference_rate = 0; ///< C [1/time]; 0: no rate effect
    double rate_exponent = 0;  ///< 1 / P
    double failure_strain = 0; ///< FAIL; 0: never
    double shortest_step = 0;  ///< TDEL [time]

    enum History { plastic_strain, history_size };
    std::array<double, history_size> initial_history() const { return {}; }

    static CompressionTension from_record(const Record& record, const Model& model);

    double shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }

    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history) const
    {
        return history[plastic_strain] >= (failure_strain > 0 ? failure_strain : 1e300);
    }

    /// One step at a batch of solid points; see materials/history.h.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double time_step) const
    {
        const double g = shear_modulus(), stiffness = 3 * g;
        add_elastic_stress(stress, increment, g, 2 * g * poisson_ratio / (1 - 2 * poisson_ratio));
        const SymmetricTensor<Lane> shear = deviator(stress);
        const Lane square = 1.5 * contract(shear, shear), strain = history[plastic_strain];
        const Flow<Lane> flow{*this, (-1.0 / 3) * trace(stress), rate_factor(increment, time_step)};
        const Lane bound = flow(strain).stress;
        const MaskOf<Lane> yielding = (square > bound * bound) & MaskOf<Lane>(!failed(history));
        if (any(yielding)) {
            const Lane trial = sqrt(square);
            const auto at = [&](const Lane& plastic) {
                const Lane equivalent = trial - stiffness * plastic;
                const auto now = flow(strain + plastic);
                return ReturnPoint<Lane>{equivalent, -stiffness * equivalent, plastic, equivalent, now.stress,
                                         now.slope};
            };
            const Lane start = (1 / stiffness) * (trial - bound);
            const Lane plastic = return_parameter<Lane>(yielding, start, at);
            const Lane factor = yielding ? stiffness * plastic / trial : Lane{};
            stress = stress - factor * shear;
            history[plastic_strain] += yielding ? plastic : Lane{};
        }
        clear_failed(stress, history);
    }

    /// One step at a batch of shell points; see materials/history.h.
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane> history, double time_step) const
    {
        PlaneStressTrial<Lane> trial(stress, increment, young_modulus, poisson_ratio);
        const Lane strain = history[plastic_strain];
        const Flow<Lane> flow{*this, (-1.0 / 3) * (stress.xx + stress.yy),
                              rate_factor(trial.isochoric_increment(), time_step)};
        const Lane bound = flow(strain).stress;
        const MaskOf<Lane> yielding = (trial.square() > bound * bound) & MaskOf<Lane>(!failed(history));
        if (any(yielding)) {
            history[plastic_strain] +=
                trial.flow(yielding, bound, [&](const Lane& plastic) { return flow(strain + plastic); })
                    .plastic;
        }
        clear_failed(stress, history);
    }

private:
    /// Flow stress and its slope over plastic strain in one step.
    template <class Lane>
    struct Flow {
        const CompressionTension& law;
        Lane share;  ///< of compression
        Lane factor; ///< of the strain rate

        Flow(const CompressionTension& its_law, const Lane& pressure, const Lane& its_factor)
            : law(its_law), factor(its_factor)
        {
            const double width = law.pressed_from + law.pulled_from;
            share = width > 0 ? min(max(Lane{(1 / width) * (pressure + law.pulled_from)}, Lane{}),
                                    broadcast<Lane>(1))
                              : (pressure > 0.0 ? broadcast<Lane>(1) : Lane{});
        }

        Hardening::Value<Lane> operator()(const Lane& strain) const
        {
            const auto c = law.pressed(strain, Lane{}), t = law.pulled(strain, Lane{});
            return {factor * (t.stress + share * (c.stress - t.stress)),
                    factor * (t.slope + share * (c.slope - t.slope)), Lane{}};
        }
    };

    template <class Lane>
    Lane rate_factor(const SymmetricTensor<Lane>& increment, double time_step) const
    {
        if (reference_rate == 0 || time_step == 0) return broadcast<Lane>(1);
        const Lane rate = (1 / time_step) * sqrt((2.0 / 3) * contract(increment, increment));
        return 1.0 + power<Lane>((1 / reference_rate) * rate, rate_exponent);
    }

    template <class Lane>
    void clear_failed(SymmetricTensor<Lane>& stress, HistoryView<Lane> history) const
    {
        if (failure_strain == 0) return;
        const MaskOf<Lane> gone = failed(history);
        for (Lane* component : {&stress.xx, &stress.yy, &stress.zz, &stress.xy, &stress.yz, &stress.zx})
            *component = gone ? Lane{} : *component;
    }
};

} // namespace plash
