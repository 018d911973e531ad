#pragma once

#include "materials/orthotropic_ply.h"

#include <limits>

namespace plash {

/// *MAT_COMPOSITE_DAMAGE (022) and *MAT_ENHANCED_COMPOSITE_DAMAGE (054/055): a ply whose stresses are limited
/// by the criteria of Chang & Chang (1987), or for CRIT = 55 that of Tsai & Wu (1971) for the matrix.
/// Sources: Hallquist (2006), material models 22 and 54-55; keyword manual, volume II; the meaning of a
/// criterion that is met, no more stress but one that stays, is that of Wade, Feraboli & Osborne (2012, FAA
/// JAMS technical review). The stress is scaled back onto the criterion in every step and unloads
/// elastically, which is what the plies of LS-DYNA's wing (docs/results/wing.md) show: all of 2,400 failed
/// ones lie inside their criterion. A ply whose fibres break in tension (DFAILT = 0), or whose strains pass
/// the DFAIL limits, carries nothing any more.
struct CompositeDamage {
    enum class Rule { composite_damage, chang, tsai_wu };

    OrthotropicPlane plane;
    Rule rule = Rule::chang;
    double xt = 0, xc = 0, yt = 0, yc = 0, sc = 0; ///< strengths; 0: never reached [stress]
    double alpha = 0;                              ///< ALPH: nonlinear shear [1/stress^3]
    double beta = 0;                               ///< BETA: share of shear in fibre tension
    double fiber_reduction = 0;    ///< FBRT: factor on XT once the matrix has failed in compression; 0: none
    double compression_factor = 2; ///< YCFAC: XC becomes this times YC likewise
    double tension_strain = 0;     ///< DFAILT > 0: strain along a at which the ply fails, also as `limited`
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
        matrix_compressed,
        sound,
        history_size
    };
    /// Flags are 1 while something holds.
    std::array<double, history_size> initial_history() const { return {0, 0, 0, 1, 1, 1, 1, 1}; }

    /// 1 as long as they hold: fibres in tension and in compression, matrix likewise, (5), the whole ply.
    std::vector<ShownVariable> shown_history(bool /*of_shells*/) const
    {
        return {{fiber}, {fiber_compressed}, {matrix}, {matrix_compressed}, {}, {sound}};
    }
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

        // Once something has failed the directions go their own ways, without Poisson's ratios.
        const MaskOf<Lane> whole =
            history[fiber] * history[fiber_compressed] * history[matrix] * history[matrix_compressed] > 0.0;
        const Lane qa = whole ? broadcast<Lane>(plane.plane_a()) : broadcast<Lane>(plane.ea);
        const Lane qb = whole ? broadcast<Lane>(plane.plane_b()) : broadcast<Lane>(plane.eb);
        const Lane qab = whole ? broadcast<Lane>(plane.plane_ab()) : Lane{};
        // 2 eps_ab = tau / G + alpha tau^3
        const Lane shear = plane.gab / (1.0 + (3 * alpha * plane.gab) * stress.xy * stress.xy);
        stress.xx += qa * increment.xx + qab * increment.yy;
        stress.yy += qab * increment.xx + qb * increment.yy;
        stress.xy += 2.0 * shear * increment.xy;
        stress.yz += (2 * plane.gbc) * increment.yz;
        stress.zx += (2 * plane.gca) * increment.zx;
        judge_matrix(stress, history);
        judge_fibers(stress, history);
        judge_strains(history);
        clear_lost_ply(stress, history[sound]);
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
    static Lane squared(const Lane& value, double strength)
    {
        return strength > 0 ? value * value * (1 / (strength * strength)) : Lane{};
    }

