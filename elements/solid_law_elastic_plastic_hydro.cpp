#include "elements/solid_strength_group.h"
#include "materials/elastic_plastic_hydro.h"

namespace plash {

std::unique_ptr<SolidGroup> make_elastic_plastic_hydro_solids(const Record& material,
                                                              const Record* equation_of_state,
                                                              SolidSetup setup, State& state)
{
    const Record& needed = need_equation_of_state(material, equation_of_state, setup);
    return make_strength_group<ElasticPlasticHydro>(material, needed, std::move(setup), state);
}

} // namespace plash
