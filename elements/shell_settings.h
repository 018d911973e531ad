#pragma once

#include "elements/shell_kernel.h"
#include "model/model.h"

namespace plash {

/// Gauss-Legendre rule with 1 to 10 points on [-1, 1], weights summing to one.
ThicknessRule gauss_rule(int points);
/// Equally spaced points from surface to surface with trapezoidal weights (QR/IRID = 1); 2 points or more.
ThicknessRule trapezoidal_rule(int points);

/// Gauss-Lobatto rule with 3 to 10 points, the outer ones on the surfaces (INTGRD = 1).
ThicknessRule lobatto_rule(int points);

/// Points through the thickness that a section asks for.
/// field  of the rule: 0 as INTGRD of *CONTROL_SHELL says, 1 trapezoidal, below 0 an *INTEGRATION_SHELL
ThicknessRule thickness_rule(const Model& model, const Record& section, Id points, const char* field);

/// Reads and checks what *SECTION_SHELL, *HOURGLASS and the controls say for the shells of a part.
/// young_modulus, poisson_ratio  of its law
/// laminate  the points are plies, which bring place, weight and angle of their own
/// Throws a DeckError that names keyword and field for what is not supported.
ShellSettings shell_settings(const Model& model, Index part, double density, double young_modulus,
                             double poisson_ratio, bool laminate = false);

} // namespace plash
