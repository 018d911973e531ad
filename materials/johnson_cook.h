#pragma once

#include "materials/history.h"
#include "materials/parameters.h"
#include "materials/plane_stress_return.h"
#include "materials/plastic_return.h"
#include "materials/spall.h"
#include "materials/von_mises.h"
#include "math/lanes_math.h"

#include <array>

namespace plash {

/// *MAT_JOHNSON_COOK (015): flow stress (A + B p^N) (1 + C ln r) (1 - T*^M) with the plastic strain p, the
/// strain rate r over EPSO (never below 1) and the homologous temperature T* = (T - TR) / (TM - TR); the
/// temperature rises by the plastic work over RO CP, without conduction. Fracture when the sum of plastic
/// strain over fracture strain (D1 + D2 exp(D3 s)) (1 + D4 ln r) (1 + D5 T*) reaches 1, with s the mean
/// stress over the von Mises stress. Sources: Johnson & Cook (1983, 1985); Hallquist (2006), LS-DYNA theory
/// manual, material model 15. The rate is that of the total deviatoric strain (VP = 0) or of the plastic
/// strain (VP = 1). Without CP the temperature stays at TR.
struct JohnsonCook {
    double density = 0;       ///< [mass/volume]
    double shear_modulus = 0; ///< G [stress]
    double young_modulus = 0; ///< E, from G and PR where it is not given [stress]
    double poisson_ratio = 0;
    double initial_yield = 0;         ///< A [stress]
    double hardening = 0;             ///< B [stress]
    double hardening_exponent = 1;    ///< N
    double rate_coefficient = 0;      ///< C
    double reference_rate = 1;        ///< EPSO [1/time]
    bool viscoplastic = false;        ///< VP
    double thermal_exponent = 1;      ///< M
    double melting = 1;               ///< TM [temperature]
    double room = 0;                  ///< TR [temperature]
    double heat_capacity = 0;         ///< RO CP [stress/temperature]; 0: isothermal
    std::array<double, 5> fracture{}; ///< D1 to D5; all zero: no fracture
    double least_fracture_strain = 0; ///< EFMIN
    bool erodes = true;               ///< EROD = 0
    Spall spall;                      ///< PC and SPALL; shells leave them out

    enum History { plastic_strain, temperature, damage, spalled, history_size };
    std::array<double, history_size> initial_history() const { return {0, room, 0, 0}; }

    /// Damage and rise of the temperature, at LS-DYNA's numbers 4 and 5 of shells, 6 and 5 of solids.
    std::vector<ShownVariable> shown_history(bool of_shells) const
    {
        if (of_shells) return {{}, {}, {}, {damage}, {temperature, room}};
        return {{}, {}, {}, {}, {temperature, room}, {damage}};
    }

    double lowest_pressure() const { return spall.lowest_pressure(); }

    /// DeckError for the fields of a law that is not this one (RATEOP).
    static JohnsonCook from_record(const Record& record, const Model& model);

    bool fractures() const { return fracture != std::array<double, 5>{}; }

    /// Points without strength, which bear pressure only.
    template <class Lane>
    MaskOf<Lane> broken(HistoryView<Lane> history) const
    {
        return history[damage] >= 1.0;
    }

    /// Points that take their element with them.
    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history) const
    {
        return history[damage] >= (fractures() && erodes ? 1.0 : 1e300);
    }

    /// The deviator of one step at a batch of solid points whose pressure comes from elsewhere.
    /// shear      deviator of the stress, in and out [stress]
    /// increment  deviator of the strain increment [-]
    /// pressure   for the fracture strain [stress]
    template <class Lane>
    void update_deviator(SymmetricTensor<Lane>& shear, const SymmetricTensor<Lane>& increment,
                         const Lane& pressure, HistoryView<Lane> history, double time_step) const
    {
        shear = shear + broadcast<Lane>(2 * shear_modulus) * increment;
        const Lane square = 1.5 * contract(shear, shear);
        const Lane scale = step_factor(contract(increment, increment), history, time_step);
        const Lane strain = history[plastic_strain];
        const Lane bound = scale * static_yield(strain);
        const MaskOf<Lane> whole = history[damage] < 1.0;
        const MaskOf<Lane> yielding = (square > bound * bound) & whole;
        if (any(yielding)) {
            const double stiffness = 3 * shear_modulus;
            const Lane trial = sqrt(square);
            const auto at = [&](Lane plastic) {
                const Lane equivalent = trial - stiffness * plastic;
                const YieldPoint<Lane> now = yield_at(strain, plastic, scale, time_step);
                return ReturnPoint<Lane>{equivalent, -stiffness * equivalent, plastic, equivalent, now.stress,
                                         now.slope};
            };
            const Lane plastic = return_parameter<Lane>(yielding, 0.5 / stiffness * (trial - bound), at);
            const Lane left = yielding ? 1.0 - stiffness * plastic / trial : broadcast<Lane>(1);
            shear = left * shear;
            flow(yielding ? plastic : Lane{}, left * trial, pressure, history, time_step);
        }
        if (!fractures()) return;
        const MaskOf<Lane> kept = history[damage] < 1.0;
        for (Lane* component : {&shear.xx, &shear.yy, &shear.zz, &shear.xy, &shear.yz, &shear.zx})
            *component = kept ? *component : Lane{};
    }

