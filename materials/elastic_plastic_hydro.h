#pragma once

#include "materials/hardening.h"
#include "materials/history.h"
#include "materials/plastic_return.h"
#include "materials/spall.h"
#include "model/model.h"

#include <array>

namespace plash {

/// *MAT_ELASTIC_PLASTIC_HYDRO (010) and its option _SPALL: von Mises plasticity of a solid whose pressure
/// comes from an equation of state. Flow stress SIGY + EH p, or points ES over EPS, plus
/// (A1 + A2 pressure) pressure in compression (_SPALL). Source: Hallquist (2006), LS-DYNA theory manual,
/// material model 10.
struct ElasticPlasticHydro {
    double density = 0;        ///< [mass/volume]
    double shear_modulus = 0;  ///< G [stress]
    double poisson_ratio = 0;  ///< nominal, for hourglass control
    Hardening hardening;       ///< static flow stress over plastic strain
    double a1 = 0;             ///< A1
    double a2 = 0;             ///< A2 [1/stress]
    double failure_strain = 0; ///< FS: plastic strain that deletes the element; 0: never
    Spall spall;

    enum History { plastic_strain, spalled, history_size };
    std::array<double, history_size> initial_history() const { return {}; }

    static ElasticPlasticHydro from_record(const Record& record, const Model& model);

    double lowest_pressure() const { return spall.lowest_pressure(); }

    /// Points without strength, which bear pressure only.
    template <class Lane>
    MaskOf<Lane> broken(HistoryView<Lane> history) const
    {
        return history[spalled] > 0.0;
    }

    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history) const
    {
        return history[plastic_strain] >= (failure_strain > 0 ? failure_strain : 1e300);
    }

    /// The deviator of one step at a batch of solid points.
    /// shear      deviator of the stress, in and out [stress]
    /// increment  deviator of the strain increment [-]
    /// pressure   at the start of the step [stress]
    template <class Lane>
    void update_deviator(SymmetricTensor<Lane>& shear, const SymmetricTensor<Lane>& increment,
                         const Lane& pressure, HistoryView<Lane> history, double /*time_step*/) const
    {
        shear = shear + broadcast<Lane>(2 * shear_modulus) * increment;
        const Lane square = 1.5 * contract(shear, shear);
        const Lane strain = history[plastic_strain];
        const Lane squeezed = max(pressure, Lane{});
        const Lane by_pressure = squeezed * (a1 + a2 * squeezed);
        const auto yield = [&](const Lane& plastic) {
            const auto value = hardening(strain + plastic, Lane{});
            const Lane sum = value.stress + by_pressure;
            return std::pair<Lane, Lane>{max(sum, Lane{}), sum > 0.0 ? value.slope : Lane{}};
        };
        const Lane bound = yield(Lane{}).first;
        const MaskOf<Lane> yielding = square > bound * bound;
        if (!any(yielding)) return;
        const double stiffness = 3 * shear_modulus;
        const Lane trial = sqrt(square);
        const auto at = [&](const Lane& plastic) {
            const Lane equivalent = trial - stiffness * plastic;
            const auto [stress, slope] = yield(plastic);
            return ReturnPoint<Lane>{equivalent, -stiffness * equivalent, plastic, equivalent, stress, slope};
        };
        const Lane start = (trial - bound) * (1 / stiffness);
        const Lane plastic = return_parameter<Lane>(yielding, start, at);
        const Lane factor = yielding ? 1.0 - stiffness * plastic / trial : broadcast<Lane>(1);
        shear = factor * shear;
        history[plastic_strain] += yielding ? plastic : Lane{};
    }
};

} // namespace plash
