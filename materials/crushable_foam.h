#pragma once

#include "materials/hardening.h"
#include "materials/history.h"
#include "materials/principal_axes.h"
#include "materials/von_mises.h"
#include "model/model.h"

#include <array>

namespace plash {

/// *MAT_CRUSHABLE_FOAM (063): elastic trial stress whose principal values are cut at the crushing stress, a
/// curve over the volume strain 1 - V, in compression and at TSC in tension. Unloading is elastic. Source:
/// Hallquist (2006), LS-DYNA theory manual, material model 63. Crushing does not get easier when the foam is
/// opened again: the curve is read at the largest compaction so far.
struct CrushableFoam {
    double density = 0;       ///< [mass/volume]
    double young_modulus = 0; ///< [stress]
    double poisson_ratio = 0;
    Hardening crushing;         ///< LCID: stress over volume strain, up to `last_strain`
    double last_strain = 0;     ///< of the curve; it is held beyond
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
        history[compaction] = max(history[compaction], Lane{1.0 - exp(history[log_volume])});
        // No principal stress is larger than the norm of the tensor.
        const double least = std::min(tensile_cutoff, lowest_crushing);
        if (!any(contract(stress, stress) > least * least)) return;
        cut(stress, history);
    }

private:
    /// Cuts the principal stresses; lanes that need no cut keep their stress to the bit.
    template <class Lane>
    [[gnu::noinline]] void cut(SymmetricTensor<Lane>& stress, HistoryView<Lane> history) const
    {
        const Lane limit = crushing(min(history[compaction], broadcast<Lane>(last_strain)), Lane{}).stress;
        auto principal = principal_axes(stress);
        Lane changed{};
        for (Lane& value : principal.value) {
            const Lane allowed = min(max(value, Lane{-limit}), broadcast<Lane>(tensile_cutoff));
            changed += abs(allowed - value);
            value = allowed;
        }
        const SymmetricTensor<Lane> result = principal.tensor();
        const MaskOf<Lane> is_cut = changed > 0.0;
        stress = {is_cut ? result.xx : stress.xx, is_cut ? result.yy : stress.yy,
                  is_cut ? result.zz : stress.zz, is_cut ? result.xy : stress.xy,
                  is_cut ? result.yz : stress.yz, is_cut ? result.zx : stress.zx};
    }
};

} // namespace plash
