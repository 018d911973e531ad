#pragma once

#include "math/symmetric_tensor.h"
#include "math/vector3.h"
#include "model/model.h"

#include <array>
#include <span>

namespace plash {

/// A one-point solid with linear elasticity, viscosity and hourglass control, as the bound of the step sees
/// it.
struct LinearSolid {
    std::array<Index, 8> node{};    ///< in the caller's numbering; degenerate shapes repeat nodes
    std::array<Vec3, 8> gradient{}; ///< derivative of the volume by the place of each corner [area]
    double volume = 0;              ///< [volume]
    double bulk = 0, shear = 0;     ///< moduli [stress]
    double bulk_viscosity = 0;      ///< pressure over the rate of the volume strain [stress time]
    double hourglass = 0;           ///< stiffness of each hourglass pattern [force/length]
    double hourglass_damping = 0;   ///< [force time/length]
};

/// Square of the largest circular frequency of one elastic solid on its own nodes, without hourglass control
/// [1/time^2]; `mass` is lumped on each node. No mesh has a larger one than the largest of its elements
/// (Flanagan & Belytschko 1984, J. Appl. Mech. 51, 35-40).
double lone_frequency_squared(const LinearSolid&, double mass);

/// Largest eigenvalue of M^-1 (K + 2 C / step) for solids that share nodes [1/time^2], by Lanczos' method
/// (Parlett 1998, The Symmetric Eigenvalue Problem, ch. 13). With damping forces from the velocities half a
/// step ago, central difference is stable while it does not exceed 4 / step^2 (Belytschko, Liu & Moran 2000,
/// Nonlinear Finite Elements for Continua and Structures, 6.6: sqrt(1 + xi^2) - xi). `step` infinite: no
/// damping. `inverse_mass` by node number and direction; zero where the node is held [1/mass].
double largest_eigenvalue(std::span<const LinearSolid>, std::span<const Vec3> inverse_mass, double step);

} // namespace plash
