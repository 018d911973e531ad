#pragma once

#include "elements/shell_laminate.h"
#include "elements/thick_shell_step.h"
#include "materials/orthotropic_solid.h"

#include <variant>
#include <vector>

namespace plash {

/// A law that a ply of a thick shell with stresses of a solid can have.
using SolidPlyLaw = std::variant<OrthotropicSolid, Elastic, PiecewiseLinearPlasticity>;

/// A stack of plies with stresses of solids, like Laminate with those of shells.
struct SolidLaminate {
    std::vector<SolidPlyLaw> plies; ///< bottom first

    static constexpr int ply_place = Laminate::ply_place, ply_weight = Laminate::ply_weight;
    static constexpr int ply_cosine = Laminate::ply_cosine, ply_sine = Laminate::ply_sine,
                         own = Laminate::own;
    static constexpr int history_size = own + PiecewiseLinearPlasticity::history_size;
    std::array<double, history_size> initial_history() const { return {}; }

    double normal_modulus(int number) const
    {
        return std::visit([](const auto& law) { return normal_constants(law).second; }, plies[number]);
    }
    double normal_lambda(int number) const
    {
        return std::visit([](const auto& law) { return normal_constants(law).first; }, plies[number]);
    }

    /// One step of the points of ply `number`; stress and strain are turned into the axes of the ply and
    /// back.
    template <class Lane>
    void update_ply(int number, SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment,
                    HistoryView<Lane> history, double time_step) const
    {
        const Lane c = history[ply_cosine], s = history[ply_sine];
        SymmetricTensor<Lane> own_stress = in_plane_turn(stress, c, s);
        const SymmetricTensor<Lane> own_strain = in_plane_turn(increment, c, s);
        const HistoryView<Lane> variables{history.values + own};
        std::visit([&](const auto& law) { law.update(own_stress, own_strain, variables, time_step); },
                   plies[number]);
        stress = in_plane_turn(own_stress, c, Lane{-s});
    }

    template <class Lane>
    MaskOf<Lane> failed(int number, HistoryView<Lane> history) const
    {
        const HistoryView<Lane> variables{history.values + own};
        return std::visit(
            [&](const auto& law) -> MaskOf<Lane> {
                if constexpr (requires { law.failed(variables); }) {
                    return law.failed(variables);
                } else {
                    return history[ply_weight] < 0.0;
                }
            },
            plies[number]);
    }

    /// Lambda and modulus of ThickLayer.
    static std::pair<double, double> normal_constants(const OrthotropicSolid& law)
    {
        return {0.5 * (law.stiffness_ca + law.stiffness_bc), law.stiffness_c};
    }
    template <class Isotropic>
    static std::pair<double, double> normal_constants(const Isotropic& law)
    {
        const double modulus = law.bulk_modulus() + 4.0 / 3 * law.shear_modulus();
        return {modulus - 2 * law.shear_modulus(), modulus};
    }
};

} // namespace plash
