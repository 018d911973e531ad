#include "materials/discrete_beam_law.h"

#include "materials/discrete_beam_laws.h"
#include "materials/parameters.h"

#include <fmt/format.h>
#include <utility>

namespace plash {

namespace {

using LawMaker = std::unique_ptr<DiscreteBeamLaw>(const Record&, const Model&);

/// A new law of discrete beams gets its line here.
constexpr std::pair<std::string_view, LawMaker*> law_makers[] = {
    {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM", make_linear_discrete_beam},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", make_nonlinear_discrete_beam},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", make_plastic_discrete_beam},
    {"MAT_SID_DAMPER_DISCRETE_BEAM", make_sid_damper},
    {"MAT_HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM", make_hydraulic_gas_damper},
    {"MAT_CABLE_DISCRETE_BEAM", make_cable},
    {"MAT_ELASTIC_SPRING_DISCRETE_BEAM", make_spring_beam},
    {"MAT_INELASTIC_SPRING_DISCRETE_BEAM", make_spring_beam},
    {"MAT_ELASTIC_6DOF_SPRING_DISCRETE_BEAM", make_six_spring_beam},
    {"MAT_INELASTIC_6DOF_SPRING_DISCRETE_BEAM", make_six_spring_beam},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", make_general_discrete_beam},
    {"MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM", make_general_discrete_beam},
};

} // namespace

std::unique_ptr<DiscreteBeamLaw> make_discrete_beam_law(const Record& material, const Model& model)
{
    for (const auto& [keyword, maker] : law_makers) {
        if (material.keyword != keyword) continue;
        auto law = maker(material, model);
        law->density = material.real("RO");
        if (law->density < 0)
            reject_field(material, "RO", fmt::format("the density {} is negative", law->density));
        return law;
    }
    std::string names;
    for (const auto& [keyword, maker] : law_makers)
        names += (names.empty() ? "*" : ", *") + std::string(keyword);
    throw DeckError(material.where, fmt::format("*{} {} is not supported for discrete beams (ELFORM 6); "
                                                "there are {}",
                                                material.keyword, material.id, names));
}

Curve odd_curve(const Record& material, const char* field, const Model& model)
{
    return material.integer(field) == 0 ? Curve{} : odd_curve(curve_of(material, field, model).curve);
}

} // namespace plash
