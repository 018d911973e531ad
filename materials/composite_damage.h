#pragma once

#include "materials/orthotropic_ply.h"

#include <limits>

namespace plash {

/// *MAT_COMPOSITE_DAMAGE (022) and *MAT_ENHANCED_COMPOSITE_DAMAGE (054/055): a ply that loses moduli when the
/// criteria of Chang & Chang (1987), or for CRIT = 55 that of Tsai & Wu (1971) for the matrix, are met.
/// Sources: Hallquist (2006), material models 22 and 54-55; keyword manual, volume II; the meaning of a
/// criterion that is met, no more stress but one that stays, is that of Wade, Feraboli & Osborne (2012, FAA
/// JAMS technical review). When the strain goes back, so does the stress, elastically: one that stayed then
/// would do work without end. A ply whose fibres break in tension (DFAILT = 0), or whose strains pass the
/// DFAIL limits, carries nothing any more.
struct CompositeDamage {
    enum class Rule { composite_damage, chang, tsai_wu };

    OrthotropicPlane plane;
    Rule rule = Rule::chang;
    double xt = 0, xc = 0, yt = 0, yc = 0, sc = 0; ///< strengths; 0: never reached [stress]
    double alpha = 0;                              ///< ALPH: nonlinear shear [1/stress^3]
    double beta = 0;                               ///< BETA: share of shear in fibre tension
    double fiber_reduction = 0;                    ///< FBRT: factor on XT once the matrix has failed; 0: none
    double compression_factor =
        2;                     ///< YCFAC: XC becomes this times YC once the matrix has failed in compression
    double tension_strain = 0; ///< DFAILT > 0: strain along a at which the ply fails, also as `limited`
    double compression_strain = 0; ///< DFAILC < 0
    double matrix_strain = 0;      ///< DFAILM
    double shear_strain = 0;       ///< DFAILS
    double effective_strain = 0;   ///< EFS

    enum History {
        strain_a,
        strain_b,
        strain_ab,
        fiber,
        fiber_compressed,
        matrix,
        sound,
        held_a, ///< size of the stress at which a direction has failed; it bears no more, either way
        held_b,
        held_ab,
        history_size
    };
    /// Flags are 1 while something holds.
    std::array<double, history_size> initial_history() const { return {0, 0, 0, 1, 1, 1, 1, 0, 0, 0}; }
    double density() const { return plane.density; }
    double largest_modulus() const { return plane.largest_modulus(); }

    static CompositeDamage from_record(const Record& record, const Model& model);

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
        history[strain_a] += increment.xx;
        history[strain_b] += increment.yy;
        history[strain_ab] += 2.0 * increment.xy;

        // Poisson's ratios go with the first of the two directions. What has failed bears the stress that it
        // failed at and no more; taken back it gives way elastically, else it would push or pull for ever.
        const MaskOf<Lane> along = history[fiber] * history[fiber_compressed] > 0.0;
        const MaskOf<Lane> across = history[fiber] * history[matrix] > 0.0;
        const MaskOf<Lane> both = along & across;
        const Lane qa = both ? broadcast<Lane>(plane.plane_a()) : broadcast<Lane>(plane.ea);
        const Lane qb = both ? broadcast<Lane>(plane.plane_b()) : broadcast<Lane>(plane.eb);
        const Lane qab = both ? broadcast<Lane>(plane.plane_ab()) : Lane{};
        // 2 eps_ab = tau / G + alpha tau^3
        const Lane shear = plane.gab / (1.0 + (3 * alpha * plane.gab) * stress.xy * stress.xy);
        stress.xx += qa * increment.xx + qab * increment.yy;
        stress.yy += qab * increment.xx + qb * increment.yy;
        stress.xy += 2.0 * shear * increment.xy;
        stress.yz += (2 * plane.gbc) * increment.yz;
        stress.zx += (2 * plane.gca) * increment.zx;
        const auto limited = [](const MaskOf<Lane>& holds, const Lane& value, const Lane& held) {
            return holds ? value : min(max(value, Lane{-held}), held);
        };
        stress.xx = limited(along, stress.xx, history[held_a]);
        stress.yy = limited(across, stress.yy, history[held_b]);
        stress.xy = limited(across, stress.xy, history[held_ab]);

