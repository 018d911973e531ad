#include "elements/solid_rate_group.h"
#include "elements/solid_rubber_point.h"

namespace plash {

std::unique_ptr<SolidGroup> make_rubber_solids(const Record& material, const Record* equation_of_state,
                                               SolidSetup setup, State& state)
{
    refuse_equation_of_state(material, equation_of_state, setup);
    if (setup.eight_points) {
        const Part& part = setup.model.parts[setup.part];
        throw DeckError(part.where, fmt::format("*PART {}: *{} is not supported with fully integrated solids "
                                                "(ELFORM 2, -1, -2); ELFORM 1 is",
                                                part.id, material.keyword));
    }
    const MooneyRivlin law = MooneyRivlin::from_record(material, setup.model);
    setup.parameters.density = law.density;
    setup.shear_modulus = law.shear_modulus();
    setup.parameters.hourglass.shear_modulus = setup.shear_modulus;
    setup.parameters.hourglass.poisson_ratio = law.poisson_ratio;
    constexpr auto centre = SolidGradientRule::centre, mean = SolidGradientRule::mean;
    if (setup.rule == centre) {
        return std::make_unique<SolidOnePoint<RubberPoint<centre>, centre>>(RubberPoint<centre>{law},
                                                                            std::move(setup), state);
    }
    return std::make_unique<SolidOnePoint<RubberPoint<mean>, mean>>(RubberPoint<mean>{law}, std::move(setup),
                                                                    state);
}

} // namespace plash
