#pragma once

#include "model/record.h"

#include <array>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace plash {

/// *AIRBAG_SIMPLE_PRESSURE_VOLUME: gauge pressure = scale coefficient / (V / V0), or a curve of V / V0.
struct PressureOfVolume {
    double coefficient = 0;         ///< CN [pressure]
    Index coefficient_curve = none; ///< CN below 0: by time
    Index relaxation_curve = none;  ///< LCIDDR: CN by time in dynamic relaxation
    double scale = 0;               ///< BETA
    Index curve = none;             ///< LCID: pressure by relative volume, instead of all that
};

/// *AIRBAG_ADIABATIC_GAS_MODEL: absolute pressure (P0 + PE) (V0 / V)^gamma.
struct AdiabaticGas {
    double ratio_of_specific_heats = 0; ///< GAMMA
    double pressure = 0;                ///< P0, gauge, at the start [pressure]
    double ambient_pressure = 0;        ///< PE [pressure]
    double density = 0;                 ///< RO at the start [density]
};

/// A hole through which gas leaves: area times discharge coefficient, either of them constant or a curve.
struct Orifice {
    double coefficient = 0;               ///< [-]
    Index coefficient_curve = none;       ///< instead of `coefficient`
    bool coefficient_of_pressure = false; ///< the curve is one of absolute pressure; else of time
    double area = 0;                      ///< [area]
    Index area_curve = none;              ///< instead of `area`, by absolute pressure
};

/// *AIRBAG_SIMPLE_AIRBAG_MODEL, *AIRBAG_WANG_NEFSKE: ideal gas that flows in and out.
struct VentedGas {
    double heat_at_constant_volume = 0;   ///< CV [energy/mass/temperature]
    double heat_at_constant_pressure = 0; ///< CP
    Index inflow_curve = none;            ///< mass a time, by time
    double inflow_temperature = 0;        ///< T
    Index temperature_curve = none;       ///< LCT: instead of T, by time
    double ambient_pressure = 0;          ///< PE [pressure]
    double density = 0;                   ///< RO: of the gas that is there at the start [density]
    double overpressure = 0;              ///< POVER: gauge pressure at the start [pressure]
    std::vector<Orifice> orifices;
    Index outflow_curve = none;     ///< LOU, LCEFR: mass a time, by gauge pressure, beside the orifices
    double opening_pressure = 0;    ///< PPOP: gauge pressure up to which all is shut
    double conversion = 1;          ///< GC: of units of force to mass times acceleration
    std::vector<double> leak_share; ///< of fabrics, by segment (FLC FAC of its material); empty: none leaks
};

/// *AIRBAG_LINEAR_FLUID: pressure = K ln(V0 / V), V0 the volume that the mass would have at no pressure.
struct LinearFluid {
    double bulk_modulus = 0;          ///< BULK [pressure]
    Index bulk_curve = none;          ///< LCBULK: instead, by time
    double density = 0;               ///< RO [density]
    Index inflow_curve = none;        ///< LCINT: mass a time, by time
    Index outflow_curve = none;       ///< LCOUTT: mass a time, by time
    Index outflow_by_pressure = none; ///< LCOUTP: mass a time, by pressure
    Index added_pressure = none;      ///< LCFIT: pressure by time
    Index pressure_by_volume = none;  ///< LCID: pressure by relative volume, instead of the logarithm
    double largest_pressure = std::numeric_limits<double>::infinity(); ///< P_LIMIT
    Index largest_pressure_curve = none;                               ///< P_LIMLC: instead, by time
};

/// *AIRBAG family: what fills the volume inside a surface has one pressure, which acts on the surface.
struct Airbag {
    Id id = 0;
    std::string title;
    std::vector<std::array<Index, 4>> segments; ///< node indices; a triangle repeats the third
    double volume_scale = 1;                    ///< VSCA
    double pressure_scale = 1;                  ///< PSCA
    std::variant<PressureOfVolume, AdiabaticGas, VentedGas, LinearFluid> content;
    Location where;
};

} // namespace plash
