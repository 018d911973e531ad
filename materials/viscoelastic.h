#pragma once

#include "materials/history.h"
#include "materials/maxwell.h"
#include "math/tensor3.h"
#include "model/model.h"

#include <array>

namespace plash {

/// *MAT_VISCOELASTIC (006) and *MAT_KELVIN-MAXWELL_VISCOELASTIC (061) with FO = 0: elastic in volume, the
/// deviator relaxes with the shear modulus GI + (G0 - GI) exp(-BETA t). Sources: Herrmann & Peterson (1968);
/// Hallquist (2006), LS-DYNA theory manual, material model 6. Exact for a constant strain rate within a step.
struct Viscoelastic {
    double density = 0;       ///< [mass/volume]
    double bulk_modulus = 0;  ///< BULK [stress]
    double long_modulus = 0;  ///< GI: shear modulus after relaxation [stress]
    MaxwellElement fading;    ///< G0 - GI and BETA
    double young_modulus = 0; ///< of BULK and the larger of G0 and GI [stress]
    double poisson_ratio = 0;

    enum History {
        relaxing,
        history_size = relaxing + 6
    }; ///< the part of the deviator that relaxes [stress]
    std::array<double, history_size> initial_history() const { return {}; }

    static Viscoelastic from_record(const Record& record, const Model& model);

    template <class Lane>
    void rotate_history(HistoryView<Lane> history, const Tensor3<Lane>& rotation) const
    {
        put(history, rotated(part(history), rotation));
    }

    /// One step at a batch of solid points; see materials/history.h.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double time_step) const
    {
        const auto factors = fading.step(time_step);
        const Lane pressure = (-1.0 / 3) * trace(stress) - bulk_modulus * trace(increment);
        const SymmetricTensor<Lane> change = deviator(increment), old = part(history);
        const SymmetricTensor<Lane> lasting =
            deviator(stress) - old + broadcast<Lane>(2 * long_modulus) * change;
        const SymmetricTensor<Lane> now =
            broadcast<Lane>(factors.keep) * old + broadcast<Lane>(factors.gain) * change;
        put(history, now);
        const SymmetricTensor<Lane> shear = lasting + now;
        stress = {
            shear.xx - pressure, shear.yy - pressure, shear.zz - pressure, shear.xy, shear.yz, shear.zx};
    }

private:
    template <class Lane>
    static SymmetricTensor<Lane> part(HistoryView<Lane> h)
    {
        return {h[relaxing],     h[relaxing + 1], h[relaxing + 2],
                h[relaxing + 3], h[relaxing + 4], h[relaxing + 5]};
    }

    template <class Lane>
    static void put(HistoryView<Lane> h, const SymmetricTensor<Lane>& s)
    {
        h[relaxing] = s.xx;
        h[relaxing + 1] = s.yy;
        h[relaxing + 2] = s.zz;
        h[relaxing + 3] = s.xy;
        h[relaxing + 4] = s.yz;
        h[relaxing + 5] = s.zx;
    }
};

} // namespace plash
