#include "elements/shell_group_of_law.h"
#include "materials/elastic.h"

namespace plash {

std::unique_ptr<Term> make_elastic_shells(const ShellPart& part, ShellFormulation formulation, State& state)
{
    return make_shells_of_law<Elastic>(part, formulation, state);
}

} // namespace plash
