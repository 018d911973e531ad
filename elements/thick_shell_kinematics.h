#pragma once

#include "elements/hourglass_solid.h"
#include "elements/shell_fully_integrated.h"
#include "elements/solid_kinematics.h"

namespace plash {

/// Geometry of a thick shell (nodes 1-4 below, 5-8 above): the brick, and its mid-surface as a shell's frame.
template <class Lane>
struct ThickShellFrame {
    SolidModes<Lane> position;
    SolidGradient<Lane, SolidGradientRule::centre> centre;
    SolidGradient<Lane, SolidGradientRule::mean> mean;
    ShellFrame<Lane> surface;
    Tensor3<Lane> axes; ///< rows e1, e2, e3 of the surface
    BilinearMap<Lane> map;
    Lane inverse_thickness;                ///< area of the mid-surface / volume [1/length]
    Vector3<Lane> linear[3], hourglass[4]; ///< modes of the positions along the axes [length]
};

template <class Lane>
inline ThickShellFrame<Lane> thick_shell_frame(const SolidModes<Lane>& x)
{
    ThickShellFrame<Lane> frame;
    frame.position = x;
    frame.centre = gradient_of<SolidGradientRule::centre>(x);
    frame.mean = gradient_of<SolidGradientRule::mean>(x);
    const Lane quarter = broadcast<Lane>(0.25), half = broadcast<Lane>(0.5);
    frame.surface = shell_frame(CornerPattern<Lane>{quarter * (x.linear[0] + x.linear[1]),
                                                    quarter * (x.linear[1] - x.linear[0]),
                                                    half * x.hourglass[2],
                                                    {}});
    const auto& [e1, e2, e3] = std::tie(frame.surface.e1, frame.surface.e2, frame.surface.e3);
    frame.axes = {e1.x, e1.y, e1.z, e2.x, e2.y, e2.z, e3.x, e3.y, e3.z};
    frame.map = bilinear_map(frame.surface);
    frame.inverse_thickness = frame.surface.area / frame.mean.volume;
    for (int i = 0; i < 3; ++i) frame.linear[i] = frame.axes * x.linear[i];
    for (int i = 0; i < 4; ++i) frame.hourglass[i] = frame.axes * x.hourglass[i];
    return frame;
}

/// Kinematics of a thick shell over one step, or the forces conjugate to them, in the frame of its
/// mid-surface. Strains grow with the natural coordinates: c through the thickness, xi and eta in the plane.
template <class Lane>
struct ThickShellModes {
    Lane exx{}, eyy{}, twice_exy{}; ///< mean over the volume
    Lane ezz{}, gyz{}, gzx{};       ///< thickness strain (mean of the four edges), shear at the centre
    Lane shear_xi{}, shear_eta{};   ///< covariant shear beside that of the centre
    Lane shear_xi_slope{}, shear_eta_slope{};   ///< along eta, along xi
    Lane kxx{}, kyy{}, twice_kxy{};             ///< strain over c: curvature times half the thickness
    Lane ux{}, uy{};                            ///< hourglass of the mid-surface [length]
    Lane bx{}, by{};                            ///< hourglass of the bending part [length]
    Lane thick_eta{}, thick_xi{}, thick_both{}; ///< thickness strain over eta, xi and xi eta
};

/// How often each of the nine modes that one column of points does not see is called: for hourglass control.
inline constexpr int thick_shell_hourglass_modes = 9;

/// The hourglass modes of a column, one by one.
template <class Lane>
inline std::array<Lane*, thick_shell_hourglass_modes> hourglass_of(ThickShellModes<Lane>& m)
{
    return {&m.ux,        &m.uy,       &m.bx,        &m.by, &m.shear_xi_slope, &m.shear_eta_slope,
            &m.thick_eta, &m.thick_xi, &m.thick_both};
}

/// Assumed strains of an eight-node thick shell. The velocity is split into the linear field at the centre
/// and hourglass modes orthogonal to it (Flanagan & Belytschko 1981), so that rigid and linear motion are
/// exact on any shape. Of the modes:
/// - transverse shear is sampled at the middles of the sides (Dvorkin & Bathe 1984, Engng Comput. 1, 77-88),
/// - thickness strain at the four edges along the thickness, along the normal of the mid-surface: along the
///   edges themselves (Betsch & Stein 1995, Commun. Numer. Methods Engng 11, 899-909) it lets pressure turn
///   edges that lean the other way from end to end, which nothing but bending holds, from 4 / 3 E (h / L)^2
///   on,
/// - hourglass modes in the plane are those of the fully integrated shell (Belytschko & Bindeman 1991).
/// The strain in the plane has the true mean over the volume (Flanagan & Belytschko 1981), and the other
/// terms have no mean: constant stress is in balance on distorted meshes. gives strains of a step of length
/// time_step; `frame` is that of its middle
template <class Lane>
inline ThickShellModes<Lane> thick_shell_modes(const ThickShellFrame<Lane>& frame,
                                               const SolidModes<Lane>& velocity, double time_step)
{
    const Lane step = broadcast<Lane>(time_step);
    const Tensor3<Lane> at_centre = (step / frame.centre.volume) * volume_gradient(frame.centre, velocity);
    const Tensor3<Lane> over_volume = (step / frame.mean.volume) * volume_gradient(frame.mean, velocity);
    const SymmetricTensor<Lane> plane = rotated(symmetric_part(over_volume), frame.axes);
    const SymmetricTensor<Lane> across = rotated(symmetric_part(at_centre), frame.axes);
    const HourglassVectors<Lane> q = each_hourglass_mode([&](int mode) {
        return frame.axes * (step * velocity.hourglass[mode] - at_centre * frame.position.hourglass[mode]);
    });
    const auto& [bc, ca, ab, abc] = q;
    const auto& x = frame.hourglass;
    const auto& p = frame.linear;
    const BilinearMap<Lane>& map = frame.map;

    ThickShellModes<Lane> m;
    m.exx = plane.xx;
    m.eyy = plane.yy;
    m.twice_exy = 2.0 * plane.xy;
    const Lane shear = (1.0 / 32) * frame.inverse_thickness; // 2 / h, and 1 / 64 of sums over corners
    const Lane thick = 2.0 * shear * frame.inverse_thickness;
    m.gzx = 2.0 * across.zx;
    m.gyz = 2.0 * across.yz;
    m.ezz = across.zz + thick * (x[0].z * bc.z + x[1].z * ca.z + x[3].z * abc.z);
    m.shear_xi = shear * (dot(x[2], bc) + dot(x[0], ab));
    m.shear_eta = shear * (dot(x[2], ca) + dot(x[1], ab));
    m.shear_xi_slope = shear * (dot(p[0], bc) + dot(p[2], ab));
    m.shear_eta_slope = shear * (dot(p[1], ca) + dot(p[2], ab));
    m.thick_eta = thick * dot(p[2], bc);
    m.thick_xi = thick * dot(p[2], ca);
    m.thick_both = thick * dot(p[2], abc);

    const Lane eighth = broadcast<Lane>(0.125), per_area = 0.5 / frame.surface.area; // 1 / (8 J), J = A / 4
    const Lane x_by_x = per_area * (map.by * ca.x - map.ay * bc.x);
    const Lane x_by_y = per_area * (map.ax * bc.x - map.bx * ca.x);
    const Lane y_by_x = per_area * (map.by * ca.y - map.ay * bc.y);
    const Lane y_by_y = per_area * (map.ax * bc.y - map.bx * ca.y);
    m.kxx = x_by_x;
    m.kyy = y_by_y;
    m.twice_kxy = x_by_y + y_by_x;
    m.ux = eighth * ab.x;
    m.uy = eighth * ab.y;
    m.bx = eighth * (abc.x - x_by_x * x[2].x - x_by_y * x[2].y);
    m.by = eighth * (abc.y - y_by_x * x[2].x - y_by_y * x[2].y);
    return m;
}

/// Transpose of thick_shell_modes(), with the sign of forces on the nodes; `frame` is that of now.
/// c  conjugates: what does work on the modes of a step
template <class Lane>
inline SolidModes<Lane> thick_shell_forces(const ThickShellFrame<Lane>& frame, const ThickShellModes<Lane>& c)
{
    const auto& x = frame.hourglass;
    const auto& p = frame.linear;
    const BilinearMap<Lane>& map = frame.map;
    const Lane eighth = broadcast<Lane>(0.125), per_area = 0.5 / frame.surface.area;
    const Lane shear = (1.0 / 32) * frame.inverse_thickness, thick = 2.0 * shear * frame.inverse_thickness;
    const Lane x_by_x = per_area * (c.kxx - eighth * x[2].x * c.bx);
    const Lane x_by_y = per_area * (c.twice_kxy - eighth * x[2].y * c.bx);
    const Lane y_by_x = per_area * (c.twice_kxy - eighth * x[2].x * c.by);
    const Lane y_by_y = per_area * (c.kyy - eighth * x[2].y * c.by);
    const Lane xi = shear * c.shear_xi, eta = shear * c.shear_eta;
    const Lane xi_slope = shear * c.shear_xi_slope, eta_slope = shear * c.shear_eta_slope;

    HourglassVectors<Lane> local{
        xi_slope * p[0] + xi * x[2] + (thick * c.thick_eta) * p[2],
        eta_slope * p[1] + eta * x[2] + (thick * c.thick_xi) * p[2],
        (xi_slope + eta_slope) * p[2] + xi * x[0] + eta * x[1],
        (thick * c.thick_both) * p[2],
    };
    local[0].z += thick * c.ezz * x[0].z;
    local[1].z += thick * c.ezz * x[1].z;
    local[3].z += thick * c.ezz * x[3].z;
    local[0].x += map.ax * x_by_y - map.ay * x_by_x;
    local[0].y += map.ax * y_by_y - map.ay * y_by_x;
    local[1].x += map.by * x_by_x - map.bx * x_by_y;
    local[1].y += map.by * y_by_x - map.bx * y_by_y;
    local[2].x += eighth * c.ux;
    local[2].y += eighth * c.uy;
    local[3].x += eighth * c.bx;
    local[3].y += eighth * c.by;

    const auto to_global = [&](const SymmetricTensor<Lane>& s) {
        const Tensor3<Lane>& r = frame.axes;
        const SymmetricTensor<Lane> g =
            rotated(s, Tensor3<Lane>{r.xx, r.yx, r.zx, r.xy, r.yy, r.zy, r.xz, r.yz, r.zz});
        return Tensor3<Lane>{g.xx, g.xy, g.zx, g.xy, g.yy, g.yz, g.zx, g.yz, g.zz};
    };
    const Lane zero{};
    const Tensor3<Lane> plane = to_global({c.exx, c.eyy, zero, c.twice_exy, zero, zero});
    Tensor3<Lane> across = to_global({zero, zero, c.ezz, zero, c.gyz, c.gzx});
    HourglassVectors<Lane> force;
    for (int mode = 0; mode < 4; ++mode) {
        force[mode] = -transposed_times(frame.axes, local[mode]);
        across.add_dyad(force[mode], frame.position.hourglass[mode]);
    }
    const SolidModes<Lane> centre = stress_divergence(frame.centre, (-1.0 / frame.centre.volume) * across);
    SolidModes<Lane> forces = stress_divergence(frame.mean, (-1.0 / frame.mean.volume) * plane);
    for (int i = 0; i < 3; ++i) forces.linear[i] += centre.linear[i];
    for (int mode = 0; mode < 4; ++mode) forces.hourglass[mode] += force[mode];
    return forces;
}

/// Strains at a point of the plane: those of its mid-surface, and what grows with c.
template <class Lane>
struct ThickShellPlane {
    Lane exx, eyy, twice_exy, kxx, kyy, twice_kxy, ezz, gyz, gzx;
};

/// xi, eta  natural coordinates of the point, whose map is `map`
template <class Lane>
inline ThickShellPlane<Lane> at_column(const ThickShellModes<Lane>& m, const MapAtPoint<Lane>& map, double xi,
                                       double eta, double poisson_ratio)
{
    const Lane per_area = 1.0 / map.area;
    const Lane hx = per_area * map.hx, hy = per_area * map.hy;
    const Lane stretch_x = hx * m.ux, stretch_y = hy * m.uy;
    const Lane shear_xi = m.shear_xi + eta * m.shear_xi_slope;
    const Lane shear_eta = m.shear_eta + xi * m.shear_eta_slope;
    return {m.exx + stretch_x - poisson_ratio * stretch_y,
            m.eyy + stretch_y - poisson_ratio * stretch_x,
            m.twice_exy,
            m.kxx + hx * m.bx,
            m.kyy + hy * m.by,
            m.twice_kxy + hy * m.bx + hx * m.by,
            m.ezz + eta * m.thick_eta + xi * m.thick_xi + (xi * eta) * m.thick_both,
            m.gyz + per_area * (map.x_xi * shear_eta - map.x_eta * shear_xi),
            m.gzx + per_area * (map.y_eta * shear_xi - map.y_xi * shear_eta)};
}

/// Transpose of at_column(): adds the conjugates of a column, which has `weight` of the volume for each unit
/// of the map's area.
template <class Lane>
inline void add_column(const ThickShellPlane<Lane>& n, const MapAtPoint<Lane>& map, double xi, double eta,
                       double poisson_ratio, const Lane& weight, ThickShellModes<Lane>& c)
{
    const Lane volume = weight * map.area, hx = weight * map.hx, hy = weight * map.hy;
    c.exx += volume * n.exx;
    c.eyy += volume * n.eyy;
    c.twice_exy += volume * n.twice_exy;
    c.kxx += volume * n.kxx;
    c.kyy += volume * n.kyy;
    c.twice_kxy += volume * n.twice_kxy;
    c.ux += hx * (n.exx - poisson_ratio * n.eyy);
    c.uy += hy * (n.eyy - poisson_ratio * n.exx);
    c.bx += hx * n.kxx + hy * n.twice_kxy;
    c.by += hy * n.kyy + hx * n.twice_kxy;
    c.ezz += volume * n.ezz;
    c.thick_eta += eta * volume * n.ezz;
    c.thick_xi += xi * volume * n.ezz;
    c.thick_both += (xi * eta) * volume * n.ezz;
    c.gyz += volume * n.gyz;
    c.gzx += volume * n.gzx;
    const Lane xi_force = weight * (map.y_eta * n.gzx - map.x_eta * n.gyz);
    const Lane eta_force = weight * (map.x_xi * n.gyz - map.y_xi * n.gzx);
    c.shear_xi += xi_force;
    c.shear_xi_slope += eta * xi_force;
    c.shear_eta += eta_force;
    c.shear_eta_slope += xi * eta_force;
}

} // namespace plash
