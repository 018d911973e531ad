#include "elements/thick_shell_group_of_law.h"
#include "materials/elastic.h"

namespace plash {

std::unique_ptr<SolidGroup> make_elastic_thick_shells(const Record& material, SolidSetup setup, State& state)
{
    return make_thick_shells_of_law<Elastic>(material, std::move(setup), state);
}

} // namespace plash
