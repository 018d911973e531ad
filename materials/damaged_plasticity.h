#pragma once

#include "materials/piecewise_linear_plasticity.h"

namespace plash {

/// *MAT_PLASTICITY_WITH_DAMAGE (081): the plasticity of 024 for the stress on the part of the section that
/// still bears, and a damage w that grows with plastic strain from EPPF on: stress = (1 - w) effective
/// stress, so that stiffness falls with strength. w is linear from EPPF to EPPFR, or the curve LCDM over
/// plastic strain - EPPF. A point is gone at EPPFR or when w reaches 1. Sources: LS-DYNA keyword manual,
/// volume II, *MAT_081; effective stress after Kachanov (1958) and Lemaitre (1985).
struct DamagedPlasticity {
    PiecewiseLinearPlasticity law;
    double density = 0, young_modulus = 0, poisson_ratio = 0; ///< those of the law
    double shortest_step = 0;                                 ///< TDEL [time]
    double onset = 1e12;                                      ///< EPPF
    double rupture = 1e14;                                    ///< EPPFR
    Curve growth; ///< LCDM: damage over plastic strain - EPPF; no points: a line to EPPFR

    static constexpr int plastic_strain = PiecewiseLinearPlasticity::plastic_strain;
    enum History { damage = PiecewiseLinearPlasticity::history_size, history_size };

    static DamagedPlasticity from_record(const Record& record, const Model& model);

    std::array<double, history_size> initial_history() const;

    /// The bound of the yield stress as in *MAT_024, and the damage.
    std::vector<ShownVariable> shown_history(bool /*of_shells*/) const
    {
        return {{PiecewiseLinearPlasticity::yield_bound}, {damage}};
    }

    bool fractures() const { return onset < 1e12 || rupture < 1e13; }

    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history) const
    {
        return history[damage] >= 1.0;
    }

    /// One step at a batch of solid points; see materials/history.h.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double time_step) const
    {
        const Lane old = effective(stress, history);
        law.update(stress, increment, history, time_step);
        nominal(stress, old, history);
    }

    /// One step at a batch of shell points; see materials/history.h.
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane> history, double time_step) const
    {
        const Lane old = effective(stress, history);
        law.update_plane_stress(stress, increment, history, time_step);
        nominal(stress, old, history);
    }

private:
    /// Turns a nominal stress into the effective one; returns the plastic strain so far.
    template <class Lane>
    Lane effective(SymmetricTensor<Lane>& stress, HistoryView<Lane> history) const
    {
        const Lane bearing = 1.0 - history[damage];
        stress = Lane{bearing > 0.0 ? 1.0 / bearing : Lane{}} * stress;
        return history[plastic_strain];
    }

    template <class Lane>
    void nominal(SymmetricTensor<Lane>& stress, const Lane& old, HistoryView<Lane> history) const
    {
        const Lane strain = history[plastic_strain];
        if (any((strain > old) & (strain > onset))) {
            const Lane beyond = max(strain - onset, Lane{});
            Lane grown = growth.abscissa.empty()
                             ? Lane{(1 / (rupture - onset)) * beyond}
                             : map_lanes(beyond, [&](double value) { return growth(value); });
            grown = strain >= rupture ? broadcast<Lane>(1) : grown;
            history[damage] = max(history[damage], min(grown, broadcast<Lane>(1)));
        }
        stress = Lane{1.0 - history[damage]} * stress;
    }
};

} // namespace plash