    /// Scales the stresses of the matrix back where even * s^2 + odd * s = 1 at s = 1 is passed, and clears
    /// the flag there. With nonlinear shear, whose ratio rises faster than the square, that ends a little
    /// inside.
    template <class Lane>
    static void return_to(const Lane& even, const Lane& odd, const MaskOf<Lane>& acts,
                          SymmetricTensor<Lane>& stress, Lane& holds)
    {
        const MaskOf<Lane> met = acts & (even + odd >= 1.0);
        const Lane scale = 2.0 / (odd + sqrt(odd * odd + 4.0 * max(even, broadcast<Lane>(1e-30))));
        stress.yy = met ? scale * stress.yy : stress.yy;
        stress.xy = met ? scale * stress.xy : stress.xy;
        holds = met ? Lane{} : holds;
    }

    template <class Lane>
    void judge_matrix(SymmetricTensor<Lane>& stress, HistoryView<Lane> history) const
    {
        const Lane zero{}, shear = shear_ratio(stress.xy);
        const MaskOf<Lane> pulled = stress.yy >= zero, pressed = stress.yy < zero;
        if (rule == Rule::tsai_wu && yt > 0 && yc > 0) {
            const Lane even = stress.yy * stress.yy * (1 / (yc * yt)) + shear;
            const Lane odd = ((yc - yt) / (yc * yt)) * stress.yy;
            return_to(even, odd, pulled, stress, history[matrix]);
            return_to(even, odd, pressed, stress, history[matrix_compressed]);
            return;
        }
        return_to(Lane(squared(stress.yy, yt) + shear), zero, pulled, stress, history[matrix]);
        const double twice = 2 * sc;
        const Lane even = squared(stress.yy, twice) + shear;
        const Lane odd = (yc > 0 && twice > 0 ? ((yc / twice) * (yc / twice) - 1) / yc : 0.0) * stress.yy;
        return_to(even, odd, pressed, stress, history[matrix_compressed]);
    }

    template <class Lane>
    void judge_fibers(SymmetricTensor<Lane>& stress, HistoryView<Lane> history) const
    {
        const Lane zero{};
        const MaskOf<Lane> matrix_crushed = history[matrix_compressed] == 0.0;
        if (xt > 0) {
            const double reduced = fiber_reduction > 0 ? fiber_reduction * xt : xt;
            const Lane strength = matrix_crushed ? broadcast<Lane>(reduced) : broadcast<Lane>(xt);
            const Lane share = (rule == Rule::composite_damage ? 1.0 : beta) * shear_ratio(stress.xy);
            const Lane limit = strength * sqrt(max(1.0 - share, zero));
            const MaskOf<Lane> torn = (stress.xx > zero) & (stress.xx >= limit);
            stress.xx = torn ? limit : stress.xx;
            history[fiber] = torn ? zero : history[fiber];
        }
        if (rule == Rule::composite_damage || !(xc > 0)) return;
        const double reduced = compression_factor > 0 && yc > 0 ? compression_factor * yc : xc;
        const Lane limit = matrix_crushed ? broadcast<Lane>(-reduced) : broadcast<Lane>(-xc);
        const MaskOf<Lane> crushed = stress.xx <= limit;
        stress.xx = crushed ? limit : stress.xx;
        history[fiber_compressed] = crushed ? zero : history[fiber_compressed];
    }

    /// Loss of the ply.
    template <class Lane>
    void judge_strains(HistoryView<Lane> history) const
    {
        MaskOf<Lane> gone = history[fiber] == 0.0;
        if (tension_strain > 0) gone = history[strain_a] >= tension_strain;
        if (compression_strain < 0) gone = gone | (history[strain_a] <= compression_strain);
        if (matrix_strain > 0) gone = gone | (abs(history[strain_b]) >= matrix_strain);
        if (shear_strain > 0) gone = gone | (abs(history[strain_ab]) >= shear_strain);
        if (effective_strain > 0) {
            const Lane square =
                effective_ply_strain_square(history[strain_a], history[strain_b], history[strain_ab]);
            gone = gone | (square >= effective_strain * effective_strain);
        }
        history[sound] = gone ? Lane{} : history[sound];
    }
};

} // namespace plash
