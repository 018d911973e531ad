#include "elements/solid_rate_group.h"
#include "materials/plastic_kinematic.h"

namespace plash {

std::unique_ptr<SolidGroup> make_plastic_kinematic_solids(const Record& material,
                                                          const Record* equation_of_state, SolidSetup setup,
                                                          State& state)
{
    if (PlasticKinematicParameters::from_record(material).has_back_stress()) {
        return make_rate_group<PlasticKinematic<true>>(material, equation_of_state, std::move(setup), state);
    }
    return make_rate_group<PlasticKinematic<false>>(material, equation_of_state, std::move(setup), state);
}

} // namespace plash
