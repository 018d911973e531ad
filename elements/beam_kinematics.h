#pragma once

#include "math/lanes.h"
#include "math/vector3.h"

namespace plash {

/// Axes of a beam: e1 from node 1 to node 2 (r in the manual), e2 = s, e3 = t.
template <class Lane>
struct BeamFrame {
    Vector3<Lane> e1, e2, e3;
    Lane length; ///< [length]
};

/// What a beam needs of its ends: their difference and the mean and difference of their spins.
template <class Lane>
struct BeamEnds {
    Vector3<Lane> side;      ///< x2 - x1 at n
    Vector3<Lane> velocity;  ///< v2 - v1 at n - 1/2
    Vector3<Lane> mean_spin; ///< (w1 + w2) / 2
    Vector3<Lane> spin;      ///< w2 - w1
};

/// Deformation of a step in the axes of its middle, or the forces and moments that do work on it. `sway` is
/// the mean rotation of the ends relative to the line between the nodes.
template <class Lane>
struct BeamMode {
    Lane stretch{}, twist{}, bend_s{}, bend_t{}, sway_s{}, sway_t{};
};

template <class Lane>
inline Lane work_of(const BeamMode<Lane>& force, const BeamMode<Lane>& way)
{
    return force.stretch * way.stretch + force.twist * way.twist + force.bend_s * way.bend_s +
           force.bend_t * way.bend_t + force.sway_s * way.sway_s + force.sway_t * way.sway_t;
}

template <class Lane>
inline BeamMode<Lane> operator+(const BeamMode<Lane>& a, const BeamMode<Lane>& b)
{
    return {a.stretch + b.stretch, a.twist + b.twist,   a.bend_s + b.bend_s,
            a.bend_t + b.bend_t,   a.sway_s + b.sway_s, a.sway_t + b.sway_t};
}

template <class Lane>
inline Vector3<Lane> normalized(const Vector3<Lane>& a)
{
    return (1.0 / sqrt(dot(a, a))) * a;
}

/// The frame after the axis has turned from `before.e1` towards `side` by the shortest way and the section
/// has turned about it by `twist`. The turning of the ends about other axes thus does not enter, which makes
/// the section follow the material for rotations of any size (parallel transport; Bergou et al. 2008).
template <class Lane>
inline BeamFrame<Lane> transported(const Vector3<Lane>& e1_before, const Vector3<Lane>& e2_before,
                                   const Vector3<Lane>& side, Lane twist)
{
    BeamFrame<Lane> frame;
    frame.length = sqrt(dot(side, side));
    frame.e1 = (1.0 / frame.length) * side;
    const Vector3<Lane> sum = e1_before + frame.e1;
    const Lane share = dot(e2_before, frame.e1) / (1.0 + dot(e1_before, frame.e1));
    const Vector3<Lane> carried = e2_before - share * sum;
    const Vector3<Lane> across = cross(frame.e1, carried);
    // Half-angle formulas with tan(twist / 2) to seventh order.
    const Lane half = 0.5 * twist, square = half * half;
    const Lane tangent = half * (1.0 + square * (1.0 / 3 + square * (2.0 / 15)));
    const Lane scale = 1.0 / (1.0 + tangent * tangent);
    const Vector3<Lane> turned =
        (scale * (1.0 - tangent * tangent)) * carried + (scale * 2.0 * tangent) * across;
    frame.e2 = normalized(turned - dot(turned, frame.e1) * frame.e1);
    frame.e3 = cross(frame.e1, frame.e2);
    return frame;
}

/// Frames in the middle and at the end of a step.
/// e2_before  s axis at its start
template <class Lane>
inline void follow_frame(const BeamEnds<Lane>& ends, const Vector3<Lane>& e2_before, double time_step,
                         BeamFrame<Lane>& middle, BeamFrame<Lane>& end)
{
    const Lane step = broadcast<Lane>(time_step);
    const Vector3<Lane> side_before = ends.side - step * ends.velocity;
    const Vector3<Lane> side_middle = ends.side - (0.5 * step) * ends.velocity;
    const Vector3<Lane> e1_before = normalized(side_before), e1_middle = normalized(side_middle);
    const Lane half_twist = (0.5 * step) * dot(ends.mean_spin, e1_middle);
    middle = transported(e1_before, e2_before, side_middle, half_twist);
    end = transported(middle.e1, middle.e2, ends.side, half_twist);
}

/// Deformation of a step; rigid motion of any size gives none.
template <class Lane>
inline BeamMode<Lane> beam_increment(const BeamFrame<Lane>& frame, const BeamEnds<Lane>& ends,
                                     double time_step)
{
    const Lane step = broadcast<Lane>(time_step), per_length = step / frame.length;
    return {step * dot(ends.velocity, frame.e1),
            step * dot(ends.spin, frame.e1),
            step * dot(ends.spin, frame.e2),
            step * dot(ends.spin, frame.e3),
            step * dot(ends.mean_spin, frame.e2) + per_length * dot(ends.velocity, frame.e3),
            step * dot(ends.mean_spin, frame.e3) - per_length * dot(ends.velocity, frame.e2)};
}

/// Force on node 2 (node 1 gets the opposite) and moments on both.
template <class Lane>
struct BeamForces {
    Vector3<Lane> force, moment1, moment2;
};

/// Forces of a beam on its nodes: the transpose of beam_increment, with the sign of forces on the nodes.
template <class Lane>
inline BeamForces<Lane> beam_forces(const BeamFrame<Lane>& frame, const BeamMode<Lane>& mode)
{
    const Lane per_length = 1.0 / frame.length;
    const Vector3<Lane> pull = mode.stretch * frame.e1 - (per_length * mode.sway_t) * frame.e2 +
                               (per_length * mode.sway_s) * frame.e3;
    const Vector3<Lane> opposite = mode.twist * frame.e1 + mode.bend_s * frame.e2 + mode.bend_t * frame.e3;
    const Vector3<Lane> same = (0.5 * mode.sway_s) * frame.e2 + (0.5 * mode.sway_t) * frame.e3;
    return {-pull, opposite - same, -opposite - same};
}

} // namespace plash
