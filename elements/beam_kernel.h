#pragma once

#include "elements/beam_kinematics.h"
#include "elements/beam_section.h"
#include "materials/history.h"

#include <limits>

namespace plash {

/// Resultants at which a spot weld breaks: (Nrr / NRR)^2 + (Nrs / NRS)^2 + ... = 1; infinite: never.
struct WeldStrength {
    double axial = std::numeric_limits<double>::infinity(); ///< NRR, in tension only [force]
    double shear_s = axial, shear_t = axial;                ///< NRS, NRT [force]
    double torsion = axial;                                 ///< MRR [moment]
    double moment_s = axial, moment_t = axial;              ///< MSS, MTT [moment]
    bool limited = false;                                   ///< some of them is finite
};

/// What all beams of a group share.
struct BeamSettings {
    BeamSection section;
    double density = 0;       ///< [mass/volume]
    double young_modulus = 0; ///< [stress]
    double shear_modulus = 0; ///< [stress]
    double wave_speed = 0;    ///< of a bar [velocity]
    WeldStrength strength;
    bool points_fail = false; ///< the law has a failure strain
    int points_to_erode = 0;  ///< *MAT_ADD_EROSION: so many failed points take a beam; 0: none
    double failure_time = std::numeric_limits<double>::infinity(); ///< TFAIL, FAILTM [time]
};

/// Where the values of an element stand in its record, before those of its formulation.
namespace beam_record {
enum Element {
    second_axis,                   ///< s at n, three components
    mass_factor = second_axis + 3, ///< by which mass scaling has raised the mass; 0: eroded
    internal_energy,               ///< [energy]
    resultant,                     ///< BeamMode of the forces at n
    own = resultant + 6
};
} // namespace beam_record

/// Axial stress that a preload prescribes in this cycle.
template <class Lane>
struct BeamPrescription {
    MaskOf<Lane> active{};
    Lane stress{}; ///< [stress]
    bool keeps_bending = false;
};

template <class Lane>
inline BeamMode<Lane> load_mode(const Lane* values)
{
    return {values[0], values[1], values[2], values[3], values[4], values[5]};
}

template <class Lane>
inline void store_mode(Lane* values, const BeamMode<Lane>& mode)
{
    values[0] = mode.stretch;
    values[1] = mode.twist;
    values[2] = mode.bend_s;
    values[3] = mode.bend_t;
    values[4] = mode.sway_s;
    values[5] = mode.sway_t;
}

/// Hughes-Liu beam with one point along the axis (ELFORM 1, and 9 for spot welds): strains of a
/// shear-flexible straight beam at mid-length, stresses at the points of the cross section. Source: Hughes &
/// Liu (1981), Hallquist (2006), chapter 'Hughes-Liu beam'; written in the axes of the element, so that the
/// rotation of stresses is that of its frame.
struct IntegratedBeam {
    static constexpr bool rotates = true;

    template <class Law>
    static int record_size(const BeamSection& section)
    {
        return beam_record::own + static_cast<int>(section.points.size()) * point_size<Law>();
    }

    /// axial stress, shear rs, shear tr, then the law's history.
    template <class Law>
    static constexpr int point_size()
    {
        return 3 + static_cast<int>(Law::history_size);
    }

    template <class Lane, class Law>
    static BeamMode<Lane>
    resultants(const BeamSettings& settings, const Law& law, const BeamFrame<Lane>& middle,
               const BeamFrame<Lane>& end, const BeamMode<Lane>& increment,
               const BeamPrescription<Lane>& prescription, double time_step, Lane* record)
    {
        const BeamSection& section = settings.section;
        const Lane per_length = 1.0 / middle.length;
        const Lane stretch = per_length * increment.stretch, twist = per_length * increment.twist;
        const Lane bend_s = per_length * increment.bend_s, bend_t = per_length * increment.bend_t;
        Lane* point_values = record + beam_record::own;
        for (const BeamPoint& point : section.points) {
            law.update_beam(point_values, stretch + point.t * bend_s - point.s * bend_t,
                            -increment.sway_t - point.t * twist, increment.sway_s + point.s * twist,
                            HistoryView<Lane>{point_values + 3}, time_step);
            point_values += point_size<Law>();
        }
        if (any(prescription.active)) prescribe<Law>(section, prescription, record);
        BeamMode<Lane> sum{};
        point_values = record + beam_record::own;
        for (const BeamPoint& point : section.points) {
            const Lane axial = point.share * point_values[0];
            const Lane rs = (point.share * section.shear_factor) * point_values[1];
            const Lane tr = (point.share * section.shear_factor) * point_values[2];
            sum.stretch += axial;
            sum.bend_s += point.t * axial;
            sum.bend_t -= point.s * axial;
            sum.twist += point.s * tr - point.t * rs;
            sum.sway_t -= rs;
            sum.sway_s += tr;
            point_values += point_size<Law>();
        }
        const Lane area = broadcast<Lane>(section.area);
        return {area * sum.stretch,
                area * sum.twist,
                area * sum.bend_s,
                area * sum.bend_t,
                area * end.length * sum.sway_s,
                area * end.length * sum.sway_t};
    }

private:
    /// KBEND = 0: the same axial stress at all points, so that bending is free; 1: only its mean.
    template <class Law, class Lane>
    static void prescribe(const BeamSection& section, const BeamPrescription<Lane>& prescription,
                          Lane* record)
    {
        Lane mean{};
        Lane* values = record + beam_record::own;
        for (const BeamPoint& point : section.points) {
            mean += point.share * *values;
            values += point_size<Law>();
        }
        values = record + beam_record::own;
        for (std::size_t i = 0; i < section.points.size(); ++i) {
            const Lane wanted =
                prescription.keeps_bending ? *values + (prescription.stress - mean) : prescription.stress;
            *values = prescription.active ? wanted : *values;
            values += point_size<Law>();
        }
    }
};

/// Elastic resultant beam (ELFORM 2): end moments of a straight beam with cubic deflection and transverse
/// shear. Source: Belytschko, Schwer & Klein (1977), Hallquist (2006), chapter 'Belytschko beam'.
struct ResultantBeam {
    static constexpr bool rotates = true;

