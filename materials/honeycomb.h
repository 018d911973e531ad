#pragma once

#include "materials/history.h"
#include "materials/orthotropic_axes.h"
#include "math/broken_line.h"
#include "math/lanes_math.h"
#include "math/symmetric_tensor.h"

#include <array>

namespace plash {

/// *MAT_HONEYCOMB (026): six stresses along the axes of the cells that do not know one another. Each is
/// elastic with a modulus that grows linearly from its uncompacted value to that of the solid (E, G) while
/// the relative volume V falls from 1 to VF, and stops at the value of its curve over 1 - V, times LCSR of
/// the strain rate. Below VF: an elastic, perfectly plastic solid of E, PR and SIGY. Source: Hallquist
/// (2006), LS-DYNA theory manual, material model 26; keyword manual, volume II, *MAT_026. Curves go on with
/// their last slopes, but not below zero.
struct Honeycomb {
    double density = 0;                  ///< [mass/volume]
    double young_modulus = 0;            ///< E, compacted [stress]
    double poisson_ratio = 0;            ///< PR, compacted
    double yield_stress = 0;             ///< SIGY, compacted [stress]
    double compacted_volume = 0;         ///< VF
    std::array<double, 6> uncompacted{}; ///< EAAU, EBBU, ECCU and twice GABU, GBCU, GCAU [stress]
    std::array<BrokenLine, 6> strength;  ///< LCA, LCB, LCC, LCAB, LCBC, LCCA over 1 - V [stress]
    BrokenLine rate_factor;              ///< LCSR over the strain rate
    bool rate_dependent = false;
    double tensile_failure = 1e300; ///< TSEF: normal strain that deletes the element
    double shear_failure = 1e300;   ///< SSEF: engineering shear strain that does
    OrthotropicAxes axes;

    enum History {
        first_axis,
        log_volume = OrthotropicAxes::history_size,
        first_strain, ///< along the axes: aa, bb, cc, ab, bc, ca (tensor strains)
        history_size = first_strain + 6
    };
    std::array<double, history_size> initial_history() const { return {}; }

    static Honeycomb from_record(const Record& record, const Model& model);

    template <class Lane>
    void rotate_history(HistoryView<Lane> history, const Tensor3<Lane>& rotation) const
    {
        turn_axes(history.values, rotation);
    }

    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history) const
    {
        const Lane* e = history.values + first_strain;
        const Lane pulled = max(e[0], max(e[1], e[2]));
        const Lane sheared = 2.0 * max(abs(e[3]), max(abs(e[4]), abs(e[5])));
        return max(Lane{pulled - tensile_failure}, Lane{sheared - shear_failure}) >= 0.0;
    }

    /// One step at a batch of solid points; see materials/history.h.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double time_step) const
    {
        const Tensor3<Lane> local = stored_axes(history.values);
        const SymmetricTensor<Lane> before = rotated(stress, local), strain = rotated(increment, local);
        const Lane logarithm = history[log_volume] + trace(increment);
        history[log_volume] = logarithm;
        const Lane closed = 1.0 - exp(logarithm), one = broadcast<Lane>(1);
        const Lane share = min(max(closed * (1 / (1 - compacted_volume)), Lane{}), one);
        const Lane factor =
            rate_dependent && time_step > 0 ? rate_factor(rate_of(increment, time_step)) : one;

        const std::array<Lane, 6> old{before.xx, before.yy, before.zz, before.xy, before.yz, before.zx};
        const std::array<Lane, 6> more{strain.xx, strain.yy, strain.zz, strain.xy, strain.yz, strain.zx};
        std::array<Lane, 6> now;
        const double twice_shear = young_modulus / (1 + poisson_ratio);
        for (int i = 0; i < 6; ++i) {
            history[first_strain + i] += more[i];
            const double whole = i < 3 ? young_modulus : twice_shear;
            const Lane modulus = uncompacted[i] + share * (whole - uncompacted[i]);
            const Lane limit = factor * max(strength[i](closed), Lane{});
            now[i] = min(max(Lane{old[i] + modulus * more[i]}, Lane{-limit}), limit);
        }
        SymmetricTensor<Lane> result = tensor_at(now.data());
        const MaskOf<Lane> solid = closed > 1 - compacted_volume;
        if (any(solid)) {
            const SymmetricTensor<Lane> dense = compacted(before, strain);
            Lane* parts[6] = {&result.xx, &result.yy, &result.zz, &result.xy, &result.yz, &result.zx};
            const Lane other[6] = {dense.xx, dense.yy, dense.zz, dense.xy, dense.yz, dense.zx};
            for (int i = 0; i < 6; ++i) *parts[i] = solid ? other[i] : *parts[i];
        }
        stress = rotated(result, transposed(local));
    }

private:
    /// sqrt(2/3 e' : e') [1/time]
    template <class Lane>
    static Lane rate_of(const SymmetricTensor<Lane>& increment, double time_step)
    {
        const SymmetricTensor<Lane> shear = deviator(increment);
        return sqrt(Lane{(2.0 / 3) * contract(shear, shear)}) * (1 / time_step);
    }

    /// The solid of the cell walls: radial return to SIGY.
    template <class Lane>
    SymmetricTensor<Lane> compacted(const SymmetricTensor<Lane>& before,
                                    const SymmetricTensor<Lane>& strain) const
    {
        const double twice_shear = young_modulus / (1 + poisson_ratio);
        const double bulk = young_modulus / (3 * (1 - 2 * poisson_ratio));
        const Lane mean = (1.0 / 3) * trace(before) + bulk * trace(strain);
        SymmetricTensor<Lane> shear = deviator(before) + broadcast<Lane>(twice_shear) * deviator(strain);
        const Lane equivalent = sqrt(Lane{1.5 * contract(shear, shear)});
        const Lane scale = equivalent > yield_stress ? yield_stress / max(equivalent, broadcast<Lane>(1e-300))
                                                     : broadcast<Lane>(1);
        shear = scale * shear;
        return {shear.xx + mean, shear.yy + mean, shear.zz + mean, shear.xy, shear.yz, shear.zx};
    }
};

} // namespace plash
