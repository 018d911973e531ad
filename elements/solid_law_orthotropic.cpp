#include "elements/solid_deformation_group.h"
#include "materials/orthotropic_elastic.h"

namespace plash {

std::unique_ptr<SolidGroup> make_orthotropic_solids(const Record& material, const Record* equation_of_state,
                                                    SolidSetup setup, State& state)
{
    const auto law = OrthotropicElasticSolid::from_record(material, setup.model);
    // Hourglass control and the bound of the step take an isotropic solid of the same fastest wave.
    const double wave = law.stiffness.largest_modulus();
    const double shear = std::min(law.mean_shear_modulus(), 0.7 * wave);
    return make_deformation_group(material, equation_of_state, law, shear,
                                  (wave - 2 * shear) / (2 * (wave - shear)), std::move(setup), state);
}

} // namespace plash
