#include "elements/solid_equation_of_state.h"
#include "elements/solid_rate_group.h"
#include "elements/solid_strength_point.h"
#include "materials/johnson_cook.h"

namespace plash {

std::unique_ptr<SolidGroup> make_johnson_cook_solids(const Record& material, const Record* equation_of_state,
                                                     SolidSetup setup, State& state)
{
    // LS-DYNA asks for an equation of state; without one the bulk modulus of E and PR takes its place.
    if (!equation_of_state) return make_rate_group<JohnsonCook>(material, nullptr, std::move(setup), state);
    const JohnsonCook law = JohnsonCook::from_record(material, setup.model);
    setup.parameters.density = law.density;
    setup.parameters.hourglass.shear_modulus = law.shear_modulus;
    setup.parameters.hourglass.poisson_ratio = law.poisson_ratio;
    return with_equation_of_state(*equation_of_state, law.density, setup, [&]<class Eos>(const Eos& eos) {
        return make_point_group(StrengthPoint<JohnsonCook, Eos>{law, eos}, std::move(setup), state);
    });
}

} // namespace plash
