#pragma once

#include "elements/shell_store.h"
#include "materials/composite_damage.h"
#include "materials/elastic.h"
#include "materials/fabric.h"
#include "materials/hill_sheet.h"
#include "materials/laminated_fabric.h"
#include "materials/orthotropic_ply.h"
#include "materials/piecewise_linear_plasticity.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace plash {

/// A law that a ply can have.
using PlyLaw = std::variant<OrthotropicElastic, CompositeDamage, LaminatedFabric, Fabric, Elastic,
                            PiecewiseLinearPlasticity, HillSheet>;

/// Components in axes that are turned by the angle of cosine c and sine s about the normal.
template <class Lane>
inline SymmetricTensor<Lane> in_plane_turn(const SymmetricTensor<Lane>& t, const Lane& c, const Lane& s)
{
    const Lane cc = c * c, ss = s * s, cs = c * s, twice = 2.0 * cs * t.xy;
    return {cc * t.xx + ss * t.yy + twice,         ss * t.xx + cc * t.yy - twice, t.zz,
            cs * (t.yy - t.xx) + (cc - ss) * t.xy, c * t.yz - s * t.zx,           c * t.zx + s * t.yz};
}

/// A stack of plies as the law of a shell: each point through the thickness is a ply with its own law, place,
/// weight and angle. Elements of a group share the sequence of materials; places and angles are theirs.
struct Laminate {
    std::vector<PlyLaw> plies; ///< bottom first

    /// What stands before the history of a ply's own law.
    static constexpr int ply_place = 0, ply_weight = 1, ply_cosine = 2, ply_sine = 3, own = 4;
    static constexpr int most_variables =
        std::max({OrthotropicElastic::history_size + 0, CompositeDamage::history_size + 0,
                  LaminatedFabric::history_size + 0, Fabric::history_size + 0, Elastic::history_size + 0,
                  PiecewiseLinearPlasticity::history_size + 0, HillSheet::history_size + 0});
    static constexpr int history_size = own + most_variables;
    std::array<double, history_size> initial_history() const { return {}; }

    /// Sets places, weights, angles and histories of all plies of a group.
    void start(ShellStore& store) const;

    /// One step of the points of ply `number`; see update_plane_stress in materials/history.h. Stress and
    /// strain are turned into the axes of the ply and back.
    template <class Lane>
    void update_ply(int number, SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                    HistoryView<Lane> history, double time_step) const
    {
        const Lane c = history[ply_cosine], s = history[ply_sine];
        SymmetricTensor<Lane> own_stress = in_plane_turn(stress, c, s),
                              own_strain = in_plane_turn(increment, c, s);
        const HistoryView<Lane> variables{history.values + own};
        const Lane before_a = own_stress.xx, before_b = own_stress.yy;
        const auto update = [&](const auto& law) {
            law.update_plane_stress(own_stress, own_strain, variables, time_step);
            // Orthotropic plies leave the thickness strain to the caller: S_ca and S_cb of their compliance.
            if constexpr (requires { law.plane.thinning_a; }) {
                own_strain.zz = law.plane.thinning_a * (before_a - own_stress.xx) +
                                law.plane.thinning_b * (before_b - own_stress.yy);
            }
        };
        std::visit(update, plies[number]);
        stress = in_plane_turn(own_stress, c, Lane{-s});
        increment.zz = own_strain.zz;
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
};

/// One ply of an element: where its point stands and which way its axis a points.
struct PlyPlace {
    Index material = none;
    double middle = 0;    ///< distance of its middle from the nodes along the normal [length]
    double thickness = 0; ///< [length]
    double angle = 0;     ///< from side 1-2 of the element to the axis a [radian]
};

/// The law of a ply; DeckError for materials that plies cannot have.
PlyLaw ply_law(const Model& model, const Part& part, const Record& material);
double ply_density(const PlyLaw& ply);
/// Plane-stress modulus, for wave speed and hourglass control [stress].
double ply_modulus(const PlyLaw& ply);
/// Angle from the first axis of a mid-surface to the axis a of a material [radian].
/// element_angle  BETA of the element; other than zero it goes before MANGLE or BETA of the material [radian]
/// system         MCID of the element, whose x axis goes before AOPT of the material; `none` without
double ply_angle(const Model& model, const Record& material, const ShellFrame<double>& frame,
                 double element_angle, Index system = none);

/// The plies of an element from the bottom: its layers, or the points of the section's rule for a part of one
/// orthotropic material. Angles: AOPT 0, 2, 3 or a coordinate system of the material (MCID of the element
/// goes before it), the material's MANGLE or BETA (BETA of the element goes before it) and the angle of the
/// layer (ANGLE of the section with ICOMP = 1).
std::vector<PlyPlace> plies_of(const Model& model, Index element);

} // namespace plash
