#include "elements/shell_group_of_law.h"
#include "materials/plastic_kinematic.h"

namespace plash {

std::unique_ptr<Term> make_plastic_kinematic_shells(const ShellPart& part, ShellFormulation formulation,
                                                    State& state)
{
    const Record& material = part.model.materials[part.model.parts[part.part].material];
    if (PlasticKinematicParameters::from_record(material).has_back_stress()) {
        return make_shells_of_law<PlasticKinematic<true>>(part, formulation, state);
    }
    return make_shells_of_law<PlasticKinematic<false>>(part, formulation, state);
}

} // namespace plash
