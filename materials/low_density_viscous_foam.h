#pragma once

#include "materials/low_density_foam.h"
#include "materials/maxwell.h"

namespace plash {

/// *MAT_LOW_DENSITY_VISCOUS_FOAM (073), and 057 with ED: the foam of 057 with Maxwell elements beside it.
/// Each carries a Cauchy stress of its own without lateral coupling, like the foam itself,
///   ds/dt + BETAI s = GI d,   d strain rate, s turned with the material,
/// so that a stretch at a constant logarithmic rate r adds GI r / BETAI (1 - exp(-BETAI t)) along it.
/// Source: Hallquist (2006), LS-DYNA theory manual, material model 73. LS-DYNA integrates along the principal
/// axes of the stretch; this is the same where they do not turn within the material.
template <int branches>
struct LowDensityViscousFoam {
    LowDensityFoam foam;
    std::array<MaxwellElement, branches> series{}; ///< GI as twice their shear modulus, and BETAI
    double density = 0;                            ///< [mass/volume]

    static constexpr int first_branch = LowDensityFoam::history_size;
    static constexpr int history_size = first_branch + 6 * branches;

    template <class Lane>
    void rotate_history(HistoryView<Lane> history, const Tensor3<Lane>& rotation) const
    {
        for (int i = 0; i < branches; ++i) put(history, i, rotated(branch(history, i), rotation));
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
        foam.update(stress, at, increment, history, time_step);
        for (int i = 0; i < branches; ++i) {
            const auto step = series[i].step(time_step);
            const SymmetricTensor<Lane> now =
                broadcast<Lane>(step.keep) * branch(history, i) + broadcast<Lane>(step.gain) * increment;
            put(history, i, now);
            stress = stress + now;
        }
    }

    template <class Lane>
    Lane wave_modulus(const LowDensityFoam::Stretches<Lane>& at) const
    {
        double springs = 0;
        for (const MaxwellElement& element : series) springs += 2 * element.modulus;
        return foam.wave_modulus(at) + springs;
    }

private:
    template <class Lane>
    static SymmetricTensor<Lane> branch(HistoryView<Lane> history, int number)
    {
        const Lane* h = history.values + first_branch + 6 * number;
        return {h[0], h[1], h[2], h[3], h[4], h[5]};
    }

    template <class Lane>
    static void put(HistoryView<Lane> history, int number, const SymmetricTensor<Lane>& s)
    {
        const Lane values[6] = {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx};
        for (int i = 0; i < 6; ++i) history[first_branch + 6 * number + i] = values[i];
    }
};

/// The card of 073 with its rows of GI and BETAI; DeckError for fits to relaxation curves.
LowDensityViscousFoam<6> viscous_foam(const Record& record, const Model& model);

/// ED and BETA1 of 057 beside its foam.
LowDensityViscousFoam<1> relaxing_foam(const Record& record, const Model& model);

} // namespace plash
