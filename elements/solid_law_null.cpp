#include "elements/solid_fluid_point.h"
#include "elements/solid_rate_group.h"
#include "eos/gruneisen.h"
#include "eos/linear_polynomial.h"
#include "eos/tabulated.h"

namespace plash {

namespace {

template <class Eos>
std::unique_ptr<SolidGroup> make_fluid(const NullFluid& fluid, const Record& equation_of_state,
                                       SolidSetup setup, State& state)
{
    FluidPoint<Eos> point{fluid, [&] {
                              if constexpr (requires { Eos::from_record(equation_of_state, setup.model); }) {
                                  return Eos::from_record(equation_of_state, setup.model);
                              } else {
                                  return Eos::from_record(equation_of_state, fluid.density);
                              }
                          }()};
    setup.initial_relative_volume = point.eos.relative_volume;
    return make_point_group(std::move(point), std::move(setup), state);
}

} // namespace

std::unique_ptr<SolidGroup> make_null_solids(const Record& material, const Record* equation_of_state,
                                             SolidSetup setup, State& state)
{
    const Part& part = setup.model.parts[setup.part];
    if (!equation_of_state) {
        throw DeckError(part.where, fmt::format("*PART {}, field EOSID: the solids of *MAT_NULL {} need an "
                                                "equation of state",
                                                part.id, material.id));
    }
    const NullFluid fluid = NullFluid::from_record(material);
    setup.parameters.density = fluid.density;
    SolidHourglass& hourglass = setup.parameters.hourglass;
    if (hourglass.form == SolidHourglass::Form::assumed_strain) {
        // LS-DYNA: viscous for *MAT_NULL, scaled by the viscosity of the material (manual, *HOURGLASS).
        hourglass.form = SolidHourglass::Form::assumed_rate;
        hourglass.shear_modulus = fluid.viscosity;
        hourglass.poisson_ratio = 0.5;
    }
    if (equation_of_state->keyword == "EOS_LINEAR_POLYNOMIAL") {
        return make_fluid<LinearPolynomial>(fluid, *equation_of_state, std::move(setup), state);
    }
    if (equation_of_state->keyword == "EOS_GRUNEISEN") {
        return make_fluid<Gruneisen>(fluid, *equation_of_state, std::move(setup), state);
    }
    if (equation_of_state->keyword == "EOS_TABULATED") {
        return make_fluid<Tabulated>(fluid, *equation_of_state, std::move(setup), state);
    }
    throw DeckError(equation_of_state->where,
                    fmt::format("*{} {} is not supported for the solids of part {}; there are "
                                "EOS_LINEAR_POLYNOMIAL, EOS_GRUNEISEN and EOS_TABULATED",
                                equation_of_state->keyword, equation_of_state->id, part.id));
}

} // namespace plash
