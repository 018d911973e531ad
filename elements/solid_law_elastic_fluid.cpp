#include "elements/solid_elastic_fluid_point.h"
#include "elements/solid_rate_group.h"

namespace plash {

std::unique_ptr<SolidGroup> make_elastic_fluid_solids(const Record& material, const Record* equation_of_state,
                                                      SolidSetup setup, State& state)
{
    refuse_equation_of_state(material, equation_of_state, setup);
    const ElasticFluid fluid = ElasticFluid::from_record(material);
    setup.parameters.density = fluid.density;
    SolidHourglass& hourglass = setup.parameters.hourglass;
    if (hourglass.form == SolidHourglass::Form::assumed_strain ||
        hourglass.form == SolidHourglass::Form::total_strain) { // a fluid has no shape to go back to
        // There is no shear modulus to work with; the viscous form takes the speed of sound.
        hourglass.form = SolidHourglass::Form::viscous;
        hourglass.poisson_ratio = 0.5;
    }
    return make_point_group(ElasticFluidPoint{fluid}, std::move(setup), state);
}

} // namespace plash
