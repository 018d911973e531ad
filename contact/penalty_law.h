#pragma once

#include "contact/touch.h"

#include <algorithm>
#include <cmath>

namespace plash {

/// Force of a touch from its penetration: linear, with the kink at the onset rounded over the distance that
/// the node came in by in the step in which it was found. The work of a bounce in explicit steps then closes
/// to about a thousandth; with the kink, the half step of full force at either end leaves up to (omega dt)^2
/// / 4 of the peak.
template <class Lane>
inline Lane rounded_force(const Lane& stiffness, const Lane& penetration, const Lane& rounding)
{
    const Lane zero{};
    const Lane least = broadcast<Lane>(1e-300); // what is divided by it is not taken without rounding
    const Lane soft = (0.5 * stiffness) * penetration * penetration / max(rounding, least);
    const Lane plain = stiffness * (penetration - 0.5 * rounding);
    return penetration > zero ? (penetration < rounding ? soft : plain) : zero;
}

/// What a touch with rounded_force() stores: the integral of the force over the penetration.
template <class Lane>
inline Lane rounded_energy(const Lane& stiffness, const Lane& penetration, const Lane& rounding)
{
    const Lane zero{};
    const Lane least = broadcast<Lane>(1e-300);
    const Lane square = penetration * penetration;
    const Lane soft = (stiffness / 6) * penetration * square / max(rounding, least);
    const Lane plain = (0.5 * stiffness) * (square - rounding * penetration + rounding * rounding / 3);
    return penetration > zero ? (penetration < rounding ? soft : plain) : zero;
}

/// Stiffness that PENOPT of *CONTROL_CONTACT takes from those of node and segment: 1 the smaller one, 2 and
/// others the segment's, 3 the node's; a node without one takes the segment's.
inline double unscaled_stiffness(int option, double node, double segment)
{
    if (node <= 0) return segment;
    if (option == 1) return segment > 0 ? std::min(node, segment) : node;
    return option == 3 ? node : segment;
}

/// Coulomb coefficient that decays with the sliding speed: FD + (FS - FD) exp(-DC |v|).
struct Friction {
    double at_rest = 0;   ///< FS [-]
    double moving = 0;    ///< FD [-]
    double decay = 0;     ///< DC [time/length]
    double shear_cap = 0; ///< VC: largest friction stress [stress]; 0: none

    double coefficient(double speed) const
    {
        return decay == 0 ? at_rest : moving + (at_rest - moving) * std::exp(-decay * speed);
    }
    bool any() const { return at_rest > 0 || moving > 0; }
};

/// Tangential force on the node after a step (Hallquist 2006, 'Friction'): the old force carried into the
/// tangent plane less stiffness times the slip of this step, cut back to the friction limit. slip   relative
/// tangential motion of the node over the facet in the step [length] limit  largest friction force [force]
template <class Lane>
inline Vector3<Lane> friction_force(const Vector3<Lane>& before, const Vector3<Lane>& normal,
                                    const Vector3<Lane>& slip, const Lane& stiffness, const Lane& limit)
{
    const Vector3<Lane> trial = before - dot(before, normal) * normal - stiffness * slip;
    const Lane size = sqrt(dot(trial, trial)), one = broadcast<Lane>(1);
    return (size > limit ? limit / max(size, broadcast<Lane>(1e-300)) : one) * trial;
}

/// Damping coefficient for a percentage of critical damping of node and facet on the contact spring
/// (Hallquist 2006, 'Contact damping'): c = 2 xi min(m_s, m_m) omega, omega^2 = k (m_s + m_m) / (m_s m_m).
template <class Lane>
inline Lane damping_coefficient(double percent, const Lane& stiffness, const Lane& node_mass,
                                const Lane& facet_mass)
{
    const Lane zero{}, smaller = min(node_mass, facet_mass);
    const Lane omega =
        sqrt(stiffness * (node_mass + facet_mass) / max(node_mass * facet_mass, broadcast<Lane>(1e-300)));
    return smaller > zero ? (0.02 * percent) * smaller * omega : zero;
}

} // namespace plash
