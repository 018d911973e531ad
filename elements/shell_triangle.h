#pragma once

#include "elements/shell_belytschko_tsay.h"

namespace plash {

/// Triangles (ELFORM 4, or degenerate quadrilaterals with ESORT): constant membrane strain and curvature, and
/// transverse shear sampled at the sides, evaluated at the centroid. The element is the one-point
/// quadrilateral whose fourth corner is the third, with the shear of Kennedy, Belytschko & Lin's (1986) C0
/// triangle in the form of Lee & Bathe (2004, Computers & Structures 82, 945-962, MITC3): exact for constant
/// curvature on any mesh, and the same whatever corner comes first.
struct C0Triangle {
    static constexpr int plane_points = 1;

    /// What sampling at the sides adds to the shear of the degenerate quadrilateral, whose mean rotation
    /// counts the third corner twice.
    template <class Lane>
    static TransverseShear<Lane> shear(const ShellFrame<Lane>& frame, const ShellSpin<Lane>& r)
    {
        const Lane x13 = frame.x13, y13 = frame.y13, x24 = frame.x24, y24 = frame.y24;
        const Lane own13 = x13 * r.y13 - y13 * r.x13, own24 = x24 * r.y24 - y24 * r.x24;
        const Lane cross = x13 * r.y24 - y13 * r.x24 + x24 * r.y13 - y24 * r.x13;
        const Lane first = (1.0 / 6) * (own24 - own13), second = (1.0 / 6) * (cross - own13);
        const Lane half_per_area = 0.5 / frame.area;
        return {half_per_area * (y13 * first + (y24 - y13) * second) - (1.0 / 12) * (r.y13 + r.y24),
                half_per_area * ((x13 - x24) * second - x13 * first) + (1.0 / 12) * (r.x13 + r.x24)};
    }

    /// Transpose of shear() over the whole element.
    template <class Lane>
    static ShellSpin<Lane> shear_moments(const ShellFrame<Lane>& frame, Lane qx, Lane qy)
    {
        const Lane x13 = frame.x13, y13 = frame.y13, x24 = frame.x24, y24 = frame.y24;
        const Lane first = (1.0 / 12) * (y13 * qx - x13 * qy);
        const Lane second = (1.0 / 12) * ((y24 - y13) * qx + (x13 - x24) * qy);
        const Lane own13 = -(first + second);
        const Lane mean_x = (1.0 / 12) * frame.area * qx, mean_y = (1.0 / 12) * frame.area * qy;
        return {mean_y - own13 * y13 - second * y24,
                own13 * x13 + second * x24 - mean_x,
                mean_y - first * y24 - second * y13,
                first * x24 + second * x13 - mean_x,
                Lane{},
                Lane{}};
    }

    /// One step; see BelytschkoTsay::step.
    template <class Lane, class Law>
    static ShellStep<Lane> step(const ShellSettings& settings, const Law& law,
                                const CornerPattern<Lane>& position, const CornerPattern<Lane>& velocity,
                                const CornerPattern<Lane>& spin, double time_step, Lane* record)
    {
        using namespace shell_record;
        const ShellFrame<Lane> middle = shell_frame(mid_step(position, velocity, time_step));
        const ShellFrame<Lane> frame = shell_frame(position);
        ShellIncrement<Lane> increment = shell_increment(middle, velocity, spin, time_step, false);
        const ShellSpin<Lane> rates{dot(spin.diagonal13, middle.e1),
                                    dot(spin.diagonal13, middle.e2),
                                    dot(spin.diagonal24, middle.e1),
                                    dot(spin.diagonal24, middle.e2),
                                    Lane{},
                                    Lane{}};
        const TransverseShear<Lane> sides = shear(middle, rates);
        increment.gzx += time_step * sides.zx;
        increment.gyz += time_step * sides.yz;

        ShellStep<Lane> result;
        ShellResultants<Lane> resultants;
        Lane thinning;
        result.internal_work =
            middle.area * update_points(settings, law, increment, time_step, record[thickness],
                                        record + points, resultants, thinning, strains_of(settings, record));
        if (settings.thickness_change) record[thickness] += record[thickness] * thinning;
        result.viscous_work = result.hourglass_work = Lane{};
        if (settings.bulk_viscosity) {
            result.viscous_work = middle.area * add_bulk_viscosity(settings, increment.exx + increment.eyy,
                                                                   frame.area, time_step, record, resultants);
            result.internal_work += result.viscous_work;
        }
        shell_forces(frame, resultants, ShellHourglassForce<Lane>{}, false, result.force, result.moment);
        const ShellSpin<Lane> m = shear_moments(frame, resultants.qx, resultants.qy);
        result.moment.diagonal13 -= m.x13 * frame.e1 + m.y13 * frame.e2;
        result.moment.diagonal24 -= m.x24 * frame.e1 + m.y24 * frame.e2;
        finish_step(settings, position, frame.area, record, result);
        return result;
    }
};

} // namespace plash
