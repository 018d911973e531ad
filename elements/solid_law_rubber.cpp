#include "elements/solid_deformation_group.h"
#include "materials/blatz_ko.h"
#include "materials/mooney_rivlin.h"

namespace plash {

std::unique_ptr<SolidGroup> make_rubber_solids(const Record& material, const Record* equation_of_state,
                                               SolidSetup setup, State& state)
{
    if (material.keyword == "MAT_BLATZ-KO_RUBBER") {
        const BlatzKo law = BlatzKo::from_record(material, setup.model);
        return make_deformation_group(material, equation_of_state, law, law.shear_modulus, law.poisson_ratio,
                                      std::move(setup), state);
    }
    const MooneyRivlin law = MooneyRivlin::from_record(material, setup.model);
    return make_deformation_group(material, equation_of_state, law, law.shear_modulus(), law.poisson_ratio,
                                  std::move(setup), state);
}

} // namespace plash
