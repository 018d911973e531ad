#include "elements/shell_group_of_law.h"
#include "materials/johnson_cook.h"

namespace plash {

std::unique_ptr<Term> make_johnson_cook_shells(const ShellPart& part, ShellFormulation formulation,
                                               State& state)
{
    return make_shells_of_law<JohnsonCook>(part, formulation, state);
}

} // namespace plash
