#include "elements/solid_equation_of_state.h"
#include "elements/solid_explosive_point.h"
#include "elements/solid_rate_group.h"

#include <type_traits>

namespace plash {

namespace {

/// Equations of state that make sense for the products of an explosive: each costs a compiled kernel.
template <class Eos>
constexpr bool is_gas =
    std::is_same_v<Eos, Jwl> || std::is_same_v<Eos, LinearPolynomial> || std::is_same_v<Eos, IdealGas>;

} // namespace

std::unique_ptr<SolidGroup> make_high_explosive_solids(const Record& material,
                                                       const Record* equation_of_state, SolidSetup setup,
                                                       State& state)
{
    const Record& needed = need_equation_of_state(material, equation_of_state, setup);
    const HighExplosive law = HighExplosive::from_record(material);
    setup.parameters.density = law.density;
    setup.shear_modulus = law.shear_modulus;
    SolidHourglass& hourglass = setup.parameters.hourglass;
    if (hourglass.form != SolidHourglass::Form::none && hourglass.form != SolidHourglass::Form::viscous) {
        hourglass.form = SolidHourglass::Form::viscous;
        setup.notice = fmt::format("explosive of part {}: viscous hourglass control in place of stiffness, "
                                   "which would hold together what flows apart",
                                   setup.model.parts[setup.part].id);
    }
    const std::vector<Detonator> detonators = detonators_of(setup.model, setup.model.parts[setup.part]);
    return with_equation_of_state(
        needed, law.density, setup, [&]<class Eos>(const Eos& eos) -> std::unique_ptr<SolidGroup> {
            if constexpr (is_gas<Eos>) {
                return make_point_group(ExplosivePoint<Eos>{law, eos, detonators}, std::move(setup), state);
            } else {
                throw DeckError(needed.where,
                                fmt::format("*{} {}: the products of an explosive have EOS_JWL, "
                                            "EOS_LINEAR_POLYNOMIAL or EOS_IDEAL_GAS",
                                            needed.keyword, needed.id));
            }
        });
}

} // namespace plash
