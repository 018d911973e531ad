#pragma once

#include "materials/orthotropic_ply.h"

namespace plash {

/// *MAT_FABRIC (034) with constant moduli (FORM 0, 1 and 12): orthotropic elastic in plane stress; isotropic
/// when EB and GAB are left empty. With CSE = 1 it carries no compression: the elastic stress is remembered,
/// and what acts are its principal values where they are positive, so that a wrinkled fabric takes load again
/// when it is taut. The share LRATIO of the thickness may be a liner, isotropic elastic (EL, PRL), that bears
/// compression as it does tension. Source: keyword manual, volume II.
struct Fabric {
    OrthotropicPlane plane;
    bool no_compression = false; ///< CSE

    /// A liner bears what the elastic strain of the fabric asks of it: stresses of the liner are those of the
    /// fabric without CSE times this matrix, so that it needs no history of its own.
    struct Liner {
        double share = 0;                       ///< LRATIO [-]; 0: none
        double aa_aa = 0, aa_bb = 0;            ///< stress along a by the fabric's along a, b [-]
        double bb_aa = 0, bb_bb = 0, ab_ab = 0; ///< along b, and in shear [-]
        double plane_modulus = 0;               ///< EL / (1 - PRL^2) [stress]
    };
    Liner liner;

    enum History { elastic_aa, elastic_bb, elastic_ab, history_size };
    std::array<double, history_size> initial_history() const { return {}; }
    double density() const { return plane.density; }
    double largest_modulus() const
    {
        return (1 - liner.share) * plane.largest_modulus() + liner.share * liner.plane_modulus;
    }

    static Fabric from_record(const Record& record, const Model& model);

    /// One step; stress and increment in the axes of the ply, zz is left to the caller.
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane> history, double) const
    {
        const Lane a = history[elastic_aa] +=
            plane.plane_a() * increment.xx + plane.plane_ab() * increment.yy;
        const Lane b = history[elastic_bb] +=
            plane.plane_ab() * increment.xx + plane.plane_b() * increment.yy;
        const Lane ab = history[elastic_ab] += 2 * plane.gab * increment.xy;
        stress.yz += 2 * plane.gbc * increment.yz;
        stress.zx += 2 * plane.gca * increment.zx;
        stress.xx = a;
        stress.yy = b;
        stress.xy = ab;
        if (no_compression) drop_compression(stress);
        if (!(liner.share > 0)) return;
        const double fabric = 1 - liner.share;
        stress.xx = fabric * stress.xx + liner.share * (liner.aa_aa * a + liner.aa_bb * b);
        stress.yy = fabric * stress.yy + liner.share * (liner.bb_aa * a + liner.bb_bb * b);
        stress.xy = fabric * stress.xy + liner.share * liner.ab_ab * ab;
    }

private:
    /// Principal values below zero go.
    template <class Lane>
    static void drop_compression(SymmetricTensor<Lane>& stress)
    {
        // Mohr's circle: centre and radius; the part of each principal stress below zero goes.
        const Lane zero{};
        const Lane ab = stress.xy;
        const Lane centre = 0.5 * (stress.xx + stress.yy), half = 0.5 * (stress.xx - stress.yy);
        const Lane radius = sqrt(half * half + ab * ab);
        const Lane first = max(centre + radius, zero), second = max(centre - radius, zero);
        const Lane new_centre = 0.5 * (first + second);
        const Lane share = 0.5 * (first - second) / max(radius, broadcast<Lane>(1e-300));
        stress.xx = new_centre + share * half;
        stress.yy = new_centre - share * half;
        stress.xy = share * ab;
    }
};

} // namespace plash
