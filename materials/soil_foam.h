#pragma once

#include "materials/hardening.h"
#include "materials/history.h"
#include "math/symmetric_tensor.h"
#include "model/model.h"

#include <array>

namespace plash {

/// *MAT_SOIL_AND_FOAM (005) and *MAT_SOIL_AND_FOAM_FAILURE (014): pressure from a table over the volume
/// strain, shear strength J2 <= A0 + A1 p + A2 p^2 without volume change by shear (the deviator returns
/// radially). Sources: Krieg (1972), 'A simple constitutive description for soils and crushable foams',
/// Sandia SC-DR-72-0883; Hallquist (2006), LS-DYNA theory manual, material models 5 and 14.
///
/// With the compaction c = -ln V and its largest value so far, m: p = table(c) while c grows past m, and
/// p = table(m) - K (m - c) below it, never under the cut-off PC. VCR = 1: p = table(c) always. K is the
/// larger of BULK and the steepest slope of the table, since unloading along less than the loading slope
/// would give back more work than went in.
struct SoilFoam {
    double density = 0;       ///< [mass/volume]
    double shear_modulus = 0; ///< G [stress]
    double bulk_modulus = 0;  ///< K [stress]
    double young_modulus = 0; ///< of G and K [stress]
    double poisson_ratio = 0;
    double a0 = 0;          ///< A0 [stress^2]
    double a1 = 0;          ///< A1 [stress]
    double a2 = 0;          ///< A2
    double cutoff = 0;      ///< PC: lowest pressure [stress]
    Hardening table;        ///< pressure over compaction; goes on with its last slope
    double first_slope = 0; ///< of the table, for expansion with VCR = 1 [stress]
    bool crushes = true;    ///< VCR = 0
    bool tears = false;     ///< 014: no tension after PC has been reached

    static constexpr bool pressure_from_volume = true; ///< a pressure given at the start would be lost

    enum History { plastic_strain, compaction, largest_compaction, torn, history_size };
    std::array<double, history_size> initial_history() const { return {}; }

    static SoilFoam from_record(const Record& record, const Model& model);

    /// One step at a batch of solid points; see materials/history.h.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double /*time_step*/) const
    {
        const Lane pressure = pressure_after(trace(increment), history);
        SymmetricTensor<Lane> shear =
            deviator(stress) + broadcast<Lane>(2 * shear_modulus) * deviator(increment);
        const Lane square = 1.5 * contract(shear, shear);
        const Lane bound = 3.0 * max(a0 + pressure * (a1 + a2 * pressure), Lane{});
        const MaskOf<Lane> yielding = square > bound;
        if (any(yielding)) {
            const Lane trial = sqrt(square), left = sqrt(bound);
            const Lane factor = yielding ? left / max(trial, broadcast<Lane>(1e-300)) : broadcast<Lane>(1);
            history[plastic_strain] += yielding ? (1 / (3 * shear_modulus)) * (trial - left) : Lane{};
            shear = factor * shear;
        }
        stress = {
            shear.xx - pressure, shear.yy - pressure, shear.zz - pressure, shear.xy, shear.yz, shear.zx};
    }

private:
    template <class Lane>
    Lane pressure_after(const Lane& volume_strain, HistoryView<Lane> history) const
    {
        const Lane now = history[compaction] - volume_strain;
        history[compaction] = now;
        Lane pressure;
        if (crushes) {
            const Lane most = max(history[largest_compaction], now);
            history[largest_compaction] = most;
            pressure = table(most, Lane{}).stress - bulk_modulus * (most - now);
        } else {
            pressure = now > 0.0 ? table(max(now, Lane{}), Lane{}).stress : first_slope * now;
        }
        if (!tears) return max(pressure, broadcast<Lane>(cutoff));
        history[torn] = pressure <= cutoff ? broadcast<Lane>(1) : history[torn];
        return history[torn] > 0.0 ? max(pressure, Lane{}) : pressure;
    }
};

} // namespace plash
