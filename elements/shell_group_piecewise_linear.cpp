#include "elements/shell_group_of_law.h"
#include "materials/piecewise_linear_plasticity.h"

namespace plash {

std::unique_ptr<Term> make_piecewise_linear_shells(const ShellPart& part, ShellFormulation formulation,
                                                   State& state)
{
    return make_shells_of_law<PiecewiseLinearPlasticity>(part, formulation, state);
}

} // namespace plash
