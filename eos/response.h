#pragma once

#include "math/lanes.h"

namespace plash {

/// Pressure of an equation of state at a density, linear in the internal energy E by reference volume:
/// p = cold + warm * E. Every equation of state is a plain struct with
///   double energy            E at the start, by reference volume [stress]
///   double relative_volume   volume over reference volume at the start
///   double bulk_modulus      density * sound speed^2 at reference density and zero energy; 0: a gas [stress]
///   static Eos from_record(const Record&, double density)
///   evaluate(compression)    of density over reference density, for double and Lanes
template <class Lane>
struct PressureResponse {
    Lane cold, warm;             ///< [stress], [-]
    Lane cold_slope, warm_slope; ///< derivatives by the compression

    Lane pressure(const Lane& energy) const { return cold + warm * energy; }

    /// Reference density times the square of the sound speed, dp/drho at constant entropy [stress].
    Lane stiffness(const Lane& compression, const Lane& pressure, const Lane& energy) const
    {
        return cold_slope + warm_slope * energy + warm * pressure / (compression * compression);
    }
};

/// Pressure and energy at the end of a step.
template <class Lane>
struct PressureStep {
    Lane pressure, energy;
};

/// The energy equation over a step by the trapezoidal rule, solved for the pressure at its end:
/// E = before + other_work - (p_before * change_at_start + p * change_at_end) / 2.
/// before           energy at the start of the step [stress]
/// other_work       work of everything but the pressure, by reference volume [stress]
/// change_at_start, change_at_end  of the volume over the reference volume, as each of the pressures works on
///                  it: the same, or as the nodal forces of both ends do (elements/solid_step.h)
/// lowest_pressure  cut-off in tension [stress]
template <class Lane>
inline PressureStep<Lane> advance_pressure(const PressureResponse<Lane>& response, const Lane& before,
                                           const Lane& other_work, const Lane& pressure_before,
                                           const Lane& change_at_start, const Lane& change_at_end,
                                           double lowest_pressure)
{
    const Lane half = 0.5 * change_at_end;
    const Lane known = before + other_work - 0.5 * change_at_start * pressure_before;
    const Lane free = (response.cold + response.warm * known) / (1.0 + response.warm * half);
    const Lane pressure = max(free, broadcast<Lane>(lowest_pressure));
    return {pressure, known - half * pressure};
}

/// The same where both pressures work on one change of volume.
template <class Lane>
inline PressureStep<Lane> advance_pressure(const PressureResponse<Lane>& response, const Lane& before,
                                           const Lane& other_work, const Lane& pressure_before,
                                           const Lane& volume_change, double lowest_pressure)
{
    return advance_pressure(response, before, other_work, pressure_before, volume_change, volume_change,
                            lowest_pressure);
}

} // namespace plash
