#include "elements/thick_shell_group_of_law.h"
#include "materials/crushable_foam.h"

namespace plash {

std::unique_ptr<SolidGroup> make_crushable_foam_thick_shells(const Record& material, SolidSetup setup,
                                                             State& state)
{
    return make_thick_shells_of_law<CrushableFoam>(material, std::move(setup), state);
}

} // namespace plash
