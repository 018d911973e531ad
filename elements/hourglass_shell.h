#pragma once

#include "elements/shell_pattern.h"

namespace plash {

/// Hourglass control of a group of one-point quadrilaterals (*HOURGLASS IHQ, QM, QB, QW).
struct ShellHourglass {
    enum class Kind { viscous, stiffness };
    Kind kind = Kind::viscous;
    double membrane = 0.1; ///< QM
    double bending = 0.1;  ///< QB
    double warping = 0.1;  ///< QW
};

/// What the hourglass coefficients of a group are made of.
struct ShellStiffness {
    double young_modulus;  ///< [stress]
    double shear_modulus;  ///< [stress]
    double shear_factor;   ///< SHRF
    double wave_impedance; ///< density * plate wave speed [mass / (length^2 time)]
};

/// Forces (x, y, z) and moments (x, y) conjugate to the hourglass rates of velocity and rotation, in the
/// element's frame.
template <class Lane>
struct ShellHourglassForce {
    Vector3<Lane> force;
    Lane moment_x, moment_y;
};

/// Hourglass forces at the end of a step.
/// increment  hourglass displacements of the step gamma . v * time_step (same components as the result)
/// old        forces at its beginning
///
/// Stiffness form: Belytschko, Lin & Tsay (1984), rates of the generalised hourglass stresses
///   QM E t A B.B / 8,   QB E t^3 A B.B / 192,   QW kappa G t^3 B.B / 12,
/// B.B the sum of squares of the gradient operator (Hallquist 2006, 'Hourglass control').
/// Viscous form, after Flanagan & Belytschko (1981): QM rho c t sqrt(A) / 4 and QW rho c t sqrt(A) / 4 on the
/// velocities. The manual does not print LS-DYNA's coefficients; with these the early history of a plate
/// strip and the energy it loses agree with LS-DYNA's own output (docs/shells.md).
/// Rotations take QB rho c t^3 sqrt(A) / 96: the ratio of bending to membrane is that of the stiffness form.
template <class Lane>
inline ShellHourglassForce<Lane> shell_hourglass_force(const ShellHourglass& control,
                                                       const ShellStiffness& stiffness,
                                                       const ShellFrame<Lane>& frame, Lane thickness,
                                                       const ShellHourglassForce<Lane>& increment,
                                                       double time_step, const ShellHourglassForce<Lane>& old)
{
    const Lane square = thickness * thickness;
    if (control.kind == ShellHourglass::Kind::stiffness) {
        // B.B = (sum over both diagonals of their squared length) / (2 A^2)
        const Lane diagonals =
            frame.x13 * frame.x13 + frame.y13 * frame.y13 + frame.x24 * frame.x24 + frame.y24 * frame.y24;
        const Lane inverse_area = 1.0 / frame.area;
        const Lane scale = 0.5 * diagonals * inverse_area * thickness;
        const Lane membrane = (control.membrane * stiffness.young_modulus / 8) * scale;
        const Lane bending = (control.bending * stiffness.young_modulus / 192) * scale * square;
        const Lane warping = (control.warping * stiffness.shear_factor * stiffness.shear_modulus / 12) *
                             scale * square * inverse_area;
        return {{old.force.x + membrane * increment.force.x, old.force.y + membrane * increment.force.y,
                 old.force.z + warping * increment.force.z},
                old.moment_x + bending * increment.moment_x,
                old.moment_y + bending * increment.moment_y};
    }
    const double rate = time_step > 0 ? 1 / time_step : 0;
    const Lane base = (0.25 * rate * stiffness.wave_impedance) * thickness * sqrt(frame.area);
    const Lane membrane = control.membrane * base;
    const Lane bending = (control.bending / 24) * base * square;
    const Lane warping = control.warping * base;
    return {{membrane * increment.force.x, membrane * increment.force.y, warping * increment.force.z},
            bending * increment.moment_x,
            bending * increment.moment_y};
}

} // namespace plash
