#pragma once

#include "elements/shell_pattern.h"

namespace plash {

/// Rotation rates of the corners in the element's frame, x and y components, or the moments conjugate to
/// them.
template <class Lane>
struct ShellSpin {
    Lane x13, y13, x24, y24; ///< differences along the diagonals
    Lane x_sum, y_sum;
};

/// Moments about e3, as the parts of a CornerPattern.
template <class Lane>
struct ShellNormalMoments {
    Lane z13, z24, z_alternating, z_sum;
};

/// What the warping of a quadrilateral adds to the flat theory (BWC = 1). The fibres stand normal to the
/// warped surface at the corners; their tilts p1 = -p3 and p2 = -p4 follow from the height of the corners.
/// Source: Belytschko, Wong & Chiang (1992), Comput. Meth. Appl. Mech. Engng 96, 93-107; Hallquist (2006),
/// 'Belytschko-Wong-Chiang improvements'. Two parts are written differently: the rotation about a fibre is
/// taken out of the corner's rotation with the fibre's tilt (r - r_z p), so that rigid rotations give no
/// curvature and moments pass from element to element without one about the normal; and transverse shear is
/// sampled at the sides and interpolated to the centre (Dvorkin & Bathe 1984), which is exact for quadratic
/// deflections on any mesh, where the manual projects side by side.
template <class Lane>
struct ShellWarping {
    Lane coupling;                       ///< 2 z_gamma / A^2 of the manual [1/length^3]
    Lane tilt1x, tilt1y, tilt2x, tilt2y; ///< fibres at corners 1 and 2 [-]
};

template <class Lane>
inline ShellWarping<Lane> shell_warping(const ShellFrame<Lane>& frame)
{
    // z_gamma = (z1 - z2 + z3 - z4) / 4
    const Lane slope = 0.5 * frame.z_hourglass / frame.area;
    return {slope / frame.area, slope * frame.y24, -slope * frame.x24, slope * frame.y13, -slope * frame.x13};
}

/// Transverse shears along x and y.
template <class Lane>
struct TransverseShear {
    Lane zx, yz;
};

/// What sampling the shear at the sides adds to the shear of mean rotations (zero for parallelograms).
/// r  rotation rates in the frame
template <class Lane>
inline TransverseShear<Lane> side_shear(const ShellFrame<Lane>& frame, const ShellSpin<Lane>& r)
{
    const Lane eighth_per_area = 0.125 / frame.area;
    const Lane side13 = eighth_per_area * (frame.x_hourglass * r.y13 - frame.y_hourglass * r.x13);
    const Lane side24 = eighth_per_area * (frame.x_hourglass * r.y24 - frame.y_hourglass * r.x24);
    return {frame.y24 * side13 + frame.y13 * side24, -(frame.x24 * side13 + frame.x13 * side24)};
}

/// Transpose of side_shear over the whole element: adds to `moments`.
template <class Lane>
inline void add_side_shear(const ShellFrame<Lane>& frame, Lane qx, Lane qy, ShellSpin<Lane>& moments)
{
    const Lane side13 = 0.125 * (frame.y24 * qx - frame.x24 * qy);
    const Lane side24 = 0.125 * (frame.y13 * qx - frame.x13 * qy);
    moments.x13 -= frame.y_hourglass * side13;
    moments.y13 += frame.x_hourglass * side13;
    moments.x24 -= frame.y_hourglass * side24;
    moments.y24 += frame.x_hourglass * side24;
}

/// Curvatures and transverse shears that come from the warping.
template <class Lane>
struct ShellWarpingRates {
    Lane kxx, kyy, twice_kxy;
    TransverseShear<Lane> shear;
};

/// v13, v24  velocities in the frame
/// spin      rotation rates in global axes
template <class Lane>
inline ShellWarpingRates<Lane> warping_rates(const ShellFrame<Lane>& frame, const Vector3<Lane>& v13,
                                             const Vector3<Lane>& v24, const CornerPattern<Lane>& spin)
{
    const ShellWarping<Lane> warping = shell_warping(frame);
    const Lane x13 = frame.x13, y13 = frame.y13, x24 = frame.x24, y24 = frame.y24;

    // Rotation about the fibres: differences along the diagonals of -r_z p, and its sum.
    const Lane z13 = dot(spin.diagonal13, frame.e3), z24 = dot(spin.diagonal24, frame.e3);
    const Lane z_sum = dot(spin.sum, frame.e3), z_alternating = dot(spin.alternating, frame.e3);
    const Lane odd = 0.5 * (z_sum + z_alternating), even = 0.5 * (z_sum - z_alternating);
    const Lane rx13 = warping.tilt1x * odd, ry13 = warping.tilt1y * odd;
    const Lane rx24 = warping.tilt2x * even, ry24 = warping.tilt2y * even;
    const Lane rx_sum = warping.tilt1x * z13 + warping.tilt2x * z24;
    const Lane ry_sum = warping.tilt1y * z13 + warping.tilt2y * z24;

    const Lane half_per_area = 0.5 / frame.area;
    return {warping.coupling * (x13 * v13.x - x24 * v24.x) + half_per_area * (y24 * ry13 - y13 * ry24),
            warping.coupling * (y13 * v13.y - y24 * v24.y) - half_per_area * (x13 * rx24 - x24 * rx13),
            warping.coupling * (y13 * v13.x - y24 * v24.x + x13 * v13.y - x24 * v24.y) +
                half_per_area * (x13 * ry24 - x24 * ry13 - y24 * rx13 + y13 * rx24),
            {0.25 * ry_sum, -0.25 * rx_sum}};
}

/// Transpose of warping_rates: adds what moments and shear forces do along the diagonals to f13 and f24;
/// returns the moments about the normal.
template <class Lane>
inline ShellNormalMoments<Lane> add_warping_forces(const ShellFrame<Lane>& frame, Lane mxx, Lane myy,
                                                   Lane mxy, Lane qx, Lane qy, Vector3<Lane>& f13,
                                                   Vector3<Lane>& f24)
{
    const ShellWarping<Lane> warping = shell_warping(frame);
    const Lane x13 = frame.x13, y13 = frame.y13, x24 = frame.x24, y24 = frame.y24;
    const Lane scale = frame.area * warping.coupling;
    f13.x += scale * (x13 * mxx + y13 * mxy);
    f13.y += scale * (y13 * myy + x13 * mxy);
    f24.x -= scale * (x24 * mxx + y24 * mxy);
    f24.y -= scale * (y24 * myy + x24 * mxy);

    const Lane mx13 = 0.5 * (x24 * myy - y24 * mxy), my13 = 0.5 * (y24 * mxx - x24 * mxy);
    const Lane mx24 = 0.5 * (y13 * mxy - x13 * myy), my24 = 0.5 * (x13 * mxy - y13 * mxx);
    const Lane quarter_area = 0.25 * frame.area;
    const Lane mx_sum = -quarter_area * qy, my_sum = quarter_area * qx;
    const Lane odd = warping.tilt1x * mx13 + warping.tilt1y * my13;
    const Lane even = warping.tilt2x * mx24 + warping.tilt2y * my24;
    return {warping.tilt1x * mx_sum + warping.tilt1y * my_sum,
            warping.tilt2x * mx_sum + warping.tilt2y * my_sum, 0.5 * (odd - even), 0.5 * (odd + even)};
}

} // namespace plash
