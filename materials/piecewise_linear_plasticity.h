#pragma once

#include "materials/hardening.h"
#include "materials/history.h"
#include "materials/plastic_return.h"
#include "materials/von_mises.h"
#include "math/symmetric_tensor.h"
#include "model/model.h"

#include <array>

namespace plash {

/// *MAT_PIECEWISE_LINEAR_PLASTICITY (024): von Mises plasticity with isotropic hardening along a line,
/// points, a curve or a table of curves over the strain rate; Cowper & Symonds (1957) or a curve for the
/// strain rate. Source: Hallquist (2006), material model 24; solids by radial return (Krieg & Krieg 1977),
/// shells by the plane-stress return of Simo & Taylor (1986, Int. J. Numer. Meth. Engng 22, 649-670), solved
/// to round-off by Newton's method whatever MITER says (LS-DYNA's MITER = 1 stops after three secant
/// iterations).
struct PiecewiseLinearPlasticity {
    /// How strain rate raises the yield stress.
    enum class Rate {
        none,
        scaled,      ///< VP = 0, -1: the static yield stress times a factor of the strain rate
        viscoplastic ///< VP = 1: a part that depends on the plastic strain rate
    };

    double density;       ///< [mass/volume]
    double young_modulus; ///< [stress]
    double poisson_ratio; ///< [-]
    Hardening hardening;
    Rate rate = Rate::none;
    bool deviatoric_rate = false; ///< VP = -1: the rate of shape alone; in shells and beams always so
    double reference_rate = 0;    ///< C of Cowper & Symonds [1/time]; 0: not used
    double rate_exponent = 0;     ///< 1 / P
    double overstress = 0;     ///< VP = 1: stress that the rate term multiplies; 0: the static yield stress
    Curve rate_factor;         ///< LCSR over strain rate; no points: not used
    double lowest_factor = 1;  ///< smallest factor at any rate
    double failure_strain = 0; ///< FAIL: plastic strain at which a point fails; 0: never
    double shortest_step = 0;  ///< TDEL: elements whose step falls below it are deleted [time]; 0: none

    /// `yield_bound`: no point yields below it, whatever the rate [stress]; zero at a failed point.
    enum History { plastic_strain, yield_bound, history_size };
    std::array<double, history_size> initial_history() const
    {
        return {0, lowest_factor * hardening.lowest(0.0)};
    }

    static PiecewiseLinearPlasticity from_record(const Record& record, const Model& model);

    double shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }
    double bulk_modulus() const { return young_modulus / (3 * (1 - 2 * poisson_ratio)); }

    /// Points whose plastic strain has reached FAIL.
    template <class Lane>
    auto failed(HistoryView<Lane> history) const
    {
        return history[plastic_strain] >= (failure_strain > 0 ? failure_strain : 1e300);
    }

    /// One step at a batch of solid points; see materials/history.h.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double time_step) const
    {
        add_elastic_stress(stress, increment, shear_modulus(), bulk_modulus() - 2 * shear_modulus() / 3);
        const SymmetricTensor<Lane> deviatoric = deviator(stress);
        const Lane squared = 1.5 * contract(deviatoric, deviatoric);
        const auto yielding = squared > history[yield_bound] * history[yield_bound];
        if (!any(yielding)) return;
        return_solid(stress, deviatoric, squared, increment, history, time_step);
    }

    /// One step at a batch of shell points; see materials/history.h.
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane> history, double time_step) const
    {
        add_plane_elastic_stress(stress, increment, young_modulus, poisson_ratio);
        increment.zz = -poisson_ratio / (1 - poisson_ratio) * (increment.xx + increment.yy);
        const Lane shears = stress.xy * stress.xy + stress.yz * stress.yz + stress.zx * stress.zx;
        const Lane squared = stress.xx * stress.xx + stress.yy * (stress.yy - stress.xx) + 3.0 * shears;
        const auto yielding = squared > history[yield_bound] * history[yield_bound];
        if (!any(yielding)) return;
        return_plane_stress(stress, increment, history, time_step);
    }

    /// One step at a batch of beam points; see materials/history.h.
    template <class Lane>
    void update_beam(Lane* stress, const Lane& axial, const Lane& rs, const Lane& tr,
                     HistoryView<Lane> history, double time_step) const
    {
        stress[0] += young_modulus * axial;
        stress[1] += shear_modulus() * rs;
        stress[2] += shear_modulus() * tr;
        const Lane squared = stress[0] * stress[0] + 3.0 * (stress[1] * stress[1] + stress[2] * stress[2]);
        const auto yielding = squared > history[yield_bound] * history[yield_bound];
        if (!any(yielding)) return;
        // Plastic flow keeps the volume: both lateral strains are half the axial one.
        return_beam(stress, 1.5 * axial * axial + 0.5 * (rs * rs + tr * tr), history, time_step);
    }

