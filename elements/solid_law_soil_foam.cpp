#include "elements/solid_rate_group.h"
#include "materials/soil_foam.h"

namespace plash {

std::unique_ptr<SolidGroup> make_soil_foam_solids(const Record& material, const Record* equation_of_state,
                                                  SolidSetup setup, State& state)
{
    return make_rate_group<SoilFoam>(material, equation_of_state, std::move(setup), state);
}

} // namespace plash
