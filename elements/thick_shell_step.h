#pragma once

#include "elements/shell_kernel.h"
#include "elements/solid_step.h"
#include "elements/thick_shell_kinematics.h"

#include <array>
#include <string>
#include <vector>

namespace plash {

/// What all thick shells of a group share.
struct ThickShellSettings {
    enum class Hourglass { none, viscous, stiffness };

    ThicknessRule rule;              ///< points through the thickness
    std::vector<double> shear_share; ///< transverse shear of each of these points over its mean (TSHEAR)
    int columns = 1;                 ///< 1, or 4 (2 x 2 points in the plane)
    double shear_factor = 1;         ///< SHRF
    Hourglass hourglass = Hourglass::stiffness;
    double hourglass_coefficient = 0.1;
    double young_modulus = 0; ///< elastic, of the thickness and of hourglass control [stress]
    double poisson_ratio = 0;
    double shear_modulus = 0; ///< [stress]
    double wave_speed = 0;    ///< [velocity]
    bool bulk_viscosity = false;
    bool points_fail = false; ///< the law has a failure strain
    bool strains = false;     ///< those of the innermost and outermost points are kept for result files
};

/// Where the points stand in the history of a thick shell: behind the mean plastic strain, column after
/// column and each from the bottom; six stresses in the frame of the mid-surface, then the history of the
/// law. The first hourglass variables of SolidHistory hold what the nine hourglass modes exert.
inline constexpr int first_thick_point = point_history + 1;

template <class Law>
inline constexpr int thick_point_size = 6 + static_cast<int>(Law::history_size);

/// Length of the history: behind the points stand, where they are wanted, twelve strains as in a shell's
/// record (ShellSettings::strain_place).
template <class Law>
inline int thick_history_size(const ThickShellSettings& settings)
{
    return first_thick_point + settings.columns * settings.rule.size() * thick_point_size<Law> +
           (settings.strains ? 12 : 0);
}

/// Whether a law gives stresses of a shell (types 1 and 2) or of a solid (types 3 and 5).
enum class ThickShellStress { plane, solid };

/// One layer of a column as relax_layers sees it.
template <class Lane>
struct ThickLayer {
    Lane weight; ///< share of the thickness
    Lane plane;  ///< strains in the plane, xx + yy
    Lane stress; ///< normal stress before the step [stress]
    double lambda = 0,
           modulus; ///< elastic: normal stress by `plane` and by the strain of the thickness [stress]
};

/// Strains of the layers of a column along the thickness, for laws of solids.
///
/// Layers lie in series: each step strains them so that elastic layers end with one normal stress. Bending
/// then strains the thickness by Poisson's ratio without a normal stress, and a soft layer takes the strain
/// of a stack (Felippa 2013, Advanced Finite Element Methods, ch. 32, 'uniform thickness stress', here layer
/// by layer and step by step). In plastic flow what is left of the differences shrinks from step to step,
/// since no tangent is stiffer than the elastic modulus. layer_of(i)  ThickLayer strain       of each layer,
/// with the weighted mean `mean_strain`
template <class Lane, class LayerOf>
inline void relax_layers(int layers, const Lane& mean_strain, LayerOf&& layer_of, Lane* strain)
{
    Lane compliance{}, sum{};
    for (int i = 0; i < layers; ++i) {
        const ThickLayer<Lane> layer = layer_of(i);
        strain[i] = (-1 / layer.modulus) * (layer.stress + layer.lambda * layer.plane);
        compliance += (1 / layer.modulus) * layer.weight;
        sum += layer.weight * strain[i];
    }
    const Lane stress = (mean_strain - sum) / compliance;
    for (int i = 0; i < layers; ++i) strain[i] += (1 / layer_of(i).modulus) * stress;
}

/// Stiffness and mass of the nine hourglass modes of an element of isotropic elastic material, as 2 x 2
/// columns would have them: force by mode, and mass by rate of the mode.
template <class Lane>
inline void hourglass_constants(const ThickShellSettings& settings, const ThickShellFrame<Lane>& frame,
                                const Lane& mass, Lane* stiffness, Lane* inertia)
{
    const BilinearMap<Lane>& map = frame.map;
    const Lane volume = frame.mean.volume, per_area = 4.0 / frame.surface.area; // 1 / J
    const Lane ax = per_area * map.by, ay = per_area * map.bx, bx = per_area * map.ay, by = per_area * map.ax;
    // Mean squares of the gradient of xi eta over the points of the plane, and of c.
    const double third = 1.0 / 3;
    const Lane along_x = third * (ax * ax + bx * bx), along_y = third * (ay * ay + by * by);
    const Lane stretch = settings.young_modulus * volume;
    stiffness[0] = stretch * along_x;
    stiffness[1] = stretch * along_y;
    stiffness[2] = third * stiffness[0];
    stiffness[3] = third * stiffness[1];
    const Lane shear = (third * settings.shear_factor * settings.shear_modulus) * volume;
    stiffness[4] = shear * (ax * ax + ay * ay);
    stiffness[5] = shear * (bx * bx + by * by);
    stiffness[6] = stiffness[7] = third * stretch;
    stiffness[8] = third * third * stretch;
    // A mode s = d . q with q eight times an amplitude moves the mass with (s / 8 |d|)^2.
    const auto& p = frame.linear;
    const Lane of_shear = (1.0 / 32) * frame.inverse_thickness;
    const Lane of_thickness = 2.0 * of_shear * frame.inverse_thickness;
    const auto along = [&](const Lane& factor, const Lane& square) {
        return mass / (64.0 * factor * factor * square);
    };
    const Lane z = dot(p[2], p[2]);
    for (int mode = 0; mode < 4; ++mode) inertia[mode] = mass;
    inertia[4] = along(of_shear, dot(p[0], p[0]) + z);
    inertia[5] = along(of_shear, dot(p[1], p[1]) + z);
    inertia[6] = inertia[7] = inertia[8] = along(of_thickness, z);
}

/// Adds the forces of hourglass control to `forces` and returns their work over the step.
/// stored  forces of the last step, in and out
template <class Lane>
inline Lane add_hourglass(const ThickShellSettings& settings, const ThickShellFrame<Lane>& frame,
                          const Lane& mass, ThickShellModes<Lane>& change, double time_step, Lane* stored,
                          ThickShellModes<Lane>& forces)
{
    Lane stiffness[thick_shell_hourglass_modes], inertia[thick_shell_hourglass_modes];
    hourglass_constants(settings, frame, mass, stiffness, inertia);
    const auto changes = hourglass_of(change), conjugates = hourglass_of(forces);
    const bool viscous = settings.hourglass == ThickShellSettings::Hourglass::viscous;
    const double per_step = time_step > 0 ? 1 / time_step : 0;
    Lane work{};
    for (int mode = 0; mode < thick_shell_hourglass_modes; ++mode) {
        const Lane old = stored[mode];
        if (viscous) {
            stored[mode] = (settings.hourglass_coefficient * per_step) *
                           sqrt(stiffness[mode] * inertia[mode]) * *changes[mode];
        } else {
            stored[mode] += settings.hourglass_coefficient * stiffness[mode] * *changes[mode];
        }
        *conjugates[mode] += stored[mode];
        work += 0.5 * (old + stored[mode]) * *changes[mode];
    }
    return work;
}

/// One step of a batch of thick shells; arguments as in solid_step, `history` as first_thick_point says.
///
/// With ThickShellStress::plane (types 1 and 2) each point has the stress of a shell, and the thickness a
/// normal stress of its own, Young's modulus times its strain, that knows nothing of strains in the plane.
/// With ThickShellStress::solid (types 3 and 5) each point has the stress of a solid. Strains are those of
/// the geometry in the middle of the step, forces those of its end, as for shells.
template <ThickShellStress kind, class Lane, class Law>
inline SolidResult<Lane> thick_shell_step(const Law& law, const ThickShellSettings& settings,
                                          const SolidParameters& parameters, const SolidModes<Lane>& position,
                                          const SolidModes<Lane>& velocity, double time_step, Lane* history,
                                          const Lane* constants)
{
    constexpr int size = thick_point_size<Law>;
    constexpr int most_layers = 64;
    constexpr double place = 0.57735026918962576; // 1 / sqrt(3)
    SolidVote<Lane> vote;
    const ThickShellFrame<Lane> middle = thick_shell_frame(moved(position, -0.5 * time_step, velocity));
    const ThickShellFrame<Lane> now = thick_shell_frame(position);
    vote.inverted =
        min(min(middle.centre.volume, now.centre.volume), min(middle.mean.volume, now.mean.volume)) <= 0.0;
    ThickShellModes<Lane> change = thick_shell_modes(middle, velocity, time_step), forces;

    const int layers = settings.rule.size();
    const double per_column = 4.0 / settings.columns;
    const Lane weight_middle = per_column / middle.inverse_thickness,
               weight = per_column / now.inverse_thickness;
    const double nu = settings.poisson_ratio;
    const double modulus = settings.young_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    const double lambda = modulus * nu / (1 - nu);
    SymmetricTensor<Lane> mean{};
    Lane plastic_strain{}, work{};
    MaskOf<Lane> failed = middle.mean.volume == middle.mean.volume;
    Lane* values = history + first_thick_point;
    Lane thickness_strain[most_layers];
    for (int column = 0; column < settings.columns; ++column) {
        const double xi = settings.columns == 1 ? 0 : column == 0 || column == 3 ? -place : place;
        const double eta = settings.columns == 1 ? 0 : column < 2 ? -place : place;
        const MapAtPoint<Lane> map_middle = map_at(middle.map, xi, eta), map = map_at(now.map, xi, eta);
        const ThickShellPlane<Lane> strain = at_column(change, map_middle, xi, eta, nu);
        const auto place_of = [&](int layer) -> Lane {
            if constexpr (requires { Law::ply_place; }) return values[layer * size + 6 + Law::ply_place];
            return broadcast<Lane>(settings.rule.place[layer]);
        };
        const auto weight_of = [&](int layer) -> Lane {
            if constexpr (requires { Law::ply_weight; }) return values[layer * size + 6 + Law::ply_weight];
            return broadcast<Lane>(settings.rule.weight[layer]);
        };
        if constexpr (kind == ThickShellStress::solid) {
            const auto layer_of = [&](int layer) {
                const Lane plane = strain.exx + strain.eyy + place_of(layer) * (strain.kxx + strain.kyy);
                ThickLayer<Lane> result{weight_of(layer), plane, values[layer * size + 2], lambda, modulus};
                if constexpr (requires { law.normal_modulus(layer); }) {
                    result.lambda = law.normal_lambda(layer);
                    result.modulus = law.normal_modulus(layer);
                }
                return result;
            };
            relax_layers(layers, strain.ezz, layer_of, thickness_strain);
        }
        ThickShellPlane<Lane> resultant{};
        Lane power{}, shear_power{}, normal_before{};
        for (int layer = 0; layer < layers; ++layer) {
            const Lane c = place_of(layer), share = weight_of(layer);
            Lane* const point = values + layer * size;
            const double shear = settings.shear_share[layer];
            const SymmetricTensor<Lane> old = tensor_at(point);
            SymmetricTensor<Lane> increment{strain.exx + c * strain.kxx,
                                            strain.eyy + c * strain.kyy,
                                            kind == ThickShellStress::solid ? thickness_strain[layer]
                                                                            : Lane{},
                                            0.5 * (strain.twice_exy + c * strain.twice_kxy),
                                            (0.5 * shear) * strain.gyz,
                                            (0.5 * shear) * strain.gzx};
            SymmetricTensor<Lane> stress = old;
            const HistoryView<Lane> variables{point + 6};
            if constexpr (kind == ThickShellStress::solid) {
                if constexpr (requires { Law::ply_place; }) {
                    law.update_ply(layer, stress, increment, variables, time_step);
                } else {
                    law.update(stress, increment, variables, time_step);
                }
            } else {
                stress.zz = Lane{};
                if constexpr (requires { Law::ply_place; }) {
                    law.update_ply(layer, stress, increment, variables, time_step);
                } else {
                    law.update_plane_stress(stress, increment, variables, time_step);
                }
                stress.zz = old.zz + settings.young_modulus * strain.ezz;
            }
            if (settings.strains) {
                if constexpr (kind == ThickShellStress::plane) increment.zz = strain.ezz;
                Lane* const strains = history + thick_history_size<Law>(settings) - 12;
                for (const int side : {0, 1}) {
                    if (layer != side * (layers - 1)) continue;
                    put_tensor(strains + 6 * side, tensor_at(strains + 6 * side) +
                                                       broadcast<Lane>(1.0 / settings.columns) * increment);
                }
            }
            if constexpr (requires { law.failed(variables); }) failed &= law.failed(variables);
            if constexpr (requires { Law::ply_place; }) failed &= law.failed(layer, variables);
            if constexpr (requires { Law::plastic_strain; }) {
                plastic_strain += (1.0 / settings.columns) * share * variables[Law::plastic_strain];
            }
            put_tensor(point, stress);
            const SymmetricTensor<Lane> both = old + stress, weighted = share * stress;
            resultant.exx += weighted.xx;
            resultant.eyy += weighted.yy;
            resultant.twice_exy += weighted.xy;
            resultant.kxx += c * weighted.xx;
            resultant.kyy += c * weighted.yy;
            resultant.twice_kxy += c * weighted.xy;
            resultant.ezz += weighted.zz;
            normal_before += share * old.zz;
            resultant.gyz += shear * weighted.yz;
            resultant.gzx += shear * weighted.zx;
            power += share * (both.xx * increment.xx + both.yy * increment.yy + 2.0 * both.xy * increment.xy);
            shear_power += share * (both.yz * increment.yz + both.zx * increment.zx);
            mean = mean + broadcast<Lane>(1.0 / settings.columns) * weighted;
        }
        // The strains that relax the layers do no work on the nodes.
        power += (normal_before + resultant.ezz) * strain.ezz + (2 * settings.shear_factor) * shear_power;
        resultant.gyz *= settings.shear_factor;
        resultant.gzx *= settings.shear_factor;
        work += 0.5 * weight_middle * map_middle.area * power;
        add_column(resultant, map, xi, eta, nu, weight, forces);
        values += layers * size;
    }
    if (settings.points_fail) vote.failed = failed;

    const Lane speed = broadcast<Lane>(settings.wave_speed);
    const Lane volume = vote.inverted ? constants[mass_constant] * (1 / parameters.density) : now.mean.volume;
    const Lane crossing = volume / sqrt(largest_face_squared(position));
    vote.viscous_work = Lane{};
    if (settings.bulk_viscosity) {
        const Lane expansion = change.exx + change.eyy + change.ezz;
        const Lane rate = (time_step > 0 ? 1 / time_step : 0) * expansion;
        const Lane inverse_length = inverse_cube_root(volume),
                   length = volume * inverse_length * inverse_length;
        const Lane viscosity =
            parameters.viscosity.pressure(constants[mass_constant] / volume, length, speed, rate);
        vote.viscous_work = -0.5 * (viscosity + history[viscosity_history]) * expansion * middle.mean.volume;
        history[viscosity_history] = viscosity;
        forces.exx -= now.mean.volume * viscosity;
        forces.eyy -= now.mean.volume * viscosity;
        forces.ezz -= now.mean.volume * viscosity;
        vote.stable_step = parameters.viscosity.stable_step(crossing, length, speed, rate);
    } else {
        vote.stable_step = crossing / speed;
    }
    history[internal_energy_history] += vote.inverted ? Lane{} : work + vote.viscous_work;
    if (settings.hourglass != ThickShellSettings::Hourglass::none) {
        const Lane hourglass = add_hourglass(settings, middle, constants[mass_constant], change, time_step,
                                             history + hourglass_history, forces);
        history[hourglass_energy_history] += vote.inverted ? Lane{} : hourglass;
    }
    const Tensor3<Lane>& r = now.axes;
    mean = rotated(mean, Tensor3<Lane>{r.xx, r.yx, r.zx, r.xy, r.yy, r.zy, r.xz, r.yz, r.zz});
    put_tensor(history, mean);
    history[point_history] = plastic_strain;
    return {thick_shell_forces(now, forces), vote};
}

} // namespace plash
