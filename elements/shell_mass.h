#pragma once

#include "model/model.h"

#include <array>

namespace plash {

/// What a shell element gives to its corners at the start.
struct ShellMass {
    double area = 0;                     ///< [length^2]
    double thickness = 0;                ///< mean over the corners [length]
    std::array<double, 4> corner_mass{}; ///< [mass]; zero at the repeated corner of a triangle
    double squared_gyration = 0;         ///< rotary inertia over mass at a corner [length^2]
};

/// Corners of an element in the order that the elements use: a triangle repeats its third node last.
std::array<Index, 4> shell_corners(const Model& model, Index element);

/// Thickness of an element: mean of its own corner thicknesses (*ELEMENT_SHELL_THICKNESS) or of T1..T4 of its
/// section [length].
double shell_thickness(const Model& model, Index element);

/// Lumped mass of an element: equal shares of density x area x thickness (plus the section's MAREA). Rotary
/// inertia: the larger of thickness^2 / 12, which is physical, and area / 8, which keeps rotations from
/// limiting the step (Hughes, Cohen & Haroun 1978; Hallquist 2006, Hughes-Liu shell).
ShellMass shell_mass(const Model& model, Index element);

} // namespace plash
