#include "elements/solid_rate_group.h"
#include "materials/crushable_foam.h"

namespace plash {

std::unique_ptr<SolidGroup> make_crushable_foam_solids(const Record& material,
                                                       const Record* equation_of_state, SolidSetup setup,
                                                       State& state)
{
    return make_rate_group<CrushableFoam>(material, equation_of_state, std::move(setup), state);
}

} // namespace plash
