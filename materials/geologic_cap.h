#pragma once

#include "materials/history.h"
#include "materials/parameters.h"
#include "materials/von_mises.h"
#include "math/lanes_math.h"
#include "math/symmetric_tensor.h"

#include <array>

namespace plash {

/// *MAT_GEOLOGIC_CAP_MODEL (025): soils, rocks and concrete with two invariants, J1 (trace of the stress,
/// compression positive) and r = sqrt(J2) of the deviator; associated flow on three surfaces:
///   failure envelope  r = Fe(J1) = ALPHA - GAMMA exp(-BETA J1) + THETA J1
///   cap               r = 1/R sqrt((X - L)^2 - (J1 - L)^2) for J1 >= L = max(kappa, 0), X = kappa + R
///   Fe(kappa) tension           J1 = TOFF
/// The cap moves with the plastic compaction e = W (1 - exp(-D (X - X0))); dilatancy on the envelope draws it
/// back (FTYPE 1, soil), though never past the stress, or leaves it (FTYPE 2, rock).
/// Sources: Sandler & Rubin (1979), Int. J. Numer. Anal. Meth. Geomech. 3, 173-186; Simo, Ju, Pister & Taylor
/// (1988), J. Eng. Mech. 114, 191-218; Hallquist (2006), LS-DYNA theory manual, material model 25. Returns
/// are closest points, solved to round-off. Without the kinematic hardening of the envelope (C, N).
struct GeologicCap {
    double density = 0;       ///< [mass/volume]
    double bulk_modulus = 0;  ///< [stress]
    double shear_modulus = 0; ///< [stress]
    double young_modulus = 0; ///< of both [stress]
    double poisson_ratio = 0;
    double alpha = 0, theta = 0, gamma = 0, beta = 0; ///< failure envelope
    double ratio = 1;                                 ///< R of the cap's axes
    double d = 0;                                     ///< D [1/stress]
    double w = 0;                                     ///< W: largest plastic compaction
    double x0 = 0;                                    ///< X0 [stress]
    double tension = 0;                               ///< TOFF, J1 in tension, negative [stress]
    double first_kappa = 0;                           ///< where X = X0 [stress]
    bool contracts = true;                            ///< FTYPE 1

    /// What is kept beside kappa for the results (PLOT).
    enum class Shown { kappa, cap, compaction, first_invariant, second_invariant };
    Shown shown = Shown::kappa;

    enum History { plotted, kappa, history_size };
    static constexpr int plastic_strain = plotted; ///< what LS-DYNA shows in its place
    std::array<double, history_size> initial_history() const { return {0, first_kappa}; }

    static GeologicCap from_record(const Record& record, const Model& model);

    template <class Lane>
    Lane envelope(const Lane& j1) const
    {
        return alpha + theta * j1 - gamma * exp(Lane{-beta * j1});
    }
    /// J1 at which the cap ends.
    double cap_end(double k) const { return k + ratio * envelope(k); }
    /// Plastic compaction that belongs to kappa.
    double compaction(double k) const;

    /// One step at a batch of solid points; see materials/history.h.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                HistoryView<Lane> history, double /*time_step*/) const
    {
        add_elastic_stress(stress, increment, shear_modulus, bulk_modulus - 2.0 / 3 * shear_modulus);
        const SymmetricTensor<Lane> shear = deviator(stress);
        const Lane j1 = -trace(stress), square = 0.5 * contract(shear, shear);
        // Outside of the elastic range: above the envelope, past the cap, or in tension. With L >= J1 the cap
        // bounds nothing.
        const Lane k = history[kappa], centre = max(k, Lane{}), past = max(Lane{j1 - centre}, Lane{});
        const Lane reach = k + ratio * envelope(k) - centre, height = max(envelope(j1), Lane{});
        const Lane over_cap = past > 0.0 ? past * past + ratio * ratio * square - reach * reach : Lane{};
        const Lane outside = max(max(Lane{square - height * height}, over_cap), Lane{tension - j1});
        if (any(outside > 0.0)) {
            for (int lane = 0; lane < lanes_in<Lane>; ++lane) {
                if (lane_of(outside, lane) > 0) come_back(stress, history[kappa], lane);
            }
        }
        show(stress, history);
    }

private:
    /// Invariants of a point on its way back.
    struct Invariants {
        double j1, r, kappa;
    };

    Invariants returned(Invariants trial) const;
    Invariants to_envelope(const Invariants& trial) const;
    Invariants to_cap(const Invariants& trial) const;
    double contracted(double old_kappa, double dilation, double j1) const;

    template <class Lane>
    void come_back(SymmetricTensor<Lane>& stress, Lane& kappa_lanes, int lane) const
    {
        Lane* parts[6] = {&stress.xx, &stress.yy, &stress.zz, &stress.xy, &stress.yz, &stress.zx};
        double s[6];
        for (int i = 0; i < 6; ++i) s[i] = lane_of(*parts[i], lane);
        const double j1 = -(s[0] + s[1] + s[2]);
        for (int i = 0; i < 3; ++i) s[i] += j1 / 3;
        const double r = std::sqrt(0.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) + s[3] * s[3] +
                                   s[4] * s[4] + s[5] * s[5]);
        const Invariants end = returned({j1, r, lane_of(kappa_lanes, lane)});
        const double scale = r > 0 ? end.r / r : 0;
        for (int i = 0; i < 6; ++i) set_lane(*parts[i], lane, scale * s[i] - (i < 3 ? end.j1 / 3 : 0));
        set_lane(kappa_lanes, lane, end.kappa);
    }

    template <class Lane>
    void show(const SymmetricTensor<Lane>& stress, HistoryView<Lane> history) const
    {
        const SymmetricTensor<Lane> shear = deviator(stress);
        switch (shown) {
        case Shown::kappa:
            history[plotted] = history[kappa];
            break;
        case Shown::cap:
            history[plotted] = history[kappa] + ratio * envelope(history[kappa]);
            break;
        case Shown::compaction:
            history[plotted] = map_lanes(history[kappa], [&](double k) { return compaction(k); });
            break;
        case Shown::first_invariant:
            history[plotted] = -trace(stress);
            break;
        case Shown::second_invariant:
            history[plotted] = sqrt(Lane{0.5 * contract(shear, shear)});
            break;
        }
    }
};

} // namespace plash