    template <class Law>
    static int record_size(const BeamSection&)
    {
        return beam_record::own;
    }

    template <class Lane, class Law>
    static BeamMode<Lane> resultants(const BeamSettings& settings, const Law&, const BeamFrame<Lane>& middle,
                                     const BeamFrame<Lane>&, const BeamMode<Lane>& increment,
                                     const BeamPrescription<Lane>& prescription, double, Lane* record)
    {
        const BeamSection& section = settings.section;
        const double e = settings.young_modulus, g = settings.shear_modulus;
        const Lane per_length = 1.0 / middle.length;
        // phi = 12 E I / (G As L^2)
        const double shear = section.shear_area > 0 ? 12 * e / (g * section.shear_area) : 0;
        const Lane per_square = shear * per_length * per_length;
        const Lane stiff_s =
            (12 * e * section.inertia_s) * per_length / (1.0 + section.inertia_s * per_square);
        const Lane stiff_t =
            (12 * e * section.inertia_t) * per_length / (1.0 + section.inertia_t * per_square);
        BeamMode<Lane> mode = load_mode(record + beam_record::resultant);
        mode.stretch += (e * section.area) * per_length * increment.stretch;
        mode.twist += (g * section.torsion) * per_length * increment.twist;
        mode.bend_s += (e * section.inertia_s) * per_length * increment.bend_s;
        mode.bend_t += (e * section.inertia_t) * per_length * increment.bend_t;
        mode.sway_s += stiff_s * increment.sway_s;
        mode.sway_t += stiff_t * increment.sway_t;
        const Lane wanted = section.area * prescription.stress;
        mode.stretch = prescription.active ? wanted : mode.stretch;
        return mode;
    }
};

/// Truss (ELFORM 3): axial stress alone.
struct Truss {
    static constexpr bool rotates = false;

    template <class Law>
    static int record_size(const BeamSection&)
    {
        return beam_record::own + 3 + static_cast<int>(Law::history_size);
    }

    template <class Lane, class Law>
    static BeamMode<Lane>
    resultants(const BeamSettings& settings, const Law& law, const BeamFrame<Lane>& middle,
               const BeamFrame<Lane>&, const BeamMode<Lane>& increment,
               const BeamPrescription<Lane>& prescription, double time_step, Lane* record)
    {
        Lane* values = record + beam_record::own;
        law.update_beam(values, Lane{increment.stretch / middle.length}, Lane{}, Lane{},
                        HistoryView<Lane>{values + 3}, time_step);
        values[0] = prescription.active ? prescription.stress : values[0];
        BeamMode<Lane> mode{};
        mode.stretch = settings.section.area * values[0];
        return mode;
    }
};

/// What one step of a batch gives back.
template <class Lane>
struct BeamStep {
    BeamForces<Lane> forces;
    Lane length;        ///< at the end of the step [length]
    Lane internal_work; ///< booked under internal energy [energy]
    Lane preload_work;  ///< put in by the preload [energy]
    MaskOf<Lane> broken;
};

/// One step of a batch of beams: deformation in the axes of mid-step, forces in those of its end.
/// record  the elements' values, in and out
template <class Formulation, class Lane, class Law>
inline BeamStep<Lane> beam_step(const BeamSettings& settings, const Law& law, const BeamEnds<Lane>& ends,
                                const BeamPrescription<Lane>& prescription, double time_step, Lane* record)
{
    using namespace beam_record;
    BeamFrame<Lane> middle, end;
    const Vector3<Lane> e2_before{record[second_axis], record[second_axis + 1], record[second_axis + 2]};
    follow_frame(ends, e2_before, time_step, middle, end);
    record[second_axis] = end.e2.x;
    record[second_axis + 1] = end.e2.y;
    record[second_axis + 2] = end.e2.z;
    BeamMode<Lane> increment = beam_increment(middle, ends, time_step);
    if constexpr (!Formulation::rotates) {
        increment = {increment.stretch, Lane{}, Lane{}, Lane{}, Lane{}, Lane{}};
    }
    const BeamMode<Lane> before = load_mode(record + resultant);
    const BeamMode<Lane> mode =
        Formulation::resultants(settings, law, middle, end, increment, prescription, time_step, record);
    store_mode(record + resultant, mode);

    BeamStep<Lane> step;
    step.forces = beam_forces(end, mode);
    step.length = end.length;
    const Lane work = 0.5 * work_of(before + mode, increment);
    // Under a preload LS-DYNA books the magnitude of the work as internal energy; the balance knows what the
    // preload has put in to make it so.
    step.internal_work = prescription.active ? abs(work) : work;
    step.preload_work = prescription.active ? step.internal_work - work : Lane{};
    step.broken = MaskOf<Lane>{};
    const WeldStrength& strength = settings.strength;
    if (strength.limited) {
        const auto square = [](Lane value, double limit) { return (value / limit) * (value / limit); };
        const Lane sum = square(max(mode.stretch, Lane{}), strength.axial) +
                         square(mode.sway_t / end.length, strength.shear_s) +
                         square(mode.sway_s / end.length, strength.shear_t) +
                         square(mode.twist, strength.torsion) + square(mode.bend_s, strength.moment_s) +
                         square(mode.bend_t, strength.moment_t);
        step.broken = sum >= 1.0;
    }
    return step;
}

} // namespace plash
