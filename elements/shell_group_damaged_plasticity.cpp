#include "elements/shell_group_of_law.h"
#include "materials/damaged_plasticity.h"

namespace plash {

std::unique_ptr<Term> make_damaged_plasticity_shells(const ShellPart& part, ShellFormulation formulation,
                                                     State& state)
{
    return make_shells_of_law<DamagedPlasticity>(part, formulation, state);
}

} // namespace plash
