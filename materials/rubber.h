#pragma once

#include "materials/history.h"
#include "materials/left_cauchy_green.h"
#include "materials/maxwell.h"
#include "materials/principal_axes.h"
#include "materials/rubber_energy.h"
#include "model/model.h"

#include <array>

namespace plash {

/// Nearly incompressible rubber with the strain energy by reference volume
///   W = energy of the stretches without volume change + K (J - 1 - ln J),
/// and a Prony series of up to `branches` Maxwell elements that act on the deviator of the strain rate
/// besides
/// (*MAT_OGDEN_RUBBER 077_O, *MAT_HYPERELASTIC_RUBBER 077_H). K follows from the shear modulus at small
/// strains and PR. Sources: Ogden (1984), Non-linear Elastic Deformations; Hallquist (2006), LS-DYNA theory
/// manual, material model 77.
template <class Energy, int branches>
struct Rubber {
    double density = 0; ///< [mass/volume]
    double poisson_ratio = 0;
    double bulk_modulus = 0; ///< K [stress]
    Energy energy;
    std::array<MaxwellElement, branches> series{};

    enum History { history_size = 6 * branches }; ///< stresses of the branches [stress]

    template <class Lane>
    void rotate_history(HistoryView<Lane> history, const Tensor3<Lane>& rotation) const
    {
        for (int i = 0; i < branches; ++i) put(history, i, rotated(branch(history, i), rotation));
    }

    /// What the energy answers to a deformation gradient.
    template <class Lane>
    struct Stretches {
        PrincipalAxes<Lane> axes;
        PrincipalResponse<Lane> response; ///< to the principal stretches without volume change
        Lane inverse_volume;              ///< 1 / J
    };
    template <class Lane>
    Stretches<Lane> stretches(const Tensor3<Lane>& deformation) const
    {
        Stretches<Lane> at{principal_axes(left_cauchy_green(deformation).left), {}, {}};
        std::array<Lane, 3> logarithm;
        Lane sum{};
        for (int i = 0; i < 3; ++i) {
            logarithm[i] = 0.5 * log(max(at.axes.value[i], broadcast<Lane>(1e-300)));
            sum += logarithm[i];
        }
        for (Lane& value : logarithm) value -= (1.0 / 3) * sum;
        at.response = energy.response(logarithm);
        at.inverse_volume = 1.0 / determinant(deformation);
        return at;
    }

    /// Cauchy stress at the end of a step.
    /// stress     out [stress]
    /// increment  strain of the step [-]
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const Stretches<Lane>& at,
                const SymmetricTensor<Lane>& increment, HistoryView<Lane> history, double time_step) const
    {
        stress = elastic_stress(at);
        const SymmetricTensor<Lane> change = deviator(increment);
        for (int i = 0; i < branches; ++i) {
            const auto factors = series[i].step(time_step);
            const SymmetricTensor<Lane> now =
                broadcast<Lane>(factors.keep) * branch(history, i) + broadcast<Lane>(factors.gain) * change;
            put(history, i, now);
            stress = stress + now;
        }
    }

    /// Cauchy stress without the branches [stress].
    template <class Lane>
    SymmetricTensor<Lane> elastic_stress(const Stretches<Lane>& at) const
    {
        const Lane mean = bulk_modulus * (1.0 - at.inverse_volume);
        PrincipalAxes<Lane> principal = at.axes;
        for (int i = 0; i < 3; ++i) principal.value[i] = at.inverse_volume * at.response.stress[i] + mean;
        return principal.tensor();
    }

    /// Density times the square of the speed of the fastest compression wave along a principal direction:
    /// lambda^2 / J d2W/dlambda^2 of the largest, and the springs of the branches [stress].
    template <class Lane>
    Lane wave_modulus(const Stretches<Lane>& at) const
    {
        const PrincipalResponse<Lane>& response = at.response;
        Lane largest{};
        for (int i = 0; i < 3; ++i) {
            largest = max(largest, Lane{(response.stiffness[i] - response.stress[i] + bulk_modulus) *
                                        at.inverse_volume});
        }
        double springs = 0;
        for (const MaxwellElement& element : series) springs += 4.0 / 3 * element.modulus;
        return largest + springs;
    }

private:
    template <class Lane>
    static SymmetricTensor<Lane> branch(HistoryView<Lane> h, int number)
    {
        return tensor_at(&h[6 * number]);
    }

    template <class Lane>
    static void put(HistoryView<Lane> h, int number, const SymmetricTensor<Lane>& s)
    {
        put_tensor(&h[6 * number], s);
    }
};

inline constexpr int most_rubber_branches = 6;

/// The constants of the cards; DeckError for what is not supported (fits to tests, PR below zero).
Rubber<OgdenEnergy, most_rubber_branches> ogden_rubber(const Record&);
Rubber<PolynomialEnergy, most_rubber_branches> polynomial_rubber(const Record&, const Model&);

} // namespace plash
