#pragma once

#include "materials/hardening.h"
#include "materials/history.h"
#include "materials/left_cauchy_green.h"
#include "materials/principal_axes.h"
#include "math/broken_line.h"
#include "model/model.h"

#include <array>

namespace plash {

/// *MAT_LOW_DENSITY_FOAM (057): the nominal stress in each principal direction depends on the stretch in this
/// direction alone (no lateral strain): the curve over 1 - stretch in compression, E (stretch - 1) in tension
/// up to TC. On the way back compressive stress loses the share
///   d = (1 - HU) (1 - (W / Wmax)^SHAPE)
/// with the energy W that the loading curve gives for the stretches now, and its largest value so far.
/// Sources: Chang, Song, Sakai & others (1994), 'Finite strain formulation for a highly compressible
/// elastomeric foam'; Hallquist (2006), LS-DYNA theory manual, material model 57, which shows the unloading
/// in pictures only; the formula is that of its model 83.
struct LowDensityFoam {
    double density = 0;           ///< [mass/volume]
    double young_modulus = 0;     ///< E, in tension [stress]
    double tensile_cutoff = 1e20; ///< TC: nominal [stress]
    double hysteresis = 1;        ///< HU: 1 unloads as it loads
    double shape = 1;             ///< SHAPE
    bool tears = false;           ///< FAIL = 1: no tension once TC has been reached
    Hardening loading;            ///< nominal stress over 1 - stretch; goes on with its last slope
    BrokenLine slowest;           ///< the loading curve of the lowest rate, from no strain on

    enum History { largest_energy, torn, history_size };

    static LowDensityFoam from_record(const Record& record, const Model& model);

    /// Principal stretches of a deformation gradient.
    template <class Lane>
    struct Stretches {
        PrincipalAxes<Lane> squares; ///< of F F^T
        std::array<Lane, 3> stretch;
        Lane inverse_volume;
    };
    template <class Lane>
    static Stretches<Lane> stretches(const Tensor3<Lane>& deformation)
    {
        Stretches<Lane> at{principal_axes(left_cauchy_green(deformation).left), {}, {}};
        for (int i = 0; i < 3; ++i) at.stretch[i] = sqrt(max(at.squares.value[i], Lane{}));
        at.inverse_volume = 1.0 / determinant(deformation);
        return at;
    }

    /// Cauchy stress at the end of a step.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const Stretches<Lane>& at,
                const SymmetricTensor<Lane>& /*increment*/, HistoryView<Lane> history,
                double /*time_step*/) const
    {
        respond(stress, at, history, [](const Vector3<Lane>&, const Lane&) { return Lane{}; });
    }

    /// The same under a strain rate: rate(axis, stretch) of a principal direction, compression positive
    /// [1/time].
    template <class Lane, class Rate>
    void respond(SymmetricTensor<Lane>& stress, const Stretches<Lane>& at, HistoryView<Lane> history,
                 Rate&& rate) const
    {
        PrincipalAxes<Lane> principal = at.squares;
        const std::array<Lane, 3>& stretch = at.stretch;
        const Lane one = broadcast<Lane>(1);
        Lane left = one;
        if (hysteresis < 1) {
            Lane now{};
            for (const Lane& s : stretch) now += energy(Lane{1.0 - s});
            const Lane most = max(history[largest_energy], now);
            history[largest_energy] = most;
            const Lane share = now / max(most, broadcast<Lane>(1e-300));
            left = now < most ? 1.0 - (1 - hysteresis) * (1.0 - power(share, shape)) : one;
        }
        for (int i = 0; i < 3; ++i) {
            const Lane strain = 1.0 - stretch[i];
            const Lane speed = rate(principal.axis[i], stretch[i]);
            const Lane pressed = left * loading(max(strain, Lane{}), max(speed, Lane{})).stress;
            const Lane pulled = min(-young_modulus * strain, broadcast<Lane>(tensile_cutoff));
            if (tears) {
                history[torn] = -young_modulus * strain >= tensile_cutoff ? one : history[torn];
            }
            const Lane tension = tears ? (history[torn] > 0.0 ? Lane{} : pulled) : pulled;
            const Lane nominal = strain > 0.0 ? -pressed : tension;
            principal.value[i] = nominal * stretch[i] * at.inverse_volume;
        }
        stress = principal.tensor();
    }

    /// Density times the square of the speed of the fastest wave along a principal direction, from above:
    /// also for unloading, which is steeper than loading [stress].
    template <class Lane>
    Lane wave_modulus(const Stretches<Lane>& at) const
    {
        Lane largest{};
        for (int i = 0; i < 3; ++i) {
            const Lane square = at.stretch[i] * at.stretch[i], strain = 1.0 - at.stretch[i];
            const Lane pressed = max(strain, Lane{});
            Lane slope = loading(pressed, Lane{}).slope;
            if (loading.depends_on_rate()) slope = max(slope, loading(pressed, broadcast<Lane>(1e300)).slope);
            if (hysteresis < 1) {
                const Lane whole = energy(strain), stress = loading(pressed, Lane{}).stress;
                const Lane steeper =
                    ((1 - hysteresis) * shape) * stress * stress / max(whole, broadcast<Lane>(1e-300));
                slope += whole > 0.0 ? steeper : Lane{};
            }
            const Lane modulus = max(slope, broadcast<Lane>(young_modulus));
            largest = max(largest, Lane{modulus * square});
        }
        return largest * at.inverse_volume;
    }

    /// Takes the loading curves, the one of the lowest rate for the energy as well; DeckError for negative
    /// points of that curve.
    void set_loading(const Record& record, std::string_view field, Hardening curves,
                     const Curve& slowest_curve);

    /// Energy that the loading curve has taken up at a compressive strain [stress].
    template <class Lane>
    Lane energy(const Lane& strain) const
    {
        return slowest.integral(max(strain, Lane{}));
    }
};

} // namespace plash
