#pragma once

#include "elements/solid_equation_of_state.h"
#include "elements/solid_rate_group.h"
#include "elements/solid_strength_point.h"

namespace plash {

/// The group of a law for the deviator with an equation of state for the pressure.
template <class Strength>
std::unique_ptr<SolidGroup> make_strength_group(const Record& material, const Record& equation_of_state,
                                                SolidSetup setup, State& state)
{
    const Strength law = Strength::from_record(material, setup.model);
    setup.parameters.density = law.density;
    setup.shear_modulus = law.shear_modulus;
    setup.parameters.hourglass.shear_modulus = law.shear_modulus;
    setup.parameters.hourglass.poisson_ratio = law.poisson_ratio;
    return with_equation_of_state(equation_of_state, law.density, setup, [&]<class Eos>(const Eos& eos) {
        return make_point_group(StrengthPoint<Strength, Eos>{law, eos}, std::move(setup), state);
    });
}

} // namespace plash
