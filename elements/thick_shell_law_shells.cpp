#include "elements/thick_shell_group_of_law.h"
#include "materials/compression_tension.h"
#include "materials/damaged_plasticity.h"
#include "materials/johnson_cook.h"

namespace plash {

std::unique_ptr<SolidGroup> make_johnson_cook_thick_shells(const Record& material, SolidSetup setup,
                                                           State& state)
{
    return make_thick_shells_of_law<JohnsonCook>(material, std::move(setup), state);
}

std::unique_ptr<SolidGroup> make_damaged_plasticity_thick_shells(const Record& material, SolidSetup setup,
                                                                 State& state)
{
    return make_thick_shells_of_law<DamagedPlasticity>(material, std::move(setup), state);
}

std::unique_ptr<SolidGroup> make_compression_tension_thick_shells(const Record& material, SolidSetup setup,
                                                                  State& state)
{
    return make_thick_shells_of_law<CompressionTension>(material, std::move(setup), state);
}

} // namespace plash
