#pragma once

#include "materials/low_density_foam.h"
#include "math/tensor3.h"

namespace plash {

/// *MAT_FU_CHANG_FOAM (083) with the curves of TBID: the foam of 057 whose loading curve depends on the
/// strain rate. Where the strain falls the curve of the lowest rate holds (HU = 0), or it is scaled by the
/// damage (1 - HU)(1 - (W / Wmax)^SHAPE)^EXPON with EXPON = 1 (HU > 0). Source: LS-DYNA keyword manual,
/// volume II, *MAT_083; Chang, Song, Sakai & others (1994). The strain rate is a mean that fades over some
/// twelve steps.
struct FuChangFoam {
    /// RFLAG: whose rate counts in a principal direction.
    enum class Measure { largest, own, volume };

    LowDensityFoam foam;
    double density = 0; ///< [mass/volume]
    Measure measure = Measure::largest;
    bool nominal = false; ///< SFLAG = 1: rates of 1 - stretch, not of its logarithm

    enum History { mean_rate = LowDensityFoam::history_size, history_size = mean_rate + 6 };

    static FuChangFoam from_record(const Record& record, const Model& model);

    template <class Lane>
    void rotate_history(HistoryView<Lane> history, const Tensor3<Lane>& rotation) const
    {
        put(history, rotated(rate_of(history), rotation));
    }

    template <class Lane>
    static LowDensityFoam::Stretches<Lane> stretches(const Tensor3<Lane>& deformation)
    {
        return LowDensityFoam::stretches(deformation);
    }

    /// Cauchy stress at the end of a step.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const LowDensityFoam::Stretches<Lane>& at,
                const SymmetricTensor<Lane>& increment, HistoryView<Lane> history, double time_step) const
    {
        SymmetricTensor<Lane> mean = rate_of(history);
        if (time_step > 0) {
            constexpr double share = 1.0 / 12;
            mean = broadcast<Lane>(1 - share) * mean + broadcast<Lane>(share / time_step) * increment;
            put(history, mean);
        }
        const Lane largest = measure == Measure::largest ? -smallest_principal(mean) : Lane{};
        foam.respond(stress, at, history, [&](const Vector3<Lane>& axis, const Lane& stretch) {
            Lane rate = measure == Measure::volume ? -trace(mean) : largest;
            if (measure == Measure::own) {
                const Vector3<Lane> along{mean.xx * axis.x + mean.xy * axis.y + mean.zx * axis.z,
                                          mean.xy * axis.x + mean.yy * axis.y + mean.yz * axis.z,
                                          mean.zx * axis.x + mean.yz * axis.y + mean.zz * axis.z};
                rate = -dot(axis, along);
            }
            return nominal ? Lane{rate * stretch} : rate;
        });
    }

    template <class Lane>
    Lane wave_modulus(const LowDensityFoam::Stretches<Lane>& at) const
    {
        return foam.wave_modulus(at);
    }

private:
    template <class Lane>
    static Lane smallest_principal(const SymmetricTensor<Lane>& t)
    {
        const auto values = principal_axes(t).value;
        return min(values[0], min(values[1], values[2]));
    }

    template <class Lane>
    static SymmetricTensor<Lane> rate_of(HistoryView<Lane> h)
    {
        return {h[mean_rate],     h[mean_rate + 1], h[mean_rate + 2],
                h[mean_rate + 3], h[mean_rate + 4], h[mean_rate + 5]};
    }

    template <class Lane>
    static void put(HistoryView<Lane> h, const SymmetricTensor<Lane>& s)
    {
        const Lane values[6] = {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx};
        for (int i = 0; i < 6; ++i) h[mean_rate + i] = values[i];
    }
};

} // namespace plash
