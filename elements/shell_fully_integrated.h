#pragma once

#include "elements/shell_kernel.h"
#include "elements/shell_warping.h"

namespace plash {

/// The bilinear map of a flat quadrilateral in its frame: x,xi = ax + cx eta and x,eta = bx + cx xi, and the
/// same for y.
template <class Lane>
struct BilinearMap {
    Lane ax, ay, bx, by, cx, cy;
};

template <class Lane>
inline BilinearMap<Lane> bilinear_map(const ShellFrame<Lane>& frame)
{
    return {0.25 * (frame.x13 - frame.x24), 0.25 * (frame.y13 - frame.y24), 0.25 * (frame.x13 + frame.x24),
            0.25 * (frame.y13 + frame.y24), 0.25 * frame.x_hourglass,       0.25 * frame.y_hourglass};
}

/// The map at one point of the 2 x 2 rule, times its determinant where that saves a quotient.
template <class Lane>
struct MapAtPoint {
    Lane x_xi, y_xi, x_eta, y_eta;
    Lane area;   ///< share of the point: the determinant [length^2]
    Lane hx, hy; ///< gradient of xi eta times the determinant [length]
};

template <class Lane>
inline MapAtPoint<Lane> map_at(const BilinearMap<Lane>& map, double xi, double eta)
{
    MapAtPoint<Lane> point;
    point.x_xi = map.ax + eta * map.cx;
    point.y_xi = map.ay + eta * map.cy;
    point.x_eta = map.bx + xi * map.cx;
    point.y_eta = map.by + xi * map.cy;
    point.area = point.x_xi * point.y_eta - point.x_eta * point.y_xi;
    point.hx = eta * point.y_eta - xi * point.y_xi;
    point.hy = xi * point.x_xi - eta * point.x_eta;
    return point;
}

/// Kinematics of the fully integrated shell over one step, or the forces conjugate to them: constant parts,
/// hourglass parts gamma . v and gamma . r, and the covariant transverse shears m + d eta and n + e xi.
template <class Lane>
struct FullShellModes {
    Lane exx, eyy, twice_exy;        ///< membrane strain at the centre
    Lane kxx, kyy, twice_kxy;        ///< curvature at the centre
    Lane vx, vy, rx, ry;             ///< hourglass displacements and rotations
    Lane shear_xi, shear_xi_slope;   ///< m, d
    Lane shear_eta, shear_eta_slope; ///< n, e
};

/// Fully integrated shell with assumed strains (ELFORM 16): 2 x 2 columns of points in the plane.
/// Membrane strain: constant part of one-point integration plus hourglass modes without parasitic shear and
/// with the lateral strain of bending (Belytschko & Bindeman 1991, Comput. Meth. Appl. Mech. Engng 88,
/// 311-340, 'ASQBI'), which on parallelograms is the element of Pian & Sumihara (1984). Curvature: bilinear
/// rotations. Transverse shear: sampled at the sides (Dvorkin & Bathe 1984). Warping as for BWC = 1
/// (elements/shell_warping.h). The manual (Hallquist 2006, 'Fully integrated shell, type 16') names the same
/// ingredients.
struct FullyIntegratedShell {
    static constexpr int plane_points = 4;
    static constexpr double place = 0.57735026918962576; ///< 1 / sqrt(3)

