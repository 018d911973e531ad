#include "elements/solid_rate_group.h"
#include "materials/damaged_plasticity.h"

namespace plash {

std::unique_ptr<SolidGroup> make_damaged_plasticity_solids(const Record& material,
                                                           const Record* equation_of_state, SolidSetup setup,
                                                           State& state)
{
    return make_rate_group<DamagedPlasticity>(material, equation_of_state, std::move(setup), state);
}

} // namespace plash
