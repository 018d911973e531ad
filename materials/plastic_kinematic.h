#pragma once

#include "materials/cowper_symonds.h"
#include "materials/history.h"
#include "materials/parameters.h"
#include "materials/von_mises.h"
#include "math/tensor3.h"

#include <array>

namespace plash {

/// Parameters of *MAT_PLASTIC_KINEMATIC, common to both forms of the law.
struct PlasticKinematicParameters {
    double density = 0;         ///< [mass/volume]
    double young_modulus = 0;   ///< [stress]
    double poisson_ratio = 0;   ///< [-]
    double yield_stress = 0;    ///< SIGY [stress]
    double plastic_modulus = 0; ///< E ETAN / (E - ETAN) [stress]
    double beta = 0;            ///< 0 kinematic, 1 isotropic hardening
    CowperSymonds rate;
    bool viscoplastic = false; ///< VP = 1: the rate is that of plastic strain
    double failure_strain = 0; ///< FS: effective plastic strain at which elements are deleted; 0: never

    static PlasticKinematicParameters from_record(const Record& record);

    /// A back stress is needed only if something moves it.
    bool has_back_stress() const { return beta < 1 && plastic_modulus > 0; }
};

/// *MAT_PLASTIC_KINEMATIC (003): von Mises plasticity with mixed linear hardening, radial return.
/// Source: Krieg & Key (1976); rate effect of Cowper & Symonds (1957) on the yield stress; Hallquist (2006),
/// LS-DYNA theory manual, material model 3.
///
/// with_back_stress false is the form without kinematic hardening, which carries six variables less.
template <bool with_back_stress>
struct PlasticKinematic : PlasticKinematicParameters {
    static constexpr int plastic_strain = 0;
    static constexpr int back_stress = 1; ///< deviator
    static constexpr int history_size = with_back_stress ? 7 : 1;
    std::array<double, history_size> initial_history() const { return {}; }

    /// The back stress xx, yy, xy, yz, zx.
    std::vector<ShownVariable> shown_history(bool /*of_shells*/) const
    {
        if (!with_back_stress) return {};
        return {{back_stress}, {back_stress + 1}, {back_stress + 3}, {back_stress + 4}, {back_stress + 5}};
    }

    static PlasticKinematic from_record(const Record& record, const Model&)
    {
        return {PlasticKinematicParameters::from_record(record)};
    }

    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history) const
    {
        const double limit = failure_strain > 0 ? failure_strain : std::numeric_limits<double>::infinity();
        return history[plastic_strain] >= limit;
    }

    /// Turns the back stress with the material.
    template <class Lane>
    void rotate_history(HistoryView<Lane> history, const Tensor3<Lane>& rotation) const
    {
        if constexpr (with_back_stress)
            put_tensor(&history[back_stress], rotated(back_stress_of(history), rotation));
    }