    template <class Lane>
    static FullShellModes<Lane> modes(const ShellFrame<Lane>& frame, const CornerPattern<Lane>& velocity,
                                      const CornerPattern<Lane>& spin, double time_step)
    {
        const BilinearMap<Lane> map = bilinear_map(frame);
        const Lane step = broadcast<Lane>(time_step);
        const Lane scale = (0.5 * time_step) / frame.area;
        const Lane x13 = frame.x13, y13 = frame.y13, x24 = frame.x24, y24 = frame.y24;
        const Lane hx = frame.x_hourglass, hy = frame.y_hourglass, hz = frame.z_hourglass;
        const Vector3<Lane> v13 = frame.to_local(velocity.diagonal13);
        const Vector3<Lane> v24 = frame.to_local(velocity.diagonal24);
        const Vector3<Lane> vh = frame.to_local(velocity.alternating);
        const Vector3<Lane> r13 = frame.to_local(spin.diagonal13), r24 = frame.to_local(spin.diagonal24);
        const Vector3<Lane> rh = frame.to_local(spin.alternating), r_sum = frame.to_local(spin.sum);
        const Vector3<Lane> v_by_x = scale * (y24 * v13 - y13 * v24);
        const Vector3<Lane> v_by_y = scale * (x13 * v24 - x24 * v13);
        const Vector3<Lane> r_by_x = scale * (y24 * r13 - y13 * r24);
        const Vector3<Lane> r_by_y = scale * (x13 * r24 - x24 * r13);
        const ShellWarpingRates<Lane> warping = warping_rates(frame, v13, v24, spin);

        FullShellModes<Lane> result;
        result.exx = v_by_x.x;
        result.eyy = v_by_y.y;
        result.twice_exy = v_by_y.x + v_by_x.y;
        result.kxx = r_by_x.y + step * warping.kxx;
        result.kyy = step * warping.kyy - r_by_y.x;
        result.twice_kxy = r_by_y.y - r_by_x.x + step * warping.twice_kxy;
        result.vx = step * vh.x - hx * v_by_x.x - hy * v_by_y.x + hz * v_by_x.z;
        result.vy = step * vh.y - hx * v_by_x.y - hy * v_by_y.y + hz * v_by_y.z;
        result.rx = step * rh.x - hx * r_by_x.x - hy * r_by_y.x;
        result.ry = step * rh.y - hx * r_by_x.y - hy * r_by_y.y;

        // The ends of the fibres move by (ry, -rx) per height; a . r stands for that along a side.
        const auto along = [&](Lane x, Lane y, const Vector3<Lane>& r) { return x * r.y - y * r.x; };
        const Lane mean_x = 0.25 * r_sum.y + warping.shear.zx, mean_y = warping.shear.yz - 0.25 * r_sum.x;
        const Lane warp = 0.25 * vh.z + (1.0 / 16) * along(hx, hy, r_sum);
        const Lane h13 = (1.0 / 16) * along(hx, hy, r13), h24 = (1.0 / 16) * along(hx, hy, r24);
        const Lane a13 = 0.25 * along(map.ax, map.ay, r13), a24 = 0.25 * along(map.ax, map.ay, r24);
        const Lane b13 = 0.25 * along(map.bx, map.by, r13), b24 = 0.25 * along(map.bx, map.by, r24);
        result.shear_xi = step * (0.25 * (v13.z - v24.z) + map.ax * mean_x + map.ay * mean_y + h13 + h24);
        result.shear_eta = step * (0.25 * (v13.z + v24.z) + map.bx * mean_x + map.by * mean_y + h13 - h24);
        result.shear_xi_slope = step * (warp + a13 + a24);
        result.shear_eta_slope = step * (warp + b13 - b24);
        return result;
    }

