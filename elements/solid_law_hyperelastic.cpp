#include "elements/solid_deformation_group.h"
#include "materials/rubber.h"

#include <algorithm>

namespace plash {

namespace {

/// Without a Prony series the elements carry no variables for it.
template <class Energy>
std::unique_ptr<SolidGroup> make_series_rubber(const Record& material, const Record* equation_of_state,
                                               const Rubber<Energy, most_rubber_branches>& law,
                                               SolidSetup setup, State& state)
{
    const double shear = law.energy.shear_modulus();
    const bool relaxes = std::any_of(law.series.begin(), law.series.end(),
                                     [](const MaxwellElement& element) { return element.modulus != 0; });
    if (relaxes) {
        return make_deformation_group(material, equation_of_state, law, shear, law.poisson_ratio,
                                      std::move(setup), state);
    }
    const Rubber<Energy, 0> elastic{law.density, law.poisson_ratio, law.bulk_modulus, law.energy, {}};
    return make_deformation_group(material, equation_of_state, elastic, shear, law.poisson_ratio,
                                  std::move(setup), state);
}

} // namespace

std::unique_ptr<SolidGroup> make_ogden_solids(const Record& material, const Record* equation_of_state,
                                              SolidSetup setup, State& state)
{
    return make_series_rubber(material, equation_of_state, ogden_rubber(material), std::move(setup), state);
}

std::unique_ptr<SolidGroup> make_hyperelastic_solids(const Record& material, const Record* equation_of_state,
                                                     SolidSetup setup, State& state)
{
    const auto law = polynomial_rubber(material, setup.model);
    return make_series_rubber(material, equation_of_state, law, std::move(setup), state);
}

} // namespace plash
