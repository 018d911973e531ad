#pragma once

#include "elements/solid_step.h"

namespace plash {

/// What a fully integrated hexahedron does about bending with elements that are longer than thick.
enum class SolidShear {
    full,      ///< ELFORM 2: as the shape functions say
    scaled,    ///< ELFORM -2: shear of bending modes as in a cube, by scale factors of the side lengths
    cancelled, ///< ELFORM -1: no shear of bending modes
};

inline constexpr int solid_gauss_points = 8;

/// Variables of one of the eight points: stress, then those of the material point.
template <class Point>
inline constexpr int eight_point_size = 6 + Point::history_size;

/// Where the points stand in the history of a fully integrated solid: behind the mean plastic strain, which
/// results show. The hourglass variables of SolidHistory stay zero.
inline constexpr int first_gauss_point = point_history + 1;

/// Natural gradient vectors (g^a, g^b, g^c) at a point and its volume, for the modes of the positions.
template <class Lane>
struct NaturalFrame {
    Vector3<Lane> g[3]; ///< gradients of the natural coordinates [1/length]
    Lane volume;        ///< of the point: determinant of the Jacobian [volume]
};

/// Factors of the bilinear terms in the natural derivatives: along j, the term that grows with k. One but for
/// SolidShear::scaled.
template <class Lane>
struct ShearScale {
    Lane ab, ba, bc, cb, ca, ac;
};

/// Scale factors that leave everything as it is.
template <class Lane>
inline ShearScale<Lane> no_scale()
{
    const Lane one = broadcast<Lane>(1.0);
    return {one, one, one, one, one, one};
}

/// Scale factors min(1, l_j / l_k) of the side lengths: a long plate then bends as a cube does.
template <class Lane>
inline ShearScale<Lane> shear_scale(SolidShear shear, const SolidModes<Lane>& position)
{
    if (shear != SolidShear::scaled) return no_scale<Lane>();
    const Lane one = broadcast<Lane>(1.0);
    const auto& s = position.linear;
    const Lane a = dot(s[0], s[0]), b = dot(s[1], s[1]), c = dot(s[2], s[2]);
    const auto factor = [&](const Lane& j, const Lane& k) { return sqrt(min(one, j / k)); };
    return {factor(a, b), factor(b, a), factor(b, c), factor(c, b), factor(c, a), factor(a, c)};
}

/// Natural coordinates of a Gauss point.
struct GaussPoint {
    double a, b, c;
};

inline GaussPoint gauss_point(int number)
{
    constexpr double place = 0.57735026918962576451; // 1 / sqrt(3)
    return {number & 1 ? place : -place, number & 2 ? place : -place, number & 4 ? place : -place};
}

template <class Lane>
inline NaturalFrame<Lane> natural_frame(const SolidModes<Lane>& x, const GaussPoint& p)
{
    const auto& [bc, ca, ab, abc] = x.hourglass;
    const Lane eighth = broadcast<Lane>(0.125);
    const Lane a = broadcast<Lane>(p.a), b = broadcast<Lane>(p.b), c = broadcast<Lane>(p.c);
    const Vector3<Lane> by_a = eighth * (x.linear[0] + b * ab + c * ca + (b * c) * abc);
    const Vector3<Lane> by_b = eighth * (x.linear[1] + a * ab + c * bc + (c * a) * abc);
    const Vector3<Lane> by_c = eighth * (x.linear[2] + b * bc + a * ca + (a * b) * abc);
    const Vector3<Lane> across = cross(by_b, by_c);
    NaturalFrame<Lane> frame;
    frame.volume = dot(by_a, across);
    const Lane inverse = 1.0 / frame.volume;
    frame.g[0] = inverse * across;
    frame.g[1] = inverse * cross(by_c, by_a);
    frame.g[2] = inverse * cross(by_a, by_b);
    return frame;
}

/// How the hourglass modes of a field enter its gradient at one point, and back from stress to mode forces.
/// All modes are sums over corners, so the gradients carry the factor 1/8 of the shape functions.
template <class Lane>
struct ModeGradients {
    Vector3<Lane> bc, ca, ab, abc; ///< [1/length]
};

template <class Lane>
inline ModeGradients<Lane> mode_gradients(const NaturalFrame<Lane>& f, const GaussPoint& p,
                                          const ShearScale<Lane>& k)
{
    const Vector3<Lane> a = broadcast<Lane>(0.125) * f.g[0], b = broadcast<Lane>(0.125) * f.g[1],
                        c = broadcast<Lane>(0.125) * f.g[2];
    return {(p.c * k.bc) * b + (p.b * k.cb) * c, (p.c * k.ac) * a + (p.a * k.ca) * c,
            (p.b * k.ab) * a + (p.a * k.ba) * b,
            (p.b * p.c * k.ab * k.ac) * a + (p.c * p.a * k.ba * k.bc) * b + (p.a * p.b * k.ca * k.cb) * c};
}

/// Velocity gradient that the hourglass rates q add at a point.
template <class Lane>
inline Tensor3<Lane> hourglass_gradient(const ModeGradients<Lane>& h, const HourglassVectors<Lane>& q)
{
    Tensor3<Lane> l;
    l.add_dyad(q[0], h.bc);
    l.add_dyad(q[1], h.ca);
    l.add_dyad(q[2], h.ab);
    l.add_dyad(q[3], h.abc);
    return l;
}

/// The same without the shear of bending: in the axes of the element, the component i of a mode that varies
/// along i counts only by its derivative along i.
/// axes  rows are the element's axes; q has its components along them
template <class Lane>
inline Tensor3<Lane> bending_gradient(const NaturalFrame<Lane>& f, const GaussPoint& p,
                                      const Tensor3<Lane>& axes, const HourglassVectors<Lane>& q)
{
    const auto& [bc, ca, ab, abc] = q;
    const Vector3<Lane> a = broadcast<Lane>(0.125) * f.g[0], b = broadcast<Lane>(0.125) * f.g[1],
                        c = broadcast<Lane>(0.125) * f.g[2];
    Tensor3<Lane> l;
    l.add_dyad({axes.xx, axes.xy, axes.xz},
               (p.c * ca.x + p.b * ab.x + (p.b * p.c) * abc.x) * a + (p.c * bc.x) * b + (p.b * bc.x) * c);
    l.add_dyad({axes.yx, axes.yy, axes.yz},
               (p.c * bc.y + p.a * ab.y + (p.c * p.a) * abc.y) * b + (p.c * ca.y) * a + (p.a * ca.y) * c);
    l.add_dyad({axes.zx, axes.zy, axes.zz},
               (p.b * bc.z + p.a * ca.z + (p.a * p.b) * abc.z) * c + (p.b * ab.z) * a + (p.a * ab.z) * b);
    return l;
}

template <class Lane>
inline Vector3<Lane> times(const SymmetricTensor<Lane>& s, const Vector3<Lane>& v)
{
    return {s.xx * v.x + s.xy * v.y + s.zx * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z,
            s.zx * v.x + s.yz * v.y + s.zz * v.z};
}

/// Transpose of hourglass_gradient: adds the mode forces of a stress times volume.
template <class Lane>
inline void add_mode_forces(const ModeGradients<Lane>& h, const SymmetricTensor<Lane>& stress,
                            HourglassVectors<Lane>& force)
{
    force[0] += times(stress, h.bc);
    force[1] += times(stress, h.ca);
    force[2] += times(stress, h.ab);
    force[3] += times(stress, h.abc);
}

/// Transpose of bending_gradient; forces have their components along the element's axes.
template <class Lane>
inline void add_bending_forces(const NaturalFrame<Lane>& f, const GaussPoint& p, const Tensor3<Lane>& axes,
                               const SymmetricTensor<Lane>& stress, HourglassVectors<Lane>& force)
{
    const Vector3<Lane> a = broadcast<Lane>(0.125) * f.g[0], b = broadcast<Lane>(0.125) * f.g[1],
                        c = broadcast<Lane>(0.125) * f.g[2];
    auto& [bc, ca, ab, abc] = force;
    const Vector3<Lane> tx = times(stress, Vector3<Lane>{axes.xx, axes.xy, axes.xz});
    const Vector3<Lane> ty = times(stress, Vector3<Lane>{axes.yx, axes.yy, axes.yz});
    const Vector3<Lane> tz = times(stress, Vector3<Lane>{axes.zx, axes.zy, axes.zz});
    const Lane ax = dot(a, tx), bx = dot(b, tx), cx = dot(c, tx);
    const Lane ay = dot(a, ty), by = dot(b, ty), cy = dot(c, ty);
    const Lane az = dot(a, tz), bz = dot(b, tz), cz = dot(c, tz);
    ca.x += p.c * ax;
    ab.x += p.b * ax;
    abc.x += (p.b * p.c) * ax;
    bc.x += p.c * bx + p.b * cx;
    bc.y += p.c * by;
    ab.y += p.a * by;
    abc.y += (p.c * p.a) * by;
    ca.y += p.c * ay + p.a * cy;
    bc.z += p.b * cz;
    ca.z += p.a * cz;
    abc.z += (p.a * p.b) * cz;
    ab.z += p.b * az + p.a * bz;
}

/// One step of a batch of hexahedra with 2 x 2 x 2 points and a mean volume strain (selective-reduced
/// integration; Hughes 1980, Int. J. Numer. Meth. Engng 15, 1413-1418; Nagtegaal, Parks & Rice 1974). ELFORM
/// -1 and -2 are after Borrvall (2009, 7th European LS-DYNA Conference, 'A heuristic attempt to reduce
/// transverse shear locking in fully integrated hexahedra with poor aspect ratio'). The velocity is split
/// into its linear field at the centre and hourglass modes orthogonal to it; only these are scaled or cut, so
/// that rigid and linear motion stay exact on any shape.
///
/// The stable step counts the linear bulk viscosity also at rest, as LS-DYNA does for these elements (its
/// first step of the preloaded bolt flange).
///
/// Arguments as in solid_step. history: SolidHistory with the mean stress, mean plastic strain, then the
/// points.
template <class Lane, class Point>
inline SolidResult<Lane> eight_point_step(const Point& point, const SolidParameters& parameters,
                                          SolidShear shear, const SolidModes<Lane>& position,
                                          const SolidModes<Lane>& velocity, double time_step, Lane* history,
                                          const Lane* constants)
{
    SolidVote<Lane> vote;
    const Lane step = broadcast<Lane>(time_step);
    const SolidModes<Lane> middle = moved(position, -0.5 * time_step, velocity);
    const ShearScale<Lane> scale_middle = shear_scale(shear, middle), scale = shear_scale(shear, position);
    const bool cancelled = shear == SolidShear::cancelled, changed = shear != SolidShear::full;

    // Linear field at the centre and what is left of the modes.
    const SolidGradient<Lane, SolidGradientRule::centre> centre =
        gradient_of<SolidGradientRule::centre>(middle);
    const SolidGradient<Lane, SolidGradientRule::centre> centre_now =
        gradient_of<SolidGradientRule::centre>(position);
    vote.inverted = min(centre.volume, centre_now.volume) <= 0.0;
    const Lane reference_volume = constants[mass_constant] * (1 / parameters.density);
    const Lane centre_volume = vote.inverted ? reference_volume : centre.volume;
    const Tensor3<Lane> linear = (1.0 / centre_volume) * volume_gradient(centre, velocity);
    const HourglassVectors<Lane> rate = hourglass_rates(true, middle, velocity, linear);
    const Tensor3<Lane> axes_middle = element_axes(middle), axes = element_axes(position);
    const HourglassVectors<Lane> local_rate =
        each_hourglass_mode([&](int mode) { return axes_middle * rate[mode]; });

    // Gradients at the points in the middle of the step.
    Tensor3<Lane> gradient[solid_gauss_points];
    Lane volume_middle[solid_gauss_points];
    Lane total_middle{}, expansion{};
    Tensor3<Lane> lost{}; // what scaling and cutting take from the mean gradient, times volume
    for (int i = 0; i < solid_gauss_points; ++i) {
        const GaussPoint p = gauss_point(i);
        const NaturalFrame<Lane> frame = natural_frame(middle, p);
        vote.inverted |= frame.volume <= 0.0;
        const Tensor3<Lane> whole = hourglass_gradient(mode_gradients(frame, p, no_scale<Lane>()), rate);
        Tensor3<Lane> more = whole;
        if (changed) {
            more = cancelled ? bending_gradient(frame, p, axes_middle, local_rate)
                             : hourglass_gradient(mode_gradients(frame, p, scale_middle), rate);
            lost = lost + frame.volume * (whole - more);
        }
        gradient[i] = linear + more;
        volume_middle[i] = frame.volume;
        total_middle += frame.volume;
    }
    if (changed) {
        const Tensor3<Lane> mean_lost = (1.0 / total_middle) * lost;
        for (Tensor3<Lane>& one : gradient) one = one + mean_lost;
    }
    for (int i = 0; i < solid_gauss_points; ++i) {
        expansion += volume_middle[i] * (gradient[i].xx + gradient[i].yy + gradient[i].zz);
    }
    expansion /= total_middle;

    // Geometry at the end.
    NaturalFrame<Lane> frames[solid_gauss_points];
    Lane volume{};
    for (int i = 0; i < solid_gauss_points; ++i) {
        frames[i] = natural_frame(position, gauss_point(i));
        vote.inverted |= frames[i].volume <= 0.0;
        volume += frames[i].volume;
    }
    volume = vote.inverted ? reference_volume : volume;
    total_middle = vote.inverted ? reference_volume : total_middle;
    const Lane relative_volume = volume * constants[inverse_volume_constant];
    const Lane inverse_length = inverse_cube_root(volume);
    const Lane length = volume * inverse_length * inverse_length;

    const Lane volume_change = step * expansion * total_middle * constants[inverse_volume_constant];
    SolidMotion<Lane> motion{{},
                             {},
                             relative_volume,
                             volume_change,
                             volume_change,
                             volume_change,
                             {},
                             history[internal_energy_history] * constants[inverse_volume_constant],
                             time_step,
                             position,
                             constants + point_constants};
    Lane* points = history + first_gauss_point;
    const Lane wave_modulus = point.wave_modulus(motion, HistoryView<Lane>{points + 6});
    const Lane sound_speed = sqrt((1.0 / parameters.density) * wave_modulus * relative_volume);
    const Lane viscosity =
        parameters.viscosity.pressure(constants[mass_constant] / volume, length, sound_speed, expansion);
    const Lane mean_viscosity = 0.5 * (viscosity + history[viscosity_history]);
    motion.viscous_work = -mean_viscosity * volume_change;
    history[viscosity_history] = viscosity;

    // Stresses; their mean pressure makes up all of the pressure that works on the mean volume strain.
    const Lane mean_before = (1.0 / 3) * (history[0] + history[1] + history[2]);
    SymmetricTensor<Lane> mean{};
    Lane plastic_strain{}, work{};
    SymmetricTensor<Lane> deviators[solid_gauss_points];
    MaskOf<Lane> failed = volume > 0.0;
    for (int i = 0; i < solid_gauss_points; ++i, points += eight_point_size<Point>) {
        SymmetricTensor<Lane> increment = step * symmetric_part(gradient[i]);
        const Lane correction = (1.0 / 3) * (step * expansion - trace(increment));
        increment.xx += correction;
        increment.yy += correction;
        increment.zz += correction;
        const Vector3<Lane> half_turn = (0.5 * step) * axial_vector(gradient[i]);
        motion.increment = turned_half(increment, half_turn);
        motion.rotation = incremental_rotation(half_turn);
        SymmetricTensor<Lane> stress = tensor_at(points);
        const SymmetricTensor<Lane> before = stress;
        stress = rotated(stress, motion.rotation);
        const HistoryView<Lane> variables{points + 6};
        point.update(stress, variables, motion);
        if constexpr (Point::can_fail) failed &= point.failed(variables, motion);
        if constexpr (Point::plastic_strain >= 0) {
            plastic_strain += (1.0 / solid_gauss_points) * variables[Point::plastic_strain];
        }
        put_tensor(points, stress);
        mean = mean + frames[i].volume * stress;
        deviators[i] = deviator(stress);
        work += volume_middle[i] * contract(deviator(before) + deviators[i], increment);
    }
    if constexpr (Point::can_fail) vote.failed = failed;
    mean = (1.0 / volume) * mean;
    const Lane mean_stress = (1.0 / 3) * trace(mean);
    work = 0.5 * (work + total_middle * (mean_before + mean_stress) * step * expansion);
    vote.viscous_work = -mean_viscosity * step * expansion * total_middle;
    history[internal_energy_history] += vote.inverted ? Lane{} : work + vote.viscous_work;
    put_tensor(history, mean);
    history[point_history] = plastic_strain;

    // Stable step.
    Lane stable_speed = sound_speed;
    if constexpr (Point::modulus_changes) {
        motion.energy_density = history[internal_energy_history] * constants[inverse_volume_constant];
        const Lane modulus = point.wave_modulus(motion, HistoryView<Lane>{history + first_gauss_point + 6});
        stable_speed = sqrt((1.0 / parameters.density) * modulus * relative_volume);
    }
    const Lane crossing = volume / sqrt(largest_face_squared(position));
    const double q = parameters.viscosity.linear;
    const Lane at_rest = crossing / ((q + std::sqrt(1 + q * q)) * stable_speed);
    vote.stable_step =
        min(at_rest, parameters.viscosity.stable_step(crossing, length, stable_speed, expansion));

    // Forces: the linear field carries the mean stress, and so do the whole modes; scaled or cut modes carry
    // what the points differ by from the mean (the transpose of the gradients above).
    SymmetricTensor<Lane> mean_total = mean;
    mean_total.xx -= viscosity;
    mean_total.yy -= viscosity;
    mean_total.zz -= viscosity;
    HourglassVectors<Lane> mode_force{}, bending_force{};
    for (int i = 0; i < solid_gauss_points; ++i) {
        const GaussPoint p = gauss_point(i);
        SymmetricTensor<Lane> stress = deviators[i];
        const Lane pressure_free = mean_stress - viscosity;
        stress.xx += pressure_free;
        stress.yy += pressure_free;
        stress.zz += pressure_free;
        const ModeGradients<Lane> whole = mode_gradients(frames[i], p, no_scale<Lane>());
        if (!changed) {
            add_mode_forces(whole, frames[i].volume * stress, mode_force);
            continue;
        }
        add_mode_forces(whole, frames[i].volume * mean_total, mode_force);
        const SymmetricTensor<Lane> rest = frames[i].volume * (stress - mean_total);
        if (cancelled) {
            add_bending_forces(frames[i], p, axes, rest, bending_force);
        } else {
            add_mode_forces(mode_gradients(frames[i], p, scale), rest, mode_force);
        }
    }
    if (cancelled) {
        for (int mode = 0; mode < 4; ++mode) {
            mode_force[mode] += transposed_times(axes, bending_force[mode]);
        }
    }
    const SymmetricTensor<Lane> sum = volume * mean_total;
    Tensor3<Lane> total{sum.xx, sum.xy, sum.zx, sum.xy, sum.yy, sum.yz, sum.zx, sum.yz, sum.zz};
    // q = v - L0 x: the mode forces take their share out of the linear field.
    for (int mode = 0; mode < 4; ++mode) {
        total.add_dyad(-mode_force[mode], position.hourglass[mode]);
    }
    const Lane centre_now_volume = vote.inverted ? reference_volume : centre_now.volume;
    SolidModes<Lane> forces = stress_divergence(centre_now, (-1.0 / centre_now_volume) * total);
    for (int mode = 0; mode < 4; ++mode) forces.hourglass[mode] = -mode_force[mode];
    return {forces, vote};
}

} // namespace plash
