#include "elements/solid_rate_group.h"
#include "elements/solid_strength_group.h"
#include "materials/johnson_cook.h"

namespace plash {

std::unique_ptr<SolidGroup> make_johnson_cook_solids(const Record& material, const Record* equation_of_state,
                                                     SolidSetup setup, State& state)
{
    // LS-DYNA asks for an equation of state; without one the bulk modulus of E and PR takes its place.
    if (!equation_of_state) return make_rate_group<JohnsonCook>(material, nullptr, std::move(setup), state);
    return make_strength_group<JohnsonCook>(material, *equation_of_state, std::move(setup), state);
}

} // namespace plash
