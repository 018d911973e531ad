#pragma once

#include "materials/hardening.h"
#include "materials/history.h"
#include "materials/plastic_return.h"
#include "materials/von_mises.h"
#include "model/model.h"

#include <array>

namespace plash {

/// Sheets with Hill's (1948) yield condition in plane stress, given by Lankford's ratios of width to
/// thickness strain under tension along and at 45 and 90 degrees to the rolling direction a:
///   q^2 = s_a^2 + b s_b^2 - 2 c s_a s_b + d s_ab^2,
///   c = R00 / (1 + R00), b = R00 (1 + R90) / (R90 (1 + R00)), d = (1 + 2 R45) (R00 + R90) / (R90 (1 + R00)),
/// so that q is the stress of tension along a; isotropic hardening, associated flow. Transverse shears are
/// elastic.
///   *MAT_HILL_3R (122)                                     R00, R45, R90; HR 1: P2 and the tangent modulus
///   P1,
///                                                          2: P1 (E0 + p)^P2, 3: LCID
///   *MAT_TRANSVERSELY_ANISOTROPIC_ELASTIC_PLASTIC (037)    all three ratios |R|; SIGY and ETAN, or HLCID
/// Sources: Hill (1948), Proc. R. Soc. Lond. A 193, 281-297; keyword manual, volume II. The return is that of
/// the closest point, solved to round-off.
struct HillSheet {
    double density_value = 0; ///< [mass/volume]
    double young_modulus = 0; ///< [stress]
    double poisson_ratio = 0;
    double b = 1, c = 0.5, d = 3; ///< of the yield condition
    Hardening hardening;          ///< stress along a over plastic strain

    enum History { plastic_strain, history_size };
    std::array<double, history_size> initial_history() const { return {}; }
    double density() const { return density_value; }
    double largest_modulus() const { return young_modulus / (1 - poisson_ratio * poisson_ratio); }

    static HillSheet from_record(const Record& record, const Model& model);

    /// Sets b, c and d.
    void set_ratios(double r00, double r45, double r90);

    /// One step; stress and increment in the axes of the sheet; increment.zz comes back.
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane> history, double) const
    {
        const Lane sum_before = stress.xx + stress.yy;
        add_plane_elastic_stress(stress, increment, young_modulus, poisson_ratio);
        const InPlane<Lane> trial{stress.xx, stress.yy, stress.xy};
        const Lane strain = history[plastic_strain], square = square_of(trial);
        const Lane bound = hardening(strain, Lane{}).stress;
        const MaskOf<Lane> yielding = square > bound * bound;
        Lane thinning{};
        if (any(yielding)) {
            const auto at = [&](const Lane& m) {
                const InPlane<Lane> s = shrunk(trial, m);
                const Lane q_square = square_of(s), q = sqrt(q_square);
                const InPlane<Lane> n = gradient(s), fall = shrunk(stiffened(n), m);
                // dq/dm q = -n . (1 + m C P)^-1 C n
                const Lane q_rate = -(n.a * fall.a + n.b * fall.b + n.ab * fall.ab);
                const auto value = hardening(strain + m * q, Lane{});
                return ReturnPoint<Lane>{
                    q, q_rate, Lane{m * q}, Lane{q_square + m * q_rate}, value.stress, value.slope};
            };
            const Lane q = max(sqrt(square), broadcast<Lane>(1e-300));
            const Lane start = (q - bound) / (q * (young_modulus * std::max(1.0, b)));
            Lane m = return_parameter<Lane>(yielding, start, at);
            m = yielding ? m : Lane{};
            const InPlane<Lane> end = shrunk(trial, m), n = gradient(end);
            stress.xx = end.a;
            stress.yy = end.b;
            stress.xy = end.ab;
            history[plastic_strain] += m * sqrt(square_of(end));
            thinning = m * (n.a + n.b);
        }
        increment.zz = -poisson_ratio / young_modulus * (stress.xx + stress.yy - sum_before) - thinning;
    }

private:
    /// Stresses, or twice the strains of their kind, in the plane.
    template <class Lane>
    struct InPlane {
        Lane a, b, ab;
    };

    template <class Lane>
    Lane square_of(const InPlane<Lane>& s) const
    {
        return s.a * s.a + b * s.b * s.b - (2 * c) * s.a * s.b + d * s.ab * s.ab;
    }

    /// P s, half of the derivatives of q^2; the last is by the shear stress, an engineering strain.
    template <class Lane>
    InPlane<Lane> gradient(const InPlane<Lane>& s) const
    {
        return {s.a - c * s.b, b * s.b - c * s.a, d * s.ab};
    }

    /// C e: stresses of strains.
    template <class Lane>
    InPlane<Lane> stiffened(const InPlane<Lane>& e) const
    {
        const double plane = largest_modulus(), shear = young_modulus / (2 * (1 + poisson_ratio));
        return {plane * (e.a + poisson_ratio * e.b), plane * (e.b + poisson_ratio * e.a), shear * e.ab};
    }

    /// (1 + m C P)^-1 s
    template <class Lane>
    InPlane<Lane> shrunk(const InPlane<Lane>& s, const Lane& m) const
    {
        const double plane = largest_modulus(), shear = young_modulus / (2 * (1 + poisson_ratio));
        const double nu = poisson_ratio;
        const Lane aa = 1.0 + m * (plane * (1 - nu * c)), ab = m * (plane * (nu * b - c));
        const Lane ba = m * (plane * (nu - c)), bb = 1.0 + m * (plane * (b - nu * c));
        const Lane per = 1.0 / (aa * bb - ab * ba);
        return {per * (bb * s.a - ab * s.b), per * (aa * s.b - ba * s.a), s.ab / (1.0 + m * (shear * d))};
    }
};

} // namespace plash
