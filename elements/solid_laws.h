#pragma once

#include "elements/solid_group.h"

#include <memory>

namespace plash {

/// Makes the group of a part with one material law: reads the law, completes setup.parameters with its
/// density and moduli, and instantiates the step. Each stands in a .cpp file of its own, since the kernel is
/// compiled anew for every law.
using SolidGroupMaker = std::unique_ptr<SolidGroup> (*)(const Record& material,
                                                        const Record* equation_of_state, SolidSetup setup,
                                                        State& state);

std::unique_ptr<SolidGroup> make_elastic_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_plastic_kinematic_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_null_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_piecewise_linear_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_crushable_foam_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_johnson_cook_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_rubber_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_soil_foam_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_elastic_plastic_hydro_solids(const Record&, const Record*, SolidSetup,
                                                              State&);
std::unique_ptr<SolidGroup> make_viscoelastic_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_ogden_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_hyperelastic_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_damaged_plasticity_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_compression_tension_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_fu_chang_foam_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_low_density_foam_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_low_density_viscous_foam_solids(const Record&, const Record*, SolidSetup,
                                                                 State&);
std::unique_ptr<SolidGroup> make_elastic_fluid_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_high_explosive_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_geologic_cap_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_orthotropic_solids(const Record&, const Record*, SolidSetup, State&);
std::unique_ptr<SolidGroup> make_honeycomb_solids(const Record&, const Record*, SolidSetup, State&);

} // namespace plash
