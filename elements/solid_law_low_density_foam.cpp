#include "elements/solid_deformation_group.h"
#include "materials/fu_chang_foam.h"
#include "materials/low_density_viscous_foam.h"

namespace plash {

std::unique_ptr<SolidGroup> make_low_density_foam_solids(const Record& material,
                                                         const Record* equation_of_state, SolidSetup setup,
                                                         State& state)
{
    if (material.real("ED") != 0) {
        const auto law = relaxing_foam(material, setup.model);
        return make_deformation_group(material, equation_of_state, law, 0.5 * law.foam.young_modulus, 0.0,
                                      std::move(setup), state);
    }
    const LowDensityFoam law = LowDensityFoam::from_record(material, setup.model);
    return make_deformation_group(material, equation_of_state, law, 0.5 * law.young_modulus, 0.0,
                                  std::move(setup), state);
}

std::unique_ptr<SolidGroup> make_low_density_viscous_foam_solids(const Record& material,
                                                                 const Record* equation_of_state,
                                                                 SolidSetup setup, State& state)
{
    const auto law = viscous_foam(material, setup.model);
    return make_deformation_group(material, equation_of_state, law, 0.5 * law.foam.young_modulus, 0.0,
                                  std::move(setup), state);
}

std::unique_ptr<SolidGroup> make_fu_chang_foam_solids(const Record& material, const Record* equation_of_state,
                                                      SolidSetup setup, State& state)
{
    const FuChangFoam law = FuChangFoam::from_record(material, setup.model);
    return make_deformation_group(material, equation_of_state, law, 0.5 * law.foam.young_modulus, 0.0,
                                  std::move(setup), state);
}

} // namespace plash