        judge(stress, history);
        const MaskOf<Lane> fails_along =
            along & MaskOf<Lane>(history[fiber] * history[fiber_compressed] == 0.0);
        const MaskOf<Lane> fails_across = across & MaskOf<Lane>(history[fiber] * history[matrix] == 0.0);
        history[held_a] = fails_along ? abs(stress.xx) : history[held_a];
        history[held_b] = fails_across ? abs(stress.yy) : history[held_b];
        history[held_ab] = fails_across ? abs(stress.xy) : history[held_ab];
        const Lane keep = history[sound];
        for (Lane* component : {&stress.xx, &stress.yy, &stress.xy, &stress.yz, &stress.zx}) {
            *component = keep > 0.0 ? *component : Lane{};
        }
    }

private:
    /// Ratio of the shear energies at tau and at the strength; tau^2 / SC^2 without nonlinear shear.
    template <class Lane>
    Lane shear_ratio(const Lane& shear) const
    {
        if (!(sc > 0)) return Lane{};
        const double strength = 1 / (2 * plane.gab) + 0.75 * alpha * sc * sc;
        const Lane square = shear * shear;
        return square * (1 / (2 * plane.gab) + 0.75 * alpha * square) / (sc * sc * strength);
    }

    template <class Lane>
    void judge(const SymmetricTensor<Lane>& stress, HistoryView<Lane> history) const
    {
        const Lane zero{};
        const auto squared = [](const Lane& value, double strength) {
            return strength > 0 ? value * value * (1 / (strength * strength)) : Lane{};
        };
        const Lane shear = shear_ratio(stress.xy);
        const MaskOf<Lane> matrix_gone = history[matrix] == 0.0;

        // Fibres in tension and compression.
        Lane tension = squared(stress.xx, xt);
        if (fiber_reduction > 0) {
            tension = matrix_gone ? tension * (1 / (fiber_reduction * fiber_reduction)) : tension;
        }
        tension += (rule == Rule::composite_damage ? 1.0 : beta) * shear;
        const MaskOf<Lane> torn =
            (stress.xx > zero) & (tension >= 1.0) & MaskOf<Lane>(xt > 0 ? shear >= zero : shear < zero);
        if (rule != Rule::composite_damage && xc > 0) {
            Lane compression = squared(stress.xx, xc);
            if (compression_factor > 0 && yc > 0) {
                compression = matrix_gone ? squared(stress.xx, compression_factor * yc) : compression;
            }
            const MaskOf<Lane> crushed = (stress.xx < zero) & (compression >= 1.0);
            history[fiber_compressed] = crushed ? zero : history[fiber_compressed];
        }

        // Matrix.
        Lane criterion;
        if (rule == Rule::tsai_wu && yt > 0 && yc > 0) {
            criterion = stress.yy * stress.yy * (1 / (yc * yt)) + shear + ((yc - yt) / (yc * yt)) * stress.yy;
        } else {
            const double twice = 2 * sc;
            const Lane compressed =
                squared(stress.yy, twice) +
                (yc > 0 && twice > 0 ? ((yc / twice) * (yc / twice) - 1) / yc : 0.0) * stress.yy + shear;
            const Lane pulled = squared(stress.yy, yt) + shear;
            criterion = stress.yy >= zero ? pulled : compressed;
        }
        history[matrix] = criterion >= 1.0 ? zero : history[matrix];

        // Loss of the ply.
        MaskOf<Lane> gone = torn;
        if (tension_strain > 0) {
            history[fiber] = torn ? zero : history[fiber];
            gone = history[strain_a] >= tension_strain;
        }
        if (compression_strain < 0) gone = gone | (history[strain_a] <= compression_strain);
        if (matrix_strain > 0) gone = gone | (abs(history[strain_b]) >= matrix_strain);
        if (shear_strain > 0) gone = gone | (abs(history[strain_ab]) >= shear_strain);
        if (effective_strain > 0) {
            const Lane a = history[strain_a], b = history[strain_b], ab = 0.5 * history[strain_ab];
            const Lane square = (4.0 / 3) * (a * a + a * b + b * b + ab * ab);
            gone = gone | (square >= effective_strain * effective_strain);
        }
        history[sound] = gone ? zero : history[sound];
    }
};

} // namespace plash
