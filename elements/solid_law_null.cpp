#include "elements/solid_equation_of_state.h"
#include "elements/solid_fluid_point.h"
#include "elements/solid_rate_group.h"

namespace plash {

std::unique_ptr<SolidGroup> make_null_solids(const Record& material, const Record* equation_of_state,
                                             SolidSetup setup, State& state)
{
    const Record& needed = need_equation_of_state(material, equation_of_state, setup);
    const NullFluid fluid = NullFluid::from_record(material);
    setup.parameters.density = fluid.density;
    SolidHourglass& hourglass = setup.parameters.hourglass;
    if (hourglass.form == SolidHourglass::Form::assumed_strain ||
        hourglass.form == SolidHourglass::Form::total_strain) { // a fluid has no shape to go back to
        // LS-DYNA: viscous for *MAT_NULL, scaled by the viscosity of the material (manual, *HOURGLASS).
        hourglass.form = SolidHourglass::Form::assumed_rate;
        hourglass.shear_modulus = fluid.viscosity;
        hourglass.poisson_ratio = 0.5;
    }
    return with_equation_of_state(needed, fluid.density, setup, [&]<class Eos>(const Eos& eos) {
        return make_point_group(FluidPoint<Eos>{fluid, eos}, std::move(setup), state);
    });
}

} // namespace plash
