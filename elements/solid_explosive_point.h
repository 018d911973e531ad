#pragma once

#include "elements/solid_step.h"
#include "eos/memory.h"
#include "materials/high_explosive.h"

namespace plash {

/// Material point of an explosive (materials/high_explosive.h) with the equation of state of its products.
template <class Eos>
struct ExplosivePoint {
    HighExplosive law;
    Eos eos;
    std::vector<Detonator> detonators;

    enum Variable { burnt, age, eos_memory }; ///< share that has burnt; time since the start
    static constexpr int history_size = eos_memory + eos_history_size<Eos>;
    static constexpr int lighting = 0, burn_rate = 1; ///< constants [time], [1/time]
    static constexpr int constant_size = 2;
    static constexpr bool modulus_changes = true;
    static constexpr bool can_fail = false;
    static constexpr int plastic_strain = burnt; ///< shown in its place, as LS-DYNA does

    template <class Lane>
    void start(const SolidModes<Lane>& position, Lane* history, Lane* constants) const
    {
        const Lane volume = gradient_of<SolidGradientRule::mean>(position).volume;
        constants[point_constants + burn_rate] =
            (2.0 / 3 * law.detonation_speed) * sqrt(largest_face_squared(position)) / volume;
        history[internal_energy_history] = eos.energy / constants[inverse_volume_constant];
    }

    /// Lighting times by the centres of the elements.
    template <class Lane>
    void start_at(const Vector3<Lane>& centre, Lane* constants) const
    {
        for (int lane = 0; lane < lanes_in<Lane>; ++lane) {
            const Vec3 place{lane_of(centre.x, lane), lane_of(centre.y, lane), lane_of(centre.z, lane)};
            set_lane(constants[point_constants + lighting], lane,
                     lighting_time(detonators, place, law.detonation_speed));
        }
    }

    template <class Lane>
    Lane wave_modulus(const SolidMotion<Lane>& motion, HistoryView<Lane> history) const
    {
        const Lane compression = 1.0 / motion.relative_volume;
        const PressureResponse<Lane> response = mixed(compression, history, history[burnt]);
        const Lane pressure = response.pressure(motion.energy_density);
        const Lane stiffness = response.stiffness(compression, pressure, motion.energy_density);
        const double solid = law.bulk_modulus + 4.0 / 3 * law.shear_modulus;
        // The front crosses what has not burnt with the detonation velocity, whatever the stiffness there.
        const double front = std::max(law.density * law.detonation_speed * law.detonation_speed, solid);
        const Lane least = history[burnt] < 1.0 ? broadcast<Lane>(front) : Lane{};
        return max(stiffness, least) * compression;
    }

    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, HistoryView<Lane> history,
                const SolidMotion<Lane>& motion) const
    {
        const Lane one = broadcast<Lane>(1);
        history[age] += motion.time_step;
        Lane share = history[burnt];
        if (law.by_program) {
            const Lane since = history[age] - motion.constants[lighting];
            share = max(share, Lane{max(since, Lane{}) * motion.constants[burn_rate]});
        }
        if (law.by_compression) share = max(share, (1.0 - motion.relative_volume) / law.burnt_compression);
        share = min(share, one);
        history[burnt] = share;

        const Lane pressure_before = (-1.0 / 3) * trace(stress);
        const SymmetricTensor<Lane> shear_before = deviator(stress);
        const SymmetricTensor<Lane> shear = solid_shear(shear_before, deviator(motion.increment), share);
        const Lane middle_volume = motion.relative_volume - 0.5 * motion.volume_change;
        const Lane other_work =
            0.5 * middle_volume * contract(shear_before + shear, motion.increment) + motion.viscous_work;
        const Lane compression = 1.0 / motion.relative_volume;
        if constexpr (eos_history_size < Eos >> 0)
            history[eos_memory] = max(history[eos_memory], compression);
        const PressureStep<Lane> end =
            advance_pressure(mixed(compression, history, share), motion.energy_density, other_work,
                             pressure_before, motion.change_at_start, motion.change_at_end, -1e300);
        stress = {shear.xx - end.pressure,
                  shear.yy - end.pressure,
                  shear.zz - end.pressure,
                  shear.xy,
                  shear.yz,
                  shear.zx};
    }

private:
    /// Products and explosive side by side.
    template <class Lane>
    PressureResponse<Lane> mixed(const Lane& compression, HistoryView<Lane> history, const Lane& share) const
    {
        const PressureResponse<Lane> gas = respond(eos, compression, history.values + eos_memory);
        const Lane left = law.bulk_modulus * (1.0 - share);
        return {share * gas.cold + left * (compression - 1.0), share * gas.warm,
                share * gas.cold_slope + left, share * gas.warm_slope};
    }

    /// Elastic, perfectly plastic; less and less is left of it while it burns.
    template <class Lane>
    SymmetricTensor<Lane> solid_shear(const SymmetricTensor<Lane>& before,
                                      const SymmetricTensor<Lane>& increment, const Lane& share) const
    {
        if (law.shear_modulus == 0) return {};
        const SymmetricTensor<Lane> trial = before + broadcast<Lane>(2 * law.shear_modulus) * increment;
        const Lane equivalent = sqrt(Lane{1.5 * contract(trial, trial)});
        const Lane allowed = law.yield_stress * (1.0 - share);
        const Lane factor =
            equivalent > allowed ? allowed / max(equivalent, broadcast<Lane>(1e-300)) : broadcast<Lane>(1);
        return factor * trial;
    }
};

} // namespace plash
