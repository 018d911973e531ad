#pragma once

#include "elements/shell_kernel.h"
#include "elements/shell_warping.h"

namespace plash {

/// Velocity strains of Belytschko, Lin & Tsay (1984, eq. 8-11) at the centroid, times the step. With
/// positions of mid-step a rigid rotation of any size gives none (Hughes & Winget 1980).
template <class Lane>
inline ShellIncrement<Lane> shell_increment(const ShellFrame<Lane>& frame,
                                            const CornerPattern<Lane>& velocity,
                                            const CornerPattern<Lane>& spin, double time_step, bool warping)
{
    const Lane step = broadcast<Lane>(time_step);
    const Lane scale = (0.5 * time_step) / frame.area;
    const Vector3<Lane> v13 = frame.to_local(velocity.diagonal13);
    const Vector3<Lane> v24 = frame.to_local(velocity.diagonal24);
    const Vector3<Lane> v_by_x = scale * (frame.y24 * v13 - frame.y13 * v24);
    const Vector3<Lane> v_by_y = scale * (frame.x13 * v24 - frame.x24 * v13);
    const ShellSpin<Lane> r{dot(spin.diagonal13, frame.e1), dot(spin.diagonal13, frame.e2),
                            dot(spin.diagonal24, frame.e1), dot(spin.diagonal24, frame.e2),
                            dot(spin.sum, frame.e1),        dot(spin.sum, frame.e2)};
    const Lane rx_by_x = scale * (frame.y24 * r.x13 - frame.y13 * r.x24);
    const Lane rx_by_y = scale * (frame.x13 * r.x24 - frame.x24 * r.x13);
    const Lane ry_by_x = scale * (frame.y24 * r.y13 - frame.y13 * r.y24);
    const Lane ry_by_y = scale * (frame.x13 * r.y24 - frame.x24 * r.y13);
    const double quarter_step = 0.25 * time_step;

    ShellIncrement<Lane> result;
    result.exx = v_by_x.x;
    result.eyy = v_by_y.y;
    result.twice_exy = v_by_y.x + v_by_x.y;
    result.kxx = ry_by_x;
    result.kyy = -rx_by_y;
    result.twice_kxy = ry_by_y - rx_by_x;
    result.gyz = v_by_y.z - quarter_step * r.x_sum;
    result.gzx = v_by_x.z + quarter_step * r.y_sum;
    if (warping) {
        const ShellWarpingRates<Lane> more = warping_rates(frame, v13, v24, spin);
        const TransverseShear<Lane> sides = side_shear(frame, r);
        result.kxx += step * more.kxx;
        result.kyy += step * more.kyy;
        result.twice_kxy += step * more.twice_kxy;
        result.gyz += step * (more.shear.yz + sides.yz);
        result.gzx += step * (more.shear.zx + sides.zx);
    }

    // gamma . f = h . f - (h . x) f,x - (h . y) f,y; in the plane also + (h . z) vz,x and vz,y, so that a
    // warped element may turn rigidly.
    const Lane hx = frame.x_hourglass, hy = frame.y_hourglass, hz = frame.z_hourglass;
    const Vector3<Lane> h = frame.to_local(velocity.alternating);
    result.hourglass.force = step * h - hx * v_by_x - hy * v_by_y;
    result.hourglass.force.x += hz * v_by_x.z;
    result.hourglass.force.y += hz * v_by_y.z;
    result.hourglass.moment_x = step * dot(spin.alternating, frame.e1) - hx * rx_by_x - hy * rx_by_y;
    result.hourglass.moment_y = step * dot(spin.alternating, frame.e2) - hx * ry_by_x - hy * ry_by_y;
    return result;
}

/// Forces and moments on the corners from resultants and hourglass forces: the transpose of
/// shell_increment on the geometry at the end of the step, with the sign of forces on the nodes.
template <class Lane>
inline void shell_forces(const ShellFrame<Lane>& frame, const ShellResultants<Lane>& resultants,
                         const ShellHourglassForce<Lane>& hourglass, bool warping, CornerPattern<Lane>& force,
                         CornerPattern<Lane>& moment)
{
    const Lane half = broadcast<Lane>(0.5);
    const Lane inverse_area = 1.0 / frame.area;
    const Lane hx = frame.x_hourglass * inverse_area, hy = frame.y_hourglass * inverse_area;
    const Lane hz = frame.z_hourglass * inverse_area;

    Vector3<Lane> by_x = Vector3<Lane>{resultants.nxx, resultants.nxy, resultants.qx} - hx * hourglass.force;
    Vector3<Lane> by_y = Vector3<Lane>{resultants.nxy, resultants.nyy, resultants.qy} - hy * hourglass.force;
    by_x.z += hz * hourglass.force.x;
    by_y.z += hz * hourglass.force.y;
    const Lane xx = -resultants.mxy - hx * hourglass.moment_x;
    const Lane xy = -resultants.myy - hy * hourglass.moment_x;
    const Lane yx = resultants.mxx - hx * hourglass.moment_y;
    const Lane yy = resultants.mxy - hy * hourglass.moment_y;
    Vector3<Lane> f13 = half * (frame.y24 * by_x - frame.x24 * by_y);
    Vector3<Lane> f24 = half * (frame.x13 * by_y - frame.y13 * by_x);
    const Lane quarter_area = 0.25 * frame.area;
    ShellSpin<Lane> m{0.5 * (frame.y24 * xx - frame.x24 * xy), 0.5 * (frame.y24 * yx - frame.x24 * yy),
                      0.5 * (frame.x13 * xy - frame.y13 * xx), 0.5 * (frame.x13 * yy - frame.y13 * yx),
                      -quarter_area * resultants.qy,           quarter_area * resultants.qx};
    const auto in_plane = [&](Lane x, Lane y) { return x * frame.e1 + y * frame.e2; };
    moment.alternating = -in_plane(hourglass.moment_x, hourglass.moment_y);
    moment.sum = -in_plane(m.x_sum, m.y_sum);
    if (warping) {
        const ShellNormalMoments<Lane> normal = add_warping_forces(
            frame, resultants.mxx, resultants.myy, resultants.mxy, resultants.qx, resultants.qy, f13, f24);
        add_side_shear(frame, resultants.qx, resultants.qy, m);
        moment.diagonal13 = -in_plane(m.x13, m.y13) - normal.z13 * frame.e3;
        moment.diagonal24 = -in_plane(m.x24, m.y24) - normal.z24 * frame.e3;
        moment.alternating -= normal.z_alternating * frame.e3;
        moment.sum -= normal.z_sum * frame.e3;
    } else {
        moment.diagonal13 = -in_plane(m.x13, m.y13);
        moment.diagonal24 = -in_plane(m.x24, m.y24);
    }
    force.diagonal13 = -frame.to_global(f13);
    force.diagonal24 = -frame.to_global(f24);
    force.alternating = -frame.to_global(hourglass.force);
    force.sum = {};
}

/// Hourglass forces at the end of a step, which the record keeps for the next one; returns their work.
template <class Lane>
inline Lane update_hourglass(const ShellSettings& settings, const ShellFrame<Lane>& frame,
                             const ShellHourglassForce<Lane>& increment, double time_step, Lane* record,
                             ShellHourglassForce<Lane>& hourglass)
{
    Lane* stored = record + shell_record::hourglass_force;
    const ShellHourglassForce<Lane> old{{stored[0], stored[1], stored[2]}, stored[3], stored[4]};
    hourglass = shell_hourglass_force(settings.hourglass, settings.stiffness, frame,
                                      record[shell_record::thickness], increment, time_step, old);
    stored[0] = hourglass.force.x;
    stored[1] = hourglass.force.y;
    stored[2] = hourglass.force.z;
    stored[3] = hourglass.moment_x;
    stored[4] = hourglass.moment_y;
    return 0.5 * (dot(old.force + hourglass.force, increment.force) +
                  (old.moment_x + hourglass.moment_x) * increment.moment_x +
                  (old.moment_y + hourglass.moment_y) * increment.moment_y);
}

/// Belytschko-Tsay elements (ELFORM 2).
struct BelytschkoTsay {
    static constexpr int plane_points = 1;