    /// One step at a batch of solid points without an equation of state: Hooke's law for the pressure.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double time_step) const
    {
        const double bulk = young_modulus / (3 * (1 - 2 * poisson_ratio));
        Lane pressure = (-1.0 / 3) * trace(stress) - bulk * trace(increment);
        pressure = max(pressure, broadcast<Lane>(lowest_pressure()));
        SymmetricTensor<Lane> shear = deviator(stress);
        update_deviator(shear, deviator(increment), pressure, history, time_step);
        if (fractures()) pressure = broken(history) ? max(pressure, Lane{}) : pressure;
        spall.apply(shear, pressure, history[spalled]);
        stress = {
            shear.xx - pressure, shear.yy - pressure, shear.zz - pressure, shear.xy, shear.yz, shear.zx};
    }

    /// One step at a batch of shell points; see materials/history.h. Broken points carry nothing.
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane> history, double time_step) const
    {
        PlaneStressTrial<Lane> trial(stress, increment, young_modulus, poisson_ratio);
        const SymmetricTensor<Lane> change = trial.isochoric_increment();
        const Lane scale = step_factor(contract(change, change), history, time_step);
        const Lane strain = history[plastic_strain];
        const Lane bound = scale * static_yield(strain);
        const MaskOf<Lane> yielding = (trial.square() > bound * bound) & (history[damage] < 1.0);
        if (any(yielding)) {
            const auto end = trial.flow(yielding, bound, [&](const Lane& plastic) {
                return yield_at(strain, plastic, scale, time_step);
            });
            flow(end.plastic, end.equivalent, (-1.0 / 3) * (stress.xx + stress.yy), history, time_step);
        }
        if (!fractures()) return;
        const MaskOf<Lane> kept = history[damage] < 1.0;
        for (Lane* component : {&stress.xx, &stress.yy, &stress.xy, &stress.yz, &stress.zx})
            *component = kept ? *component : Lane{};
    }

private:
    template <class Lane>
    struct YieldPoint {
        Lane stress, slope; ///< slope by the plastic increment
    };

    template <class Lane>
    Lane static_yield(const Lane& strain) const
    {
        return initial_yield + hardening * power(strain, hardening_exponent);
    }

    /// ln of the rate over EPSO, from 0 upwards.
    template <class Lane>
    Lane log_rate(const Lane& rate) const
    {
        return log(max((1 / reference_rate) * rate, broadcast<Lane>(1)));
    }

    template <class Lane>
    Lane homologous(const Lane& kelvin) const
    {
        return min(max((1 / (melting - room)) * (kelvin - room), Lane{}), broadcast<Lane>(1));
    }

    /// What does not depend on the plastic increment: heat, and with VP = 0 the rate.
    template <class Lane>
    Lane step_factor(const Lane& increment_square, HistoryView<Lane> history, double time_step) const
    {
        Lane factor = broadcast<Lane>(1);
        if (rate_coefficient != 0 && !viscoplastic && time_step > 0)
            factor += rate_coefficient * log_rate((1 / time_step) * sqrt((2.0 / 3) * increment_square));
        if (heat_capacity == 0) return factor;
        return factor * (1.0 - power(homologous(history[temperature]), thermal_exponent));
    }

    template <class Lane>
    YieldPoint<Lane> yield_at(const Lane& strain, const Lane& plastic, const Lane& scale,
                              double time_step) const
    {
        const Lane total = max(strain + plastic, broadcast<Lane>(1e-300));
        const Lane hard = hardening * power(total, hardening_exponent);
        YieldPoint<Lane> point{scale * (initial_yield + hard), scale * hardening_exponent * hard / total};
        if (!viscoplastic || rate_coefficient == 0 || time_step == 0) return point;
        const Lane rate = (1 / time_step) * plastic;
        const Lane factor = 1.0 + rate_coefficient * log_rate(rate);
        const Lane growth =
            rate > reference_rate ? rate_coefficient / max(plastic, broadcast<Lane>(1e-300)) : Lane{};
        return {factor * point.stress, factor * point.slope + growth * point.stress};
    }

    /// Books a plastic increment: strain, heat and damage.
    template <class Lane>
    void flow(const Lane& plastic, const Lane& equivalent, const Lane& pressure, HistoryView<Lane> history,
              double time_step) const
    {
        history[plastic_strain] += plastic;
        if (fractures()) {
            const Lane triaxiality = -pressure / max(equivalent, broadcast<Lane>(1e-300));
            const Lane exponent =
                min(max(fracture[2] * triaxiality, broadcast<Lane>(-200)), broadcast<Lane>(200));
            Lane limit = fracture[0] + fracture[1] * exp(exponent);
            if (fracture[3] != 0 && time_step > 0)
                limit *= 1.0 + fracture[3] * log_rate((1 / time_step) * plastic);
            limit *= 1.0 + fracture[4] * homologous(history[temperature]);
            history[damage] += plastic / max(limit, broadcast<Lane>(least_fracture_strain));
        }
        if (heat_capacity != 0) history[temperature] += (1 / heat_capacity) * (plastic * equivalent);
    }
};

} // namespace plash
