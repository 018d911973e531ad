#pragma once

#include "materials/discrete_beam_law.h"

/// The laws of discrete beams. Formulas: LS-DYNA keyword manual, volume II, at the keyword of each; Hallquist
/// (2006), LS-DYNA theory manual, material models 66 to 71.
namespace plash {

/// *MAT_066: F = F0 + K way + D rate in each freedom.
std::unique_ptr<DiscreteBeamLaw> make_linear_discrete_beam(const Record&, const Model&);

/// *MAT_067: F = F0 + curve(way) + curve(rate) in each freedom; fails by a quadratic sum of resultants or
/// ways.
std::unique_ptr<DiscreteBeamLaw> make_nonlinear_discrete_beam(const Record&, const Model&);

/// *MAT_068: elastic with K and damping D; yields at a force that is a curve of the plastic way, alike in
/// both senses; fails as 067.
std::unique_ptr<DiscreteBeamLaw> make_plastic_discrete_beam(const Record&, const Model&);

/// *MAT_069: damper of side impact dummies.
std::unique_ptr<DiscreteBeamLaw> make_sid_damper(const Record&, const Model&);

/// *MAT_070: hydraulic damper with a gas spring.
std::unique_ptr<DiscreteBeamLaw> make_hydraulic_gas_damper(const Record&, const Model&);

/// *MAT_071: cable that carries tension alone.
std::unique_ptr<DiscreteBeamLaw> make_cable(const Record&, const Model&);

/// *MAT_074 and *MAT_094: one spring along the nodes, elastic or with a yield force.
std::unique_ptr<DiscreteBeamLaw> make_spring_beam(const Record&, const Model&);

/// *MAT_093 and *MAT_095: one spring of 074 or 094 in each freedom.
std::unique_ptr<DiscreteBeamLaw> make_six_spring_beam(const Record&, const Model&);

/// *MAT_119 in local axes and *MAT_121 along the nodes: loading and unloading curves.
std::unique_ptr<DiscreteBeamLaw> make_general_discrete_beam(const Record&, const Model&);

} // namespace plash
