#pragma once

#include "core/clock.h"
#include "model/model.h"

namespace plash {

/// What is in an airbag at t_n.
struct BagState {
    double first_volume = 0; ///< V0 [volume]
    double volume = 0;
    double pressure = 0;  ///< gauge, before PSCA [pressure]
    double stiffness = 0; ///< -V dp/dV [pressure]
    /// Of gas c_v m T; of all else what the surface has done to it so far [energy].
    double internal_energy = 0;
    double mass = 0;        ///< [mass]
    double temperature = 0; ///< of gas
    double inflow = 0;      ///< [mass/time]
    double outflow = 0;     ///< [mass/time]
    bool open = false;      ///< its gauge pressure has been above the opening pressure
};

/// The content before the first cycle in a volume, above 0.
BagState start_content(const Airbag& bag, const Model& model, double volume);

/// Takes the content from t_(n-1) to t_n, when it has `volume`. In dynamic relaxation nothing flows.
/// leak_area   sum of what fabrics leak: area times share (VentedGas::leak_share) [area]
///
/// Gas is ideal and well mixed (Wang & Nefske 1988, SAE 880654): with enthalpies h = c_p T of what flows in
/// and out, dE/dt = h_in dm_in/dt - h dm_out/dt - p dV/dt and p = (gamma - 1) E / V, by the trapezoidal rule
/// (flows by Heun's method). Outflow is that of Saint-Venant & Wantzel 1839 (as in Shapiro 1953, The Dynamics
/// and Thermodynamics of Compressible Fluid Flow, vol. 1, eq. 4.17 ff.): isentropic to the ambient pressure,
/// or to the critical one where that is higher. Fluid: p = K ln(V0 / V) (LS-DYNA manual,
/// *AIRBAG_LINEAR_FLUID).
void advance_content(const Airbag& bag, const Model& model, const Clock& clock, double volume,
                     double leak_area, BagState& state);

/// Mass a time and area that leaves gas of an absolute pressure and a temperature through an orifice.
double orifice_flow(const VentedGas& gas, double pressure, double temperature);

} // namespace plash
