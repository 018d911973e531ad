#include "elements/solid_rate_group.h"
#include "materials/elastic.h"

namespace plash {

std::unique_ptr<SolidGroup> make_elastic_solids(const Record& material, const Record* equation_of_state,
                                                SolidSetup setup, State& state)
{
    return make_rate_group<Elastic>(material, equation_of_state, std::move(setup), state);
}

} // namespace plash
