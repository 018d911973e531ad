#pragma once

#include "elements/eroding_law.h"
#include "elements/shell_fully_integrated.h"
#include "elements/shell_group.h"
#include "elements/shell_group_makers.h"
#include "elements/shell_settings.h"
#include "elements/shell_triangle.h"

namespace plash {

/// The group of a part with a law and settings that are complete.
template <class Law>
std::unique_ptr<Term> make_shells_of_settings(const ShellPart& part, ShellFormulation formulation,
                                              ShellSettings settings, Law law, State& state)
{
    const auto make = [&]<class Formulation>(Formulation) -> std::unique_ptr<Term> {
        return std::make_unique<ShellGroup<Formulation, Law>>(part, state, std::move(settings),
                                                              std::move(law));
    };
    switch (formulation) {
    case ShellFormulation::belytschko_tsay:
        return make(BelytschkoTsay{});
    case ShellFormulation::triangle:
        return make(C0Triangle{});
    case ShellFormulation::fully_integrated:
        return make(FullyIntegratedShell{});
    }
    return nullptr;
}

/// The group of a part whose material record is read as Law.
template <class Law>
std::unique_ptr<Term> make_shells_of_law(const ShellPart& part, ShellFormulation formulation, State& state)
{
    const Model& model = part.model;
    const Record& material = model.materials[model.parts[part.part].material];
    Law law = Law::from_record(material, model);
    law.young_modulus *= part.stiffness_share; // what hardens goes by the plastic strain and stays
    ShellSettings settings =
        shell_settings(model, part.part, law.density, law.young_modulus, law.poisson_ratio);
    if (!settings.membrane) settings.reference_offset -= part.offset_share;
    if constexpr (requires { law.failure_strain; }) settings.points_fail = law.failure_strain > 0;
    if constexpr (requires { law.fractures(); }) settings.points_fail = law.fractures();
    if constexpr (requires { law.shortest_step; }) {
        const double length = law.shortest_step * settings.wave_speed;
        settings.shortest_squared_length = length * length;
    }
    const auto criteria = erosion_criteria(model, material);
    if (!criteria) {
        return make_shells_of_settings(part, formulation, std::move(settings), std::move(law), state);
    }
    const int columns =
        formulation == ShellFormulation::fully_integrated ? FullyIntegratedShell::plane_points : 1;
    settings.points_to_erode = criteria->failed_points(columns * settings.rule.size());
    settings.failure_time = criteria->failure_time.value_or(settings.failure_time);
    return make_shells_of_settings(part, formulation, std::move(settings),
                                   ErodingLaw<Law>(std::move(law), *criteria), state);
}

} // namespace plash
