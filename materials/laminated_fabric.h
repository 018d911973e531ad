#pragma once

#include "materials/orthotropic_ply.h"

#include "math/lanes_math.h"

namespace plash {

/// *MAT_LAMINATED_COMPOSITE_FABRIC (058) with the faceted failure surface (FS = -1): moduli that fall with
/// the largest strain so far, 1 - w = exp(-(1 / (m e)) (eps / eps_f)^m), so that the stress has its largest
/// value, the strength X, at the strain E11T (and so on); eps_f = X / E, m = 1 / ln(E eps_X / X). Tension,
/// compression and shear have damages of their own. Source: Matzenmiller, Lubliner & Taylor (1995, Mech.
/// Mater. 20, 125-152), keyword manual, volume II.
struct LaminatedFabric {
    /// One direction: strain scale, exponent and the least share of the modulus after the strength is passed.
    struct Damage {
        double strain = 0;   ///< eps_f; 0: no damage
        double exponent = 1; ///< m
        double lowest = 0;   ///< SLIM X / E: stress over modulus that stays behind the peak
        double peak = 0;     ///< strain at the strength
    };
    OrthotropicPlane plane;
    Damage tension_a, compression_a, tension_b, compression_b, shear;
    double erosion_strain = 0; ///< ERODS; 0: never

    enum History {
        strain_a,
        strain_b,
        strain_ab,
        most_tension_a,
        most_compression_a,
        most_tension_b,
        most_compression_b,
        most_shear,
        sound,
        history_size
    };
    std::array<double, history_size> initial_history() const { return {0, 0, 0, 0, 0, 0, 0, 0, 1}; }
    double density() const { return plane.density; }
    double largest_modulus() const { return plane.largest_modulus(); }

    static LaminatedFabric from_record(const Record& record, const Model& model);

    template <class Lane>
    MaskOf<Lane> failed(HistoryView<Lane> history) const
    {
        return history[sound] == 0.0;
    }

    /// One step; stress and increment in the axes of the ply, zz is left to the caller.
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane> history, double) const
    {
        const Lane zero{};
        const Lane a = history[strain_a] += increment.xx;
        const Lane b = history[strain_b] += increment.yy;
        const Lane ab = history[strain_ab] += 2.0 * increment.xy;
        const Lane whole_a = integrity(tension_a, history[most_tension_a], a, a >= zero);
        const Lane crushed_a = integrity(compression_a, history[most_compression_a], -a, a < zero);
        const Lane whole_b = integrity(tension_b, history[most_tension_b], b, b >= zero);
        const Lane crushed_b = integrity(compression_b, history[most_compression_b], -b, b < zero);
        const Lane sheared = integrity(shear, history[most_shear], abs(ab), abs(ab) >= zero);
        const Lane wa = a >= zero ? whole_a : crushed_a, wb = b >= zero ? whole_b : crushed_b;

        const double poisson = plane.nu_ba * plane.nu_ba * plane.ea / plane.eb;
        const Lane scale = 1.0 / (1.0 - poisson * wa * wb);
        stress.xx = scale * wa * (plane.ea * a + (plane.nu_ba * plane.ea) * wb * b);
        stress.yy = scale * wb * (plane.eb * b + (plane.nu_ba * plane.ea) * wa * a);
        stress.xy = (plane.gab * sheared) * ab;
        stress.yz += (2 * plane.gbc) * increment.yz;
        stress.zx += (2 * plane.gca) * increment.zx;
        if (erosion_strain > 0) {
            const Lane square = effective_ply_strain_square(a, b, ab);
            history[sound] = square >= erosion_strain * erosion_strain ? zero : history[sound];
        }
        clear_lost_ply(stress, history[sound]);
    }

private:
    /// Share of the modulus that is left at a strain of the given sense.
    /// most  largest such strain so far, raised
    template <class Lane>
    static Lane integrity(const Damage& damage, Lane& most, const Lane& strain, const MaskOf<Lane>& acts)
    {
        if (!(damage.strain > 0)) return broadcast<Lane>(1.0);
        most = acts ? max(most, strain) : most;
        const Lane ratio = max(most, broadcast<Lane>(1e-30)) * (1 / damage.strain);
        // exp(-ratio^m / (m e))
        const Lane power = exp(damage.exponent * log(ratio));
        const Lane left = exp((-1 / (damage.exponent * 2.718281828459045)) * power);
        if (!(damage.lowest > 0)) return left;
        const Lane floor = damage.lowest / max(most, broadcast<Lane>(damage.peak));
        return most > damage.peak ? max(left, floor) : left;
    }
};

} // namespace plash