    /// One step at a batch of solid points.
    /// stress     Cauchy [stress], in and out
    /// increment  strain increments of the step [-]
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double time_step) const
    {
        const double shear = young_modulus / (2 * (1 + poisson_ratio));
        const double lame = 2 * shear * poisson_ratio / (1 - 2 * poisson_ratio);
        add_elastic_stress(stress, increment, shear, lame);

        SymmetricTensor<Lane> relative = deviator(stress);
        if constexpr (with_back_stress) relative = relative - back_stress_of(history);
        const Lane scale = rate_factor(increment, time_step);
        const Lane yield = scale * (yield_stress + isotropic_modulus() * history[plastic_strain]);
        const Lane square = 1.5 * contract(relative, relative);
        const MaskOf<Lane> yielding = square > yield * yield;
        if (!any(yielding)) return;

        const double stiffness = 3 * shear + kinematic_modulus();
        const Lane trial = yielding ? sqrt(square) : broadcast<Lane>(1);
        Lane share; // plastic strain over trial stress
        if (viscoplastic) {
            const PlaneStressPath<Lane> path(stiffness / 1.5, stiffness / 1.5, Lane{}, square);
            const Lane m = rate.multiplier(path, yield, isotropic_modulus(), time_step);
            share = m / (1.5 + stiffness * m);
        } else {
            share = (trial - yield) / (trial * (stiffness + scale * isotropic_modulus()));
        }
        share = yielding ? share : Lane{};
        history[plastic_strain] += share * trial;
        stress = stress - (3 * shear * share) * relative;
        if constexpr (with_back_stress) {
            put_tensor(&history[back_stress],
                       back_stress_of(history) + (kinematic_modulus() * share) * relative);
        }
    }

    /// One step at a batch of shell points with stress.zz = 0.
    /// increment  in: all but zz; out: zz, the thickness strain that keeps stress.zz at zero [-]
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane> history, double time_step) const
    {
        const Lane sum_before = stress.xx + stress.yy;
        add_plane_elastic_stress(stress, increment, young_modulus, poisson_ratio);
        increment.zz = -poisson_ratio / (1 - poisson_ratio) * (increment.xx + increment.yy);

        // Back stress in plane-stress form: the stress with zz = 0 that has the same deviator.
        SymmetricTensor<Lane> center{};
        if constexpr (with_back_stress) {
            center = back_stress_of(history);
            center = {center.xx - center.zz, center.yy - center.zz, Lane{}, center.xy, center.yz, center.zx};
        }
        SymmetricTensor<Lane> relative = stress - center;
        relative.zz = Lane{};
        const Lane scale = rate_factor(increment, time_step);
        const Lane yield = scale * (yield_stress + isotropic_modulus() * history[plastic_strain]);
        const PlaneStressPath<Lane> path(relative, kinematic_modulus(), young_modulus, poisson_ratio);
        const Lane multiplier = viscoplastic ? rate.multiplier(path, yield, isotropic_modulus(), time_step)
                                             : path.multiplier(yield, scale * isotropic_modulus());
        if (!any(multiplier > 0.0)) return;

        history[plastic_strain] += path.shrink(relative, multiplier);
        if constexpr (with_back_stress) {
            const Lane shift = (2.0 / 3 * kinematic_modulus()) * multiplier;
            put_tensor(&history[back_stress], back_stress_of(history) + shift * deviator(relative));
            center = center + shift * relative;
        }
        const Lane plastic_zz = multiplier * (-1.0 / 3) * (relative.xx + relative.yy);
        stress = relative + center;
        stress.zz = Lane{};
        increment.zz = -poisson_ratio / young_modulus * (stress.xx + stress.yy - sum_before) + plastic_zz;
    }

    /// One step at a batch of beam points; see materials/history.h. The axial stress takes the place of the
    /// slow mode of plane stress, with the rate 2/3 E.
    template <class Lane>
    void update_beam(Lane* stress, const Lane& axial, const Lane& rs, const Lane& tr,
                     HistoryView<Lane> history, double time_step) const
    {
        const double shear = young_modulus / (2 * (1 + poisson_ratio));
        Lane center[3] = {};
        if constexpr (with_back_stress) {
            const SymmetricTensor<Lane> back = back_stress_of(history);
            center[0] = 1.5 * back.xx;
            center[1] = back.xy;
            center[2] = back.zx;
        }
        const Lane elastic[3] = {young_modulus * axial, shear * rs, shear * tr};
        Lane relative[3];
        for (int i = 0; i < 3; ++i) relative[i] = stress[i] + elastic[i] - center[i];
        const SymmetricTensor<Lane> strain{axial, -0.5 * axial, -0.5 * axial, 0.5 * rs, Lane{}, 0.5 * tr};
        const Lane scale = rate_factor(strain, time_step);
        const Lane yield = scale * (yield_stress + isotropic_modulus() * history[plastic_strain]);
        const double shift_rate = 2.0 / 3 * kinematic_modulus();
        const PlaneStressPath<Lane> path(2 * young_modulus / 3 + shift_rate, 2 * shear + shift_rate,
                                         relative[0] * relative[0],
                                         3.0 * (relative[1] * relative[1] + relative[2] * relative[2]));
        const Lane m = viscoplastic ? rate.multiplier(path, yield, isotropic_modulus(), time_step)
                                    : path.multiplier(yield, scale * isotropic_modulus());
        const Lane u = 1.0 / (1.0 + path.slow * m), w = 1.0 / (1.0 + path.fast * m);
        history[plastic_strain] += (2.0 / 3) * m * sqrt(path.slow_square * u * u + path.fast_square * w * w);
        relative[0] *= u;
        relative[1] *= w;
        relative[2] *= w;
        if constexpr (with_back_stress) {
            const Lane shift = shift_rate * m;
            put_tensor(&history[back_stress],
                       back_stress_of(history) +
                           shift * SymmetricTensor<Lane>{(2.0 / 3) * relative[0], (-1.0 / 3) * relative[0],
                                                         (-1.0 / 3) * relative[0], relative[1], Lane{},
                                                         relative[2]});
            for (int i = 0; i < 3; ++i) center[i] += shift * relative[i];
        }
        for (int i = 0; i < 3; ++i) stress[i] = relative[i] + center[i];
    }

private:
    double isotropic_modulus() const { return with_back_stress ? beta * plastic_modulus : plastic_modulus; }
    double kinematic_modulus() const { return with_back_stress ? (1 - beta) * plastic_modulus : 0; }

    template <class Lane>
    static SymmetricTensor<Lane> back_stress_of(HistoryView<Lane> history)
    {
        return tensor_at(&history[back_stress]);
    }

    /// 1 + (rate / C)^(1/P) with the norm of the total strain rate (VP = 0).
    template <class Lane>
    Lane rate_factor(const SymmetricTensor<Lane>& increment, double time_step) const
    {
        if (rate.constant == 0 || viscoplastic || time_step == 0) return broadcast<Lane>(1);
        return rate.factor(Lane{contract(increment, increment) * (1 / (time_step * time_step))});
    }
};

} // namespace plash