    /// Transpose of modes(), with the sign of forces on the nodes.
    template <class Lane>
    static void forces(const ShellFrame<Lane>& frame, const FullShellModes<Lane>& conjugate,
                       CornerPattern<Lane>& force, CornerPattern<Lane>& moment)
    {
        const BilinearMap<Lane> map = bilinear_map(frame);
        const Lane per_area = 0.5 / frame.area; // half because gradients along diagonals carry 1 / (2 A)
        const Lane x13 = frame.x13, y13 = frame.y13, x24 = frame.x24, y24 = frame.y24;
        const Lane hx = frame.x_hourglass, hy = frame.y_hourglass, hz = frame.z_hourglass;
        const FullShellModes<Lane>& c = conjugate;
        const Lane quarter = broadcast<Lane>(0.25), sixteenth = broadcast<Lane>(1.0 / 16);

        // Conjugates of the gradients of v and r.
        const Vector3<Lane> v_by_x = {c.exx - hx * c.vx, c.twice_exy - hx * c.vy, hz * c.vx};
        const Vector3<Lane> v_by_y = {c.twice_exy - hy * c.vx, c.eyy - hy * c.vy, hz * c.vy};
        const Lane rx_by_x = -c.twice_kxy - hx * c.rx, ry_by_x = c.kxx - hx * c.ry;
        const Lane rx_by_y = -c.kyy - hy * c.rx, ry_by_y = c.twice_kxy - hy * c.ry;
        const Lane slopes = c.shear_xi_slope + c.shear_eta_slope;
        const Lane total = c.shear_xi + c.shear_eta, contrast = c.shear_xi - c.shear_eta;

        Vector3<Lane> f13 = per_area * (y24 * v_by_x - x24 * v_by_y);
        Vector3<Lane> f24 = per_area * (x13 * v_by_y - y13 * v_by_x);
        f13.z += quarter * total;
        f24.z -= quarter * contrast;
        const Vector3<Lane> fh = {c.vx, c.vy, quarter * slopes};

        // Conjugates of the ends of the fibres (ry, -rx): along diagonal 1-3, 2-4 and of the sum.
        const auto fibre = [&](Lane h, Lane a, Lane b) {
            return Vector3<Lane>{h * hx + a * map.ax + b * map.bx, h * hy + a * map.ay + b * map.by, Lane{}};
        };
        const Vector3<Lane> s13 =
            fibre(sixteenth * total, quarter * c.shear_xi_slope, quarter * c.shear_eta_slope);
        const Vector3<Lane> s24 =
            fibre(sixteenth * contrast, quarter * c.shear_xi_slope, -quarter * c.shear_eta_slope);
        const Vector3<Lane> mean = fibre(Lane{}, c.shear_xi, c.shear_eta);
        const Vector3<Lane> s_sum = fibre(sixteenth * slopes, Lane{}, Lane{}) + quarter * mean;
        const Lane mx13 = per_area * (y24 * rx_by_x - x24 * rx_by_y) - s13.y;
        const Lane my13 = per_area * (y24 * ry_by_x - x24 * ry_by_y) + s13.x;
        const Lane mx24 = per_area * (x13 * rx_by_y - y13 * rx_by_x) - s24.y;
        const Lane my24 = per_area * (x13 * ry_by_y - y13 * ry_by_x) + s24.x;

        const Lane inverse_area = 2.0 * per_area;
        const ShellNormalMoments<Lane> normal =
            add_warping_forces(frame, inverse_area * c.kxx, inverse_area * c.kyy, inverse_area * c.twice_kxy,
                               inverse_area * mean.x, inverse_area * mean.y, f13, f24);
        const auto global = [&](Lane x, Lane y, Lane z) { return frame.to_global({x, y, z}); };
        force.diagonal13 = -frame.to_global(f13);
        force.diagonal24 = -frame.to_global(f24);
        force.alternating = -frame.to_global(fh);
        force.sum = {};
        moment.diagonal13 = -global(mx13, my13, normal.z13);
        moment.diagonal24 = -global(mx24, my24, normal.z24);
        moment.alternating = -global(c.rx, c.ry, normal.z_alternating);
        moment.sum = -global(-s_sum.y, s_sum.x, normal.z_sum);
    }

    /// Strain increments of a column of points.
    template <class Lane>
    static ShellIncrement<Lane> at_point(const FullShellModes<Lane>& m, const MapAtPoint<Lane>& map,
                                         double xi, double eta, double poisson_ratio)
    {
        const Lane per_area = 1.0 / map.area, quarter = 0.25 * per_area;
        const Lane stretch_x = quarter * map.hx * m.vx, stretch_y = quarter * map.hy * m.vy;
        const Lane shear_xi = m.shear_xi + eta * m.shear_xi_slope;
        const Lane shear_eta = m.shear_eta + xi * m.shear_eta_slope;
        ShellIncrement<Lane> result;
        result.exx = m.exx + stretch_x - poisson_ratio * stretch_y;
        result.eyy = m.eyy + stretch_y - poisson_ratio * stretch_x;
        result.twice_exy = m.twice_exy;
        result.kxx = m.kxx + quarter * map.hx * m.ry;
        result.kyy = m.kyy - quarter * map.hy * m.rx;
        result.twice_kxy = m.twice_kxy + quarter * (map.hy * m.ry - map.hx * m.rx);
        result.gzx = per_area * (map.y_eta * shear_xi - map.y_xi * shear_eta);
        result.gyz = per_area * (map.x_xi * shear_eta - map.x_eta * shear_xi);
        return result;
    }