private:
    template <class Lane>
    struct Yield {
        Lane stress, slope; ///< slope by plastic increment
    };

    /// What the strain rate of a step does to the yield stress (VP = 0).
    template <class Lane>
    struct RateOfStep {
        Lane scale, total_rate;
    };
    /// What the change of volume has in the square of a strain increment, where it is not to count.
    template <class Lane>
    Lane volume_share(Lane volume) const
    {
        return deviatoric_rate ? (1.0 / 3) * volume * volume : Lane{};
    }
    template <class Lane>
    RateOfStep<Lane> rate_of_step(Lane strain_square, double time_step) const
    {
        if (rate != Rate::scaled || time_step == 0) return {broadcast<Lane>(1.0), Lane{}};
        const Lane total_rate = (1 / time_step) * sqrt((2.0 / 3) * strain_square);
        return {scale_of(total_rate), total_rate};
    }

    /// Factor on the static yield stress at a total strain rate (VP = 0).
    template <class Lane>
    Lane scale_of(Lane total_rate) const
    {
        if (reference_rate > 0) return 1.0 + power<Lane>(total_rate * (1 / reference_rate), rate_exponent);
        if (rate_factor.abscissa.empty()) return broadcast<Lane>(1.0);
        return map_lanes(total_rate, [&](double value) { return rate_factor(value); });
    }

    /// Yield stress after a plastic increment.
    template <class Lane>
    Yield<Lane> yield(Lane strain, Lane plastic_increment, const RateOfStep<Lane>& step_rate,
                      double time_step) const
    {
        if (rate == Rate::none) {
            const auto value = hardening(strain, Lane{});
            return {value.stress, value.slope};
        }
        if (rate == Rate::scaled) {
            const auto value = hardening(strain, step_rate.total_rate);
            return {step_rate.scale * value.stress, step_rate.scale * value.slope};
        }
        const double per_step = time_step > 0 ? 1 / time_step : 0;
        const Lane plastic_rate = plastic_increment * per_step;
        const auto value = hardening(strain, plastic_rate);
        const Lane slope = value.slope + per_step * value.by_rate;
        if (reference_rate > 0) {
            const Lane term = power<Lane>(plastic_rate * (1 / reference_rate), rate_exponent);
            const Lane term_slope = rate_exponent * term / max(plastic_increment, broadcast<Lane>(1e-300));
            if (overstress > 0) return {value.stress + overstress * term, slope + overstress * term_slope};
            return {value.stress * (1.0 + term), slope * (1.0 + term) + value.stress * term_slope};
        }
        if (rate_factor.abscissa.empty()) return {value.stress, slope};
        const Lane factor = map_lanes(plastic_rate, [&](double a) { return rate_factor(a); });
        const Lane factor_slope = map_lanes(plastic_rate, [&](double a) { return rate_factor.slope(a); });
        return {value.stress * factor, slope * factor + per_step * value.stress * factor_slope};
    }

    /// The rate term of Cowper & Symonds rises with infinite slope from zero, where Newton's method could not
    /// start.
    bool starts_at_rest() const { return rate != Rate::viscoplastic || reference_rate == 0; }

    /// First guess of the plastic increment under that term: it lies below both the increment that the rate
    /// term alone and the one that the elastic unloading alone would give.
    /// first      the point before any flow
    /// stiffness  fall of the von Mises stress with the plastic increment [stress]
    template <class Lane>
    Lane first_increment(const ReturnPoint<Lane>& first, double stiffness, double time_step) const
    {
        const Lane excess = max(first.equivalent - first.yield, Lane{});
        const Lane base = overstress > 0 ? broadcast<Lane>(overstress) : first.yield;
        const Lane by_rate = (time_step * reference_rate) * power<Lane>(excess / base, 1 / rate_exponent);
        return min(by_rate, excess * (1 / stiffness));
    }

    /// Stores what a return has given and clears the stress of failed points.
    template <class Lane>
    void finish(SymmetricTensor<Lane>& stress, MaskOf<Lane> yielding, Lane plastic_increment, Lane equivalent,
                HistoryView<Lane> history) const
    {
        const Lane strain = history[plastic_strain] + (yielding ? plastic_increment : Lane{});
        history[plastic_strain] = strain;
        // Without rate effect the point now lies on its yield surface: no need to look it up.
        const Lane bound = rate == Rate::none ? equivalent : lowest_factor * hardening.lowest(strain);
        history[yield_bound] = yielding ? bound : history[yield_bound];
        if (failure_strain == 0) return;
        const MaskOf<Lane> gone = failed(history);
        for (Lane* component : {&stress.xx, &stress.yy, &stress.zz, &stress.xy, &stress.yz, &stress.zx,
                                &history[yield_bound]}) {
            *component = gone ? Lane{} : *component;
        }
    }

    template <class Lane>
    [[gnu::noinline]] void
    return_solid(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& deviatoric, Lane squared,
                 const SymmetricTensor<Lane>& increment, HistoryView<Lane> history, double time_step) const
    {
        const double triple_shear = 3 * shear_modulus();
        const Lane old_strain = history[plastic_strain];
        const Lane trial = sqrt(squared);
        const RateOfStep<Lane> step_rate =
            rate_of_step(contract(increment, increment) - volume_share(trace(increment)), time_step);
        const auto at = [&](Lane plastic) {
            const Yield<Lane> now = yield<Lane>(old_strain + plastic, plastic, step_rate, time_step);
            const Lane equivalent = trial - triple_shear * plastic;
            return ReturnPoint<Lane>{equivalent, -triple_shear * equivalent, plastic, equivalent, now.stress,
                                     now.slope};
        };
        const ReturnPoint<Lane> first = at(Lane{});
        const MaskOf<Lane> yielding = (trial > first.yield) & MaskOf<Lane>(!failed(history));
        const Lane start =
            starts_at_rest() ? return_step(first) : first_increment(first, triple_shear, time_step);
        const Lane plastic = return_parameter<Lane>(yielding, start, at);
        const Lane factor = yielding ? triple_shear * plastic / trial : Lane{};
        stress = stress - factor * deviatoric;
        finish(stress, yielding, plastic, trial - triple_shear * plastic, history);
    }

    /// With the multiplier g the axial stress falls by 1 / (1 + 2/3 E g), shears by 1 / (1 + 2 G g): the form
    /// of Simo & Taylor for a stress with one normal component.
    template <class Lane>
    [[gnu::noinline]] void return_beam(Lane* stress, Lane strain_square, HistoryView<Lane> history,
                                       double time_step) const
    {
        const double axial_rate = 2 * young_modulus / 3, shear_rate = 2 * shear_modulus();
        const Lane old_strain = history[plastic_strain];
        const Lane axial_share = stress[0] * stress[0];
        const Lane shear_share = 3.0 * (stress[1] * stress[1] + stress[2] * stress[2]);
        const RateOfStep<Lane> step_rate = rate_of_step(strain_square, time_step);
        const auto at = [&](Lane g) {
            const Lane shrink = 1.0 / (1.0 + axial_rate * g), shrink_shear = 1.0 / (1.0 + shear_rate * g);
            const Lane by_axial = axial_share * shrink * shrink;
            const Lane by_shear = shear_share * shrink_shear * shrink_shear;
            const Lane square = by_axial + by_shear, equivalent = sqrt(square);
            const Lane fall = axial_rate * by_axial * shrink + shear_rate * by_shear * shrink_shear;
            const Lane plastic = (2.0 / 3) * g * equivalent;
            const Yield<Lane> now = yield<Lane>(old_strain + plastic, plastic, step_rate, time_step);
            return ReturnPoint<Lane>{equivalent, -fall,    plastic, (2.0 / 3) * (square - g * fall),
                                     now.stress, now.slope};
        };
        const ReturnPoint<Lane> first = at(Lane{});
        const MaskOf<Lane> yielding = (first.equivalent > first.yield) & MaskOf<Lane>(!failed(history));
        const Lane start = starts_at_rest() ? return_step(first)
                                            : 1.5 * first_increment(first, 1.5 * shear_rate, time_step) /
                                                  max(first.equivalent, broadcast<Lane>(1e-300));
        const Lane multiplier = return_parameter<Lane>(yielding, start, at);
        const Lane shrink = 1.0 / (1.0 + axial_rate * multiplier);
        const Lane shrink_shear = 1.0 / (1.0 + shear_rate * multiplier);
        SymmetricTensor<Lane> now{shrink * stress[0],       Lane{}, Lane{},
                                  shrink_shear * stress[1], Lane{}, shrink_shear * stress[2]};
        const Lane equivalent =
            sqrt(axial_share * shrink * shrink + shear_share * shrink_shear * shrink_shear);
        finish(now, yielding, (2.0 / 3) * multiplier * equivalent, equivalent, history);
        stress[0] = now.xx;
        stress[1] = now.xy;
        stress[2] = now.zx;
    }

    /// Simo & Taylor: with the multiplier g, sums of normal stresses fall by 1 / (1 + g E / (3 (1 - nu))),
    /// differences and shears by 1 / (1 + 2 G g); the plastic strain grows by 2/3 g times the von Mises
    /// stress.
    template <class Lane>
    [[gnu::noinline]] void return_plane_stress(SymmetricTensor<Lane>& stress,
                                               SymmetricTensor<Lane>& increment, HistoryView<Lane> history,
                                               double time_step) const
    {
        const double sum_rate = young_modulus / (3 * (1 - poisson_ratio));
        const double other_rate = 2 * shear_modulus();
        const Lane old_strain = history[plastic_strain];
        const Lane sum = stress.xx + stress.yy, difference = stress.xx - stress.yy;
        const Lane shears = stress.xy * stress.xy + stress.yz * stress.yz + stress.zx * stress.zx;
        const Lane sum_share = 0.25 * sum * sum, other_share = 0.75 * difference * difference + 3.0 * shears;
        // Plastic flow keeps the volume, so the thickness strain is minus the sum of the others.
        const Lane in_plane = increment.xx + increment.yy;
        const Lane strain_square =
            increment.xx * increment.xx + increment.yy * increment.yy + in_plane * in_plane +
            2.0 * (increment.xy * increment.xy + increment.yz * increment.yz + increment.zx * increment.zx);
        const RateOfStep<Lane> step_rate = rate_of_step(strain_square, time_step);
        const auto along = [&](Lane g, Lane shrink_sum, Lane shrink_other) {
            const Lane by_sum = sum_share * shrink_sum * shrink_sum;
            const Lane by_other = other_share * shrink_other * shrink_other;
            const Lane square = by_sum + by_other;
            const Lane equivalent = sqrt(square);
            const Lane fall = sum_rate * by_sum * shrink_sum + other_rate * by_other * shrink_other;
            const Lane plastic = (2.0 / 3) * g * equivalent;
            const Yield<Lane> now = yield<Lane>(old_strain + plastic, plastic, step_rate, time_step);
            return ReturnPoint<Lane>{equivalent, -fall,    plastic, (2.0 / 3) * (square - g * fall),
                                     now.stress, now.slope};
        };
        const auto at = [&](Lane g) {
            const Lane a = 1.0 + sum_rate * g, b = 1.0 + other_rate * g;
            const Lane inverse = 1.0 / (a * b);
            return along(g, inverse * b, inverse * a);
        };
        const Lane one = broadcast<Lane>(1.0);
        const ReturnPoint<Lane> first = along(Lane{}, one, one);
        const MaskOf<Lane> yielding = (first.equivalent > first.yield) & MaskOf<Lane>(!failed(history));
        const Lane start = starts_at_rest() ? return_step(first)
                                            : 1.5 * first_increment(first, 1.5 * other_rate, time_step) /
                                                  max(first.equivalent, broadcast<Lane>(1e-300));
        const Lane multiplier = return_parameter<Lane>(yielding, start, at);

        const Lane a = 1.0 + sum_rate * multiplier, b = 1.0 + other_rate * multiplier;
        const Lane inverse = 1.0 / (a * b);
        const Lane shrink_sum = inverse * b, shrink_other = inverse * a;
        const Lane new_sum = sum * shrink_sum, new_difference = difference * shrink_other;
        stress.xx = 0.5 * (new_sum + new_difference);
        stress.yy = 0.5 * (new_sum - new_difference);
        stress.xy *= shrink_other;
        stress.yz *= shrink_other;
        stress.zx *= shrink_other;
        increment.zz += (poisson_ratio / young_modulus) * (sum - new_sum) - (1.0 / 3) * multiplier * new_sum;
        const Lane equivalent =
            sqrt(sum_share * shrink_sum * shrink_sum + other_share * shrink_other * shrink_other);
        finish(stress, yielding, (2.0 / 3) * multiplier * equivalent, equivalent, history);
    }
};

} // namespace plash
