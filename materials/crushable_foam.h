#pragma once

#include "materials/history.h"
#include "materials/principal_axes.h"
#include "materials/von_mises.h"
#include "math/curve.h"
#include "model/model.h"

#include <array>
#include <cmath>

namespace plash {

/// *MAT_CRUSHABLE_FOAM (063): elastic trial stress whose principal values are cut at the crushing stress, a
/// curve over the volume strain 1 - V, in compression and at TSC in tension. Unloading is elastic. Source:
/// Hallquist (2006), LS-DYNA theory manual, material model 63. Crushing does not get easier when the foam is
/// opened again: the curve is read at the largest compaction so far.
struct CrushableFoam {
    double density = 0;       ///< [mass/volume]
    double young_modulus = 0; ///< [stress]
    double poisson_ratio = 0;
    Curve crushing;             ///< LCID: stress over volume strain
    double tensile_cutoff = 0;  ///< TSC [stress]
    double lowest_crushing = 0; ///< smallest stress of the curve

    enum History { log_volume, compaction, history_size };
    std::array<double, history_size> initial_history() const { return {}; }

    static CrushableFoam from_record(const Record& record, const Model& model);

    /// One step at a batch of solid points; see materials/history.h.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double /*time_step*/) const
    {
        const double shear = young_modulus / (2 * (1 + poisson_ratio));
        add_elastic_stress(stress, increment, shear, 2 * shear * poisson_ratio / (1 - 2 * poisson_ratio));
        history[log_volume] += trace(increment);
        // No principal stress is larger than the norm of the tensor.
        const double least = std::min(tensile_cutoff, lowest_crushing);
        if (!any(contract(stress, stress) > least * least)) return;
        for (int lane = 0; lane < lanes_in<Lane>; ++lane) cut(stress, history, lane);
    }

private:
    template <class Lane>
    void cut(SymmetricTensor<Lane>& stress, HistoryView<Lane> history, int lane) const
    {
        const double now = 1 - std::exp(lane_of(history[log_volume], lane));
        const double most = std::max(lane_of(history[compaction], lane), now);
        set_lane(history[compaction], lane, most);
        auto principal = principal_axes(SymmetricTensor<double>{
            lane_of(stress.xx, lane), lane_of(stress.yy, lane), lane_of(stress.zz, lane),
            lane_of(stress.xy, lane), lane_of(stress.yz, lane), lane_of(stress.zx, lane)});
        const double limit = crushing(most);
        bool changed = false;
        for (double& value : principal.value) {
            const double allowed = std::min(std::max(value, -limit), tensile_cutoff);
            changed = changed || allowed != value;
            value = allowed;
        }
        if (!changed) return;
        const SymmetricTensor<double> result = principal.tensor();
        set_lane(stress.xx, lane, result.xx);
        set_lane(stress.yy, lane, result.yy);
        set_lane(stress.zz, lane, result.zz);
        set_lane(stress.xy, lane, result.xy);
        set_lane(stress.yz, lane, result.yz);
        set_lane(stress.zx, lane, result.zx);
    }
};

} // namespace plash
