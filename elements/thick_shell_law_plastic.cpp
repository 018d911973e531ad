#include "elements/thick_shell_group_of_law.h"
#include "materials/piecewise_linear_plasticity.h"
#include "materials/plastic_kinematic.h"

namespace plash {

std::unique_ptr<SolidGroup> make_plastic_kinematic_thick_shells(const Record& material, SolidSetup setup,
                                                                State& state)
{
    if (PlasticKinematicParameters::from_record(material).has_back_stress())
        return make_thick_shells_of_law<PlasticKinematic<true>>(material, std::move(setup), state);
    return make_thick_shells_of_law<PlasticKinematic<false>>(material, std::move(setup), state);
}

std::unique_ptr<SolidGroup> make_piecewise_linear_thick_shells(const Record& material, SolidSetup setup,
                                                               State& state)
{
    return make_thick_shells_of_law<PiecewiseLinearPlasticity>(material, std::move(setup), state);
}

} // namespace plash
