#pragma once

namespace plash {

/// Where a charge of TNT explodes.
enum class Burst {
    surface, ///< a hemisphere on the ground
    air,     ///< a sphere that nothing reflects on its way
};

/// The shock of a charge of TNT at a distance, in the units of its source: lengths and times over the cube
/// root of the charge's mass in pounds, feet, milliseconds, pounds per square inch.
struct AirBlast {
    double arrival = 0, duration = 0;                     ///< of the positive phase [ms / lb^(1/3)]
    double incident_pressure = 0, reflected_pressure = 0; ///< largest, over ambient [psi]
    double incident_impulse = 0, reflected_impulse = 0;   ///< of the positive phase [psi ms / lb^(1/3)]
    double incident_decay = 0, reflected_decay = 0;       ///< Friedlander's exponents [-]; 0: linear in time

    /// Pressure over ambient on a surface [psi], not below vacuum: Friedlander's (1946) p (1 - t / t_d)
    /// exp(-a t / t_d) of both, P_r cos^2 + P_i (1 + cos^2 - 2 cos) where the surface sees the charge, P_i
    /// where it does not (Randers-Pehrson & Bannister 1997; keyword manual, *LOAD_BLAST_ENHANCED).
    /// since_arrival  [ms / lb^(1/3)]
    /// cosine         between the surface's normal and the direction to the charge [-]
    double pressure(double since_arrival, double cosine) const;
};

/// Scaled distances for which there are data [ft / lb^(1/3)].
double nearest_blast(Burst burst);
double farthest_blast();

/// Fits of Kingery & Bulmash (1984, ARBRL-TR-02555) with the coefficients as Randers-Pehrson & Bannister
/// (1997, ARL-TR-1310, appendix A) print them, and their exponents: a of I = P t_d / a^2 (a - 1 + exp(-a)),
/// linear near the charge. Distances out of range count as the nearest and the farthest.
/// scaled_distance  over the cube root of the charge's mass [ft / lb^(1/3)]
AirBlast air_blast(Burst burst, double scaled_distance);

} // namespace plash
