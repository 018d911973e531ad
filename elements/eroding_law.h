#pragma once

#include "elements/erosion_criteria.h"
#include "materials/history.h"
#include "math/lanes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plash {

/// A law of shells or beams under *MAT_ADD_EROSION: sums up the strains of each point in the axes of the
/// element and takes the stress away for good once its criteria hold; the group then counts such points.
/// Strains are sums of increments, also through the thickness. Source: LS-DYNA keyword manual, volume II.
template <class Law>
struct ErodingLaw {
    Law law;
    ErosionCriteria criteria;
    double quiet_stress = 0, quiet_strain = 0; ///< squares of norms below which no criterion can hold

    static constexpr bool has_plastic_strain = requires { Law::plastic_strain; };
    static constexpr int plastic_strain = [] {
        if constexpr (has_plastic_strain) return int{Law::plastic_strain};
        return -1;
    }();
    /// Six strains, the impulse, and whether the point has failed, behind the law's own variables.
    enum History { strain = Law::history_size, impulse = strain + 6, gone, history_size };

    ErodingLaw(Law its_law, const ErosionCriteria& its_criteria)
        : law(std::move(its_law)),
          criteria(its_criteria),
          quiet_stress(stress_bound()),
          quiet_strain(strain_bound())
    {}

    std::array<double, history_size> initial_history() const
    {
        std::array<double, history_size> values{};
        const auto own = law.initial_history();
        std::copy(own.begin(), own.end(), values.begin());
        return values;
    }

    /// Points that the law itself has given up, and those under the criteria.
    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history) const
    {
        if constexpr (requires { law.failed(history); }) return law.failed(history) | eroded(history);
        return eroded(history);
    }

    template <class Lane>
    MaskOf<Lane> eroded(HistoryView<Lane> history) const
    {
        return history[gone] > 0.0;
    }

    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane> history, double time_step) const
    {
        law.update_plane_stress(stress, increment, history, time_step);
        judge(stress, increment, history, time_step);
        clear({&stress.xx, &stress.yy, &stress.xy, &stress.yz, &stress.zx}, history);
    }

    template <class Lane>
    void update_beam(Lane* stress, const Lane& axial, const Lane& rs, const Lane& tr,
                     HistoryView<Lane> history, double time_step) const
    {
        const Lane before = stress[0];
        law.update_beam(stress, axial, rs, tr, history, time_step);
        // Sideways the elastic part of the strain has Poisson's ratio, and the plastic part keeps the volume.
        const Lane elastic = (1 / law.young_modulus) * (stress[0] - before);
        const Lane side = -law.poisson_ratio * elastic - 0.5 * (axial - elastic);
        const SymmetricTensor<Lane> all{stress[0], Lane{}, Lane{}, stress[1], Lane{}, stress[2]};
        judge(all, SymmetricTensor<Lane>{axial, side, side, 0.5 * rs, Lane{}, 0.5 * tr}, history, time_step);
        clear({&stress[0], &stress[1], &stress[2]}, history);
    }

private:
    double stress_bound() const
    {
        // |pressure| <= norm / sqrt(3), von Mises <= sqrt(1.5) norm, principal stress <= norm.
        double norm = 1e150;
        const auto take = [&](const std::optional<double>& limit, double factor, double sign) {
            if (limit) norm = std::min(norm, std::max(0.0, sign * *limit) * factor);
        };
        take(criteria.largest_pressure, std::sqrt(3.0), 1);
        take(criteria.smallest_pressure, std::sqrt(3.0), -1);
        take(criteria.largest_principal_stress, 1, 1);
        take(criteria.largest_equivalent, std::sqrt(2.0 / 3), 1);
        if (criteria.impulse) norm = 0;
        return norm * norm;
    }

    double strain_bound() const
    {
        double norm = 1e150;
        const auto take = [&](const std::optional<double>& limit, double factor, double sign) {
            if (limit) norm = std::min(norm, std::max(0.0, sign * *limit) * factor);
        };
        take(criteria.smallest_strain, 1, -1);
        take(criteria.largest_strain, 1, 1);
        take(criteria.effective_strain, std::sqrt(1.5), 1);
        take(criteria.shear_strain, std::sqrt(2.0), 1);
        take(criteria.thinning, 1, 1);
        if (criteria.volume_strain) take(std::abs(*criteria.volume_strain), 1 / std::sqrt(3.0), 1);
        return norm * norm;
    }

    template <class Lane>
    void judge(const SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
               HistoryView<Lane> history, double time_step) const
    {
        const Lane parts[6] = {increment.xx, increment.yy, increment.zz,
                               increment.xy, increment.yz, increment.zx};
        for (int i = 0; i < 6; ++i) history[strain + i] += parts[i];
        const SymmetricTensor<Lane> all{history[strain],     history[strain + 1], history[strain + 2],
                                        history[strain + 3], history[strain + 4], history[strain + 5]};
        // A little below the bounds, so that round-off decides nothing.
        constexpr double below = 1 - 1e-9;
        if (!any(contract(stress, stress) >= below * quiet_stress) &&
            !any(contract(all, all) >= below * quiet_strain)) {
            return;
        }
        for (int lane = 0; lane < lanes_in<Lane>; ++lane)
            judge_lane(one(stress, lane), one(all, lane), history, time_step, lane);
    }

    template <class Lane>
    void judge_lane(const SymmetricTensor<double>& stress, const SymmetricTensor<double>& all,
                    HistoryView<Lane> history, double time_step, int lane) const
    {
        double integral = lane_of(history[impulse], lane);
        if (criteria.impulse) {
            const double above = std::max(0.0, principal_values(stress)[0] - criteria.impulse_threshold);
            integral += above * above * time_step;
            set_lane(history[impulse], lane, integral);
        }
        const auto principal = criteria.needs_strain() ? principal_values(all) : std::array<double, 3>{};
        const int thin = criteria.thinning && -all.zz >= *criteria.thinning ? 1 : 0;
        if (criteria.hold(stress, principal, integral, thin)) set_lane(history[gone], lane, 1);
    }

    template <class Lane>
    static SymmetricTensor<double> one(const SymmetricTensor<Lane>& t, int lane)
    {
        return {lane_of(t.xx, lane), lane_of(t.yy, lane), lane_of(t.zz, lane),
                lane_of(t.xy, lane), lane_of(t.yz, lane), lane_of(t.zx, lane)};
    }

    template <class Lane, std::size_t count>
    void clear(Lane* const (&components)[count], HistoryView<Lane> history) const
    {
        const MaskOf<Lane> failed_points = eroded(history);
        if (!any(failed_points)) return;
        for (Lane* component : components) *component = failed_points ? Lane{} : *component;
    }
};

} // namespace plash