    /// Transpose of at_point(): adds the resultants of a column to the conjugate modes.
    template <class Lane>
    static void add_point(const ShellResultants<Lane>& n, const MapAtPoint<Lane>& map, double xi, double eta,
                          double poisson_ratio, FullShellModes<Lane>& c)
    {
        c.exx += map.area * n.nxx;
        c.eyy += map.area * n.nyy;
        c.twice_exy += map.area * n.nxy;
        c.kxx += map.area * n.mxx;
        c.kyy += map.area * n.myy;
        c.twice_kxy += map.area * n.mxy;
        c.vx += 0.25 * map.hx * (n.nxx - poisson_ratio * n.nyy);
        c.vy += 0.25 * map.hy * (n.nyy - poisson_ratio * n.nxx);
        c.rx -= 0.25 * (map.hy * n.myy + map.hx * n.mxy);
        c.ry += 0.25 * (map.hx * n.mxx + map.hy * n.mxy);
        const Lane q_xi = map.y_eta * n.qx - map.x_eta * n.qy, q_eta = map.x_xi * n.qy - map.y_xi * n.qx;
        c.shear_xi += q_xi;
        c.shear_xi_slope += eta * q_xi;
        c.shear_eta += q_eta;
        c.shear_eta_slope += xi * q_eta;
    }

    /// One step; see BelytschkoTsay::step.
    template <class Lane, class Law>
    static ShellStep<Lane> step(const ShellSettings& settings, const Law& law,
                                const CornerPattern<Lane>& position, const CornerPattern<Lane>& velocity,
                                const CornerPattern<Lane>& spin, double time_step, Lane* record)
    {
        using namespace shell_record;
        constexpr int point_size = history + static_cast<int>(Law::history_size);
        const ShellFrame<Lane> middle = shell_frame(mid_step(position, velocity, time_step));
        const ShellFrame<Lane> frame = shell_frame(position);
        const FullShellModes<Lane> increments = modes(middle, velocity, spin, time_step);
        const BilinearMap<Lane> middle_map = bilinear_map(middle), end_map = bilinear_map(frame);

        ShellStep<Lane> result;
        result.internal_work = result.hourglass_work = result.viscous_work = Lane{};
        FullShellModes<Lane> conjugate{};
        Lane thinning{};
        const double nu = settings.poisson_ratio;
        for (int column = 0; column < plane_points; ++column) {
            const double xi = column == 0 || column == 3 ? -place : place;
            const double eta = column < 2 ? -place : place;
            const MapAtPoint<Lane> at_middle = map_at(middle_map, xi, eta), at_end = map_at(end_map, xi, eta);
            ShellResultants<Lane> resultants;
            Lane thinning_here;
            const ShellIncrement<Lane> increment = at_point(increments, at_middle, xi, eta, nu);
            result.internal_work +=
                at_middle.area * update_points(settings, law, increment, time_step, record[thickness],
                                               record + points + column * settings.rule.size() * point_size,
                                               resultants, thinning_here, strains_of(settings, record));
            thinning += 0.25 * thinning_here;
            add_point(resultants, at_end, xi, eta, nu, conjugate);
        }
        if (settings.bulk_viscosity) {
            ShellResultants<Lane> bulk;
            result.viscous_work = middle.area * add_bulk_viscosity(settings, increments.exx + increments.eyy,
                                                                   frame.area, time_step, record, bulk);
            result.internal_work += result.viscous_work;
            conjugate.exx += frame.area * bulk.nxx;
            conjugate.eyy += frame.area * bulk.nyy;
        }
        if (settings.thickness_change) record[thickness] += record[thickness] * thinning;
        forces(frame, conjugate, result.force, result.moment);
        finish_step(settings, position, frame.area, record, result);
        return result;
    }
};

} // namespace plash
