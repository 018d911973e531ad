#pragma once

#include "core/state.h"
#include "core/term.h"
#include "elements/shell_store.h"

#include <memory>

/// The shell groups of each material law, one maker and one .cpp file a law.
namespace plash {

enum class ShellFormulation { belytschko_tsay, triangle, fully_integrated };

using ShellGroupMaker = std::unique_ptr<Term>(const ShellPart& part, ShellFormulation formulation,
                                              State& state);

ShellGroupMaker make_compression_tension_shells;
ShellGroupMaker make_damaged_plasticity_shells;
ShellGroupMaker make_elastic_shells;
ShellGroupMaker make_johnson_cook_shells;
ShellGroupMaker make_laminate_shells;
ShellGroupMaker make_piecewise_linear_shells;
ShellGroupMaker make_plastic_kinematic_shells;

} // namespace plash
