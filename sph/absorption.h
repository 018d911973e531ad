#pragma once

#include "sph/pairs.h"

/// Boundaries that waves leave through (*BOUNDARY_SPH_NON_REFLECTING). A wave that comes to the plane at a
/// right angle and goes on has the traction of Lysmer & Kuhlemeyer (1969), J. Eng. Mech. Div. ASCE 95,
/// 859-877, eqs. 1 and 2: -(p_rest + rho c v_n) along the plane's normal and -rho c_s v_t in it, v being what
/// the velocity has changed by since the start: the medium beyond goes on as it began. Images behind the
/// plane have the velocities of their originals, carried on linearly, so that they do not hold the fluid
/// back, and their push makes the mean of both that traction.
namespace plash {

/// What the medium beyond the plane answers with.
struct Impedance {
    double normal = 0;        ///< density times the speed of longitudinal waves [stress/velocity]
    double shear = 0;         ///< and of shear waves
    double rest_pressure = 0; ///< what the particle had at the start [stress]
    double scaling = 1;       ///< of pushes, see PushRecord
};

/// Push of an image from that of its original [scaled pressure]. outward  unit normal, away from the
/// particles
inline double absorbing_push(double push, const Impedance& medium, const Vec3& outward, const Vec3& velocity)
{
    const double wanted = medium.rest_pressure + medium.normal * dot(velocity, outward);
    return 2 * medium.scaling * wanted - push;
}

/// The same with tensors: adds r n + n r - (r . n) n n, twice, r being what the push of the original, along
/// the normal, lacks.
inline void absorb_tension(TensionRecord& tension, double& last, const Impedance& medium, const Vec3& outward,
                           const Vec3& velocity)
{
    double* t = tension.component;
    const double normal_speed = dot(velocity, outward);
    const Vec3 along = velocity - normal_speed * outward;
    const Vec3 now{t[0] * outward.x + t[1] * outward.y + t[2] * outward.z,
                   t[3] * outward.x + t[4] * outward.y + t[5] * outward.z,
                   t[6] * outward.x + t[7] * outward.y + last * outward.z};
    const double pressure = medium.rest_pressure + medium.normal * normal_speed;
    const Vec3 r = medium.scaling * (pressure * outward + medium.shear * along) - now;
    const double twice = dot(r, outward);
    const double lacking[3] = {r.x, r.y, r.z}, n[3] = {outward.x, outward.y, outward.z};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double change = 2 * (lacking[i] * n[j] + n[i] * lacking[j] - twice * n[i] * n[j]);
            (i == 2 && j == 2 ? last : t[3 * i + j]) += change;
        }
    }
}

} // namespace plash
