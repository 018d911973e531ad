#pragma once

#include "model/model.h"

#include <array>
#include <span>

namespace plash {

/// What a shell element gives to its corners at the start.
struct ShellMass {
    double area = 0;                     ///< [length^2]
    double thickness = 0;                ///< mean over the corners [length]
    std::array<double, 4> corner_mass{}; ///< [mass]; zero at the repeated corner of a triangle
    double squared_gyration = 0;         ///< rotary inertia over mass at a corner [length^2]
    double offset = 0; ///< from the middle of the thickness to the nodes, along the normal [length]
};

/// Corners of an element in the order that the elements use: a triangle repeats its third node last.
std::array<Index, 4> shell_corners(const Model& model, Index element);

/// Plies of an element: its own (_COMPOSITE), else those of its part (*PART_COMPOSITE), else none.
std::span<const Layer> shell_layers(const Model& model, Index element);

/// *SECTION_SHELL of a part, or its *PART_COMPOSITE, which names formulation, shear factor and offset alike.
/// DeckError when there is neither.
const Record& shell_section(const Model& model, const Part& part);

/// What the shells of a part have in common, looked up once.
struct ShellPlate {
    double thickness = 0; ///< mean of T1..T4 of the section; 0 for plies [length]
    double more_mass = 0; ///< MAREA [mass/area]
    double density = 0;   ///< of the part's material; 0 for plies [density]
    double reference = 0; ///< NLOC: 1 nodes on the top surface, -1 on the bottom; 0 for membranes
};
ShellPlate shell_plate(const Model& model, const Part& part);

/// Thickness of an element: sum of its plies, or mean of its own corner thicknesses
/// (*ELEMENT_SHELL_THICKNESS) or of T1..T4 of its section [length].
double shell_thickness(const Model& model, Index element);

/// Lumped mass of an element: equal shares of density x area x thickness (plus the section's MAREA). Rotary
/// inertia: the larger of thickness^2 / 12 + offset^2, which is physical, and area / 8, which keeps rotations
/// from limiting the step (Hughes, Cohen & Haroun 1978; Hallquist 2006, Hughes-Liu shell).
ShellMass shell_mass(const Model& model, Index element);
ShellMass shell_mass(const Model& model, Index element, const ShellPlate& plate);

} // namespace plash
