#pragma once

#include "elements/hourglass_shell.h"
#include "elements/shell_pattern.h"
#include "materials/history.h"
#include "math/symmetric_tensor.h"

#include <string>
#include <utility>
#include <vector>

namespace plash {

/// Points through the thickness: place from -1 (bottom) to 1 (top) and weights that sum to one.
struct ThicknessRule {
    std::vector<double> place;
    std::vector<double> weight;

    int size() const { return static_cast<int>(place.size()); }
};

/// What all elements of a shell group share.
struct ShellSettings {
    ThicknessRule rule;
    double shear_factor = 1;     ///< SHRF
    double reference_offset = 0; ///< NLOC: 1 nodes lie on the top surface, -1 on the bottom
    bool thickness_change = false;
    bool warping = false; ///< BWC = 1
    int length_rule = 0;  ///< ISDO
    ShellHourglass hourglass;
    ShellStiffness stiffness;
    bool bulk_viscosity = false; ///< *CONTROL_BULK_VISCOSITY TYPE -1 or -2
    double quadratic_viscosity = 0;
    double linear_viscosity = 0;
    double wave_speed = 0;       ///< of a plane-stress wave [velocity]
    double poisson_ratio = 0;    ///< of the elastic law
    double density = 0;          ///< [mass/volume]
    bool membrane = false;       ///< ELFORM 5, 9: one point, no bending and no transverse shear
    std::string notice;          ///< what the user should know of the formulation; empty: nothing
    bool points_fail = false;    ///< the law has a failure strain
    int points_to_erode = 0;     ///< *MAT_ADD_EROSION: so many failed points take an element; 0: none
    double failure_time = 1e300; ///< FAILTM: all elements go [time]
    /// By how much the mass of an element's volume may fall (as it is stretched without getting thinner)
    /// before TSSFAC has no room for it any more: 1 / share [-], 1 or more.
    double spare_density = 1;
    double shortest_squared_length = 0; ///< elements whose step needs a shorter one are deleted [length^2]
    /// Where a record holds the strains that result files show (STRFLG): six of the innermost, then six of
    /// the outermost points, in the element's frame, means over its columns. 0: nobody wants them.
    int strain_place = 0;
    double column_share = 1; ///< 1 / columns
};

/// Where the values of an element stand in its record: one Lane each, then the points, bottom to top, each
/// with its stresses in the element's frame followed by the law's history.
namespace shell_record {
enum Element {
    thickness,        ///< [length]
    mass_factor,      ///< by which mass scaling has raised the element's mass (1: not); 0: eroded
    reference_volume, ///< at the start [length^3]
    internal_energy,  ///< [energy]
    hourglass_energy, ///< [energy]
    hourglass_force,  ///< three forces and two moments of the last step
    bulk_force = hourglass_force + 5, ///< membrane force of bulk viscosity of the last step [force/length]
    points
};
enum Point { stress_xx, stress_yy, stress_xy, stress_yz, stress_zx, history };
} // namespace shell_record

/// What one step of an element gives back.
template <class Lane>
struct ShellStep {
    CornerPattern<Lane> force, moment;                ///< on the nodes (minus the internal forces)
    Lane squared_length;                              ///< of the step vote [length^2]
    Lane internal_work, hourglass_work, viscous_work; ///< of this step [energy]
};

/// Resultants over the thickness in the element's frame: forces [force/length] and moments [force].
template <class Lane>
struct ShellResultants {
    Lane nxx{}, nyy{}, nxy{}, qx{}, qy{}, mxx{}, myy{}, mxy{};
};

/// Strain increments of the reference plane, changes of curvature, transverse shear (engineering) and
/// hourglass displacements of one step, on the geometry of mid-step.
template <class Lane>
struct ShellIncrement {
    Lane exx, eyy, twice_exy, kxx, kyy, twice_kxy, gyz, gzx;
    ShellHourglassForce<Lane> hourglass;
};

/// The strains of a record; null where there are none.
template <class Lane>
inline Lane* strains_of(const ShellSettings& settings, Lane* record)
{
    return settings.strain_place == 0 ? nullptr : record + settings.strain_place;
}

/// Adds the strain increment of a point to them, if it is one of the two.
template <class Lane>
inline void keep_strain(const ShellSettings& settings, int point, const SymmetricTensor<Lane>& increment,
                        Lane* strains)
{
    for (const int side : {0, 1}) {
        if (point != side * (settings.rule.size() - 1)) continue;
        Lane* const sum = strains + 6 * side;
        put_tensor(sum, tensor_at(sum) + broadcast<Lane>(settings.column_share) * increment);
    }
}

/// One step of the points of one column through the thickness: updates stresses and histories and sums the
/// resultants. Returns the internal work per area of the step (trapezoidal rule).
/// values    of the column's points, bottom to top (shell_record::Point, then the law's history)
/// thinning  receives the strain of the thickness
/// strains   strains_of the elements' record, if `keeps_strains`
template <bool keeps_strains, class Lane, class Law>
inline Lane step_points(const ShellSettings& settings, const Law& law, const ShellIncrement<Lane>& increment,
                        double time_step, Lane thickness_now, Lane* values, ShellResultants<Lane>& resultants,
                        Lane& thinning, [[maybe_unused]] Lane* strains)
{
    using namespace shell_record;
    constexpr int point_size = history + static_cast<int>(Law::history_size);
    const Lane half_thickness = 0.5 * thickness_now;
    Lane work{}, shear_work{};
    thinning = Lane{};
    for (int point = 0; point < settings.rule.size(); ++point, values += point_size) {
        const auto [z, weight] = [&] {
            if constexpr (requires { Law::ply_place; }) {
                return std::pair<Lane, Lane>(values[history + Law::ply_place] * half_thickness,
                                             values[history + Law::ply_weight]);
            } else {
                return std::pair<Lane, double>((settings.rule.place[point] - settings.reference_offset) *
                                                   half_thickness,
                                               settings.rule.weight[point]);
            }
        }();
        SymmetricTensor<Lane> strain{increment.exx + z * increment.kxx,
                                     increment.eyy + z * increment.kyy,
                                     Lane{},
                                     0.5 * (increment.twice_exy + z * increment.twice_kxy),
                                     0.5 * increment.gyz,
                                     0.5 * increment.gzx};
        const SymmetricTensor<Lane> old{values[stress_xx], values[stress_yy], Lane{},
                                        values[stress_xy], values[stress_yz], values[stress_zx]};
        SymmetricTensor<Lane> stress = old;
        if constexpr (requires { Law::ply_place; }) {
            law.update_ply(point, stress, strain, HistoryView<Lane>{values + history}, time_step);
        } else {
            law.update_plane_stress(stress, strain, HistoryView<Lane>{values + history}, time_step);
        }
        values[stress_xx] = stress.xx;
        values[stress_yy] = stress.yy;
        values[stress_xy] = stress.xy;
        values[stress_yz] = stress.yz;
        values[stress_zx] = stress.zx;

        if constexpr (keeps_strains) keep_strain(settings, point, strain, strains);
        const Lane wxx = weight * stress.xx, wyy = weight * stress.yy, wxy = weight * stress.xy;
        resultants.nxx += wxx;
        resultants.nyy += wyy;
        resultants.nxy += wxy;
        resultants.mxx += z * wxx;
        resultants.myy += z * wyy;
        resultants.mxy += z * wxy;
        resultants.qx += weight * stress.zx;
        resultants.qy += weight * stress.yz;
        work += weight * ((old.xx + stress.xx) * strain.xx + (old.yy + stress.yy) * strain.yy +
                          2.0 * (old.xy + stress.xy) * strain.xy);
        shear_work += weight * ((old.yz + stress.yz) * strain.yz + (old.zx + stress.zx) * strain.zx);
        thinning += weight * strain.zz;
    }
    const Lane shear = settings.shear_factor * thickness_now;
    resultants.nxx *= thickness_now;
    resultants.nyy *= thickness_now;
    resultants.nxy *= thickness_now;
    resultants.mxx *= thickness_now;
    resultants.myy *= thickness_now;
    resultants.mxy *= thickness_now;
    resultants.qx *= shear;
    resultants.qy *= shear;
    return half_thickness * (work + (2 * settings.shear_factor) * shear_work);
}

/// step_points with strains, which few runs ask for: apart from the common way, so that this stays as short
/// as it can be.
template <class Lane, class Law>
[[gnu::noinline]] inline Lane
step_points_with_strains(const ShellSettings& settings, const Law& law, const ShellIncrement<Lane>& increment,
                         double time_step, const Lane& thickness_now, Lane* values,
                         ShellResultants<Lane>& resultants, Lane& thinning, Lane* strains)
{
    return step_points<true>(settings, law, increment, time_step, thickness_now, values, resultants, thinning,
                             strains);
}

/// One step of the points of a column; see step_points.
/// strains  null where nobody wants them
template <class Lane, class Law>
inline Lane update_points(const ShellSettings& settings, const Law& law,
                          const ShellIncrement<Lane>& increment, double time_step, Lane thickness_now,
                          Lane* values, ShellResultants<Lane>& resultants, Lane& thinning,
                          Lane* strains = nullptr)
{
    if (strains) [[unlikely]] {
        // Copies: what the compiler sees the address of would not stay in registers on the common way either.
        const ShellIncrement<Lane> own = increment;
        const Lane thickness = thickness_now;
        ShellResultants<Lane> sum;
        Lane thinner;
        const Lane work =
            step_points_with_strains(settings, law, own, time_step, thickness, values, sum, thinner, strains);
        resultants = sum;
        thinning = thinner;
        return work;
    }
    return step_points<false>(settings, law, increment, time_step, thickness_now, values, resultants,
                              thinning, strains);
}

/// Membrane force of the bulk viscosity that *CONTROL_BULK_VISCOSITY TYPE -1 and -2 give to shells: the
/// quadratic and linear terms of von Neumann & Richtmyer (1950) and Landshoff (1955) on the rate of area
/// change in compression, with the square root of the area as length [force/length]. Adds it to the membrane
/// forces and returns its work per area; the record keeps it for the next step.
template <class Lane>
inline Lane add_bulk_viscosity(const ShellSettings& settings, Lane area_strain, Lane area, double time_step,
                               Lane* record, ShellResultants<Lane>& resultants)
{
    const double per_step = time_step > 0 ? 1 / time_step : 0;
    const Lane rate = per_step * min(area_strain, Lane{});
    const Lane length = sqrt(area);
    const Lane pressure = settings.density * length *
                          (settings.quadratic_viscosity * length * rate * rate -
                           settings.linear_viscosity * settings.wave_speed * rate);
    const Lane force = -record[shell_record::thickness] * pressure;
    const Lane work = 0.5 * area_strain * (force + record[shell_record::bulk_force]);
    resultants.nxx += force;
    resultants.nyy += force;
    record[shell_record::bulk_force] = force;
    return work;
}

/// Squared length that an eroded element votes with: limits nothing.
inline constexpr double eroded_length = 1e300;

/// Clears forces and vote of the elements that are not alive.
template <class Lane>
inline void silence(const MaskOf<Lane>& alive, ShellStep<Lane>& step)
{
    for (CornerPattern<Lane>* pattern : {&step.force, &step.moment}) {
        for (Vector3<Lane>* vector :
             {&pattern->diagonal13, &pattern->diagonal24, &pattern->alternating, &pattern->sum}) {
            *vector = {alive ? vector->x : Lane{}, alive ? vector->y : Lane{}, alive ? vector->z : Lane{}};
        }
    }
    step.squared_length = alive ? step.squared_length : broadcast<Lane>(eroded_length);
}

/// Clears what eroded elements would give: their geometry may be beyond all bounds.
template <class Lane>
inline void silence_eroded(Lane mass_factor_now, ShellStep<Lane>& step)
{
    const MaskOf<Lane> alive = mass_factor_now > 0.0;
    silence(alive, step);
    const auto keep = [&](Lane& value) { value = alive ? value : Lane{}; };
    keep(step.internal_work);
    keep(step.hourglass_work);
    keep(step.viscous_work);
}

/// What of its squared length an element may vote with: waves in one that has been stretched without getting
/// as much thinner (ISTUPD = 0: it keeps its thickness) are faster than those of its density, as its mass
/// stays.
template <class Lane>
inline Lane stretched_share(const ShellSettings& settings, const Lane& reference_volume, const Lane& volume)
{
    return min(broadcast<Lane>(1.0), settings.spare_density * reference_volume / volume);
}

/// What ends every step: the vote, silence of eroded elements, energies into the record.
template <class Lane>
inline void finish_step(const ShellSettings& settings, const CornerPattern<Lane>& position, Lane area,
                        Lane* record, ShellStep<Lane>& step)
{
    const Lane factor = record[shell_record::mass_factor];
    const Lane share = stretched_share(settings, record[shell_record::reference_volume],
                                       Lane{area * record[shell_record::thickness]});
    step.squared_length = factor * share * squared_length(position, area, settings.length_rule);
    if (any(factor == Lane{})) silence_eroded(factor, step);
    record[shell_record::internal_energy] += step.internal_work;
    record[shell_record::hourglass_energy] += step.hourglass_work;
}

/// Positions at the middle of the step that has just ended (the sum is not looked at and left out).
template <class Lane>
inline CornerPattern<Lane> mid_step(const CornerPattern<Lane>& position, const CornerPattern<Lane>& velocity,
                                    double time_step)
{
    const Lane back = broadcast<Lane>(0.5 * time_step);
    return {position.diagonal13 - back * velocity.diagonal13,
            position.diagonal24 - back * velocity.diagonal24,
            position.alternating - back * velocity.alternating,
            {}};
}

} // namespace plash
