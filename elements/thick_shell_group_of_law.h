#pragma once

#include "elements/thick_shell_group.h"
#include "elements/thick_shell_groups.h"
#include "elements/thick_shell_settings.h"
#include "materials/parameters.h"

#include <fmt/format.h>

namespace plash {

/// Laws that start all points alike.
struct NothingToStart {
    template <class... Arguments>
    void operator()(Arguments&&...) const
    {}
};

/// The group of a part whose material record is read as Law; with the stresses that its formulation asks for.
/// DeckError when the law does not know them.
template <class Law>
std::unique_ptr<SolidGroup> make_thick_shells_of_law(const Record& material, SolidSetup setup, State& state)
{
    const Model& model = setup.model;
    const Part& part = model.parts[setup.part];
    Law law = Law::from_record(material, model);
    const ThickShellStress stress = thick_shell_stress(model, part);
    ThickShellSettings settings = thick_shell_settings(
        model, part, {law.density, law.young_modulus, law.poisson_ratio}, 0, setup.parameters);
    setup.shear_modulus = settings.shear_modulus;
    if constexpr (requires { law.failure_strain; }) settings.points_fail = law.failure_strain > 0;
    if constexpr (requires { law.fractures(); }) settings.points_fail = law.fractures();

    using Tensor = SymmetricTensor<double>;
    constexpr bool as_shell = requires(const Law& l, Tensor& s, Tensor& e, HistoryView<double> h)
    {
        l.update_plane_stress(s, e, h, 0.0);
    };
    constexpr bool as_solid = requires(const Law& l, Tensor& s, const Tensor& e, HistoryView<double> h)
    {
        l.update(s, e, h, 0.0);
    };
    if constexpr (as_shell) {
        if (stress == ThickShellStress::plane) {
            return std::make_unique<ThickShellGroup<ThickShellStress::plane, Law>>(
                std::move(law), std::move(settings), std::move(setup), state, NothingToStart{});
        }
    }
    if constexpr (as_solid) {
        if (stress == ThickShellStress::solid) {
            return std::make_unique<ThickShellGroup<ThickShellStress::solid, Law>>(
                std::move(law), std::move(settings), std::move(setup), state, NothingToStart{});
        }
    }
    reject_field(thick_shell_section(model, part), "ELFORM",
                 fmt::format("*{} {} of part {} has no stress of {}; use formulation {}", material.keyword,
                             material.id, part.id, as_solid ? "a shell" : "a solid",
                             as_solid ? "3 or 5" : "1 or 2"));
}

} // namespace plash