    /// One step: strain increments on the geometry of mid-step, stresses, and forces on the geometry at its
    /// end.
    /// position, velocity, spin   patterns of x(n), v(n-1/2) and angular velocity (n-1/2)
    /// record                     the elements' values (shell_record), in and out
    template <class Lane, class Law>
    static ShellStep<Lane> step(const ShellSettings& settings, const Law& law,
                                const CornerPattern<Lane>& position, const CornerPattern<Lane>& velocity,
                                const CornerPattern<Lane>& spin, double time_step, Lane* record)
    {
        using namespace shell_record;
        // Both frames at once: their long chains of roots and quotients overlap.
        const ShellFrame<Lane> middle_frame = shell_frame(mid_step(position, velocity, time_step));
        const ShellFrame<Lane> frame = shell_frame(position);
        const ShellIncrement<Lane> increment =
            shell_increment(middle_frame, velocity, spin, time_step, settings.warping);

        ShellStep<Lane> result;
        ShellResultants<Lane> resultants;
        Lane thinning;
        result.internal_work =
            middle_frame.area * update_points(settings, law, increment, time_step, record[thickness],
                                              record + points, resultants, thinning,
                                              strains_of(settings, record));
        if (settings.thickness_change) record[thickness] += record[thickness] * thinning;
        result.viscous_work = Lane{};
        if (settings.bulk_viscosity) {
            result.viscous_work =
                middle_frame.area * add_bulk_viscosity(settings, increment.exx + increment.eyy, frame.area,
                                                       time_step, record, resultants);
            result.internal_work += result.viscous_work;
        }
        ShellHourglassForce<Lane> hourglass;
        result.hourglass_work =
            update_hourglass(settings, frame, increment.hourglass, time_step, record, hourglass);
        shell_forces(frame, resultants, hourglass, settings.warping, result.force, result.moment);
        finish_step(settings, position, frame.area, record, result);
        return result;
    }
};

} // namespace plash
