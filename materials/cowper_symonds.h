#pragma once

#include "materials/von_mises.h"
#include "math/lanes_math.h"

namespace plash {

/// Viscoplastic flow of Cowper & Symonds (1957): the flow stress is (1 + (rate / constant)^(1 / exponent))
/// times the static one, with the rate of effective plastic strain.
struct CowperSymonds {
    double constant = 0; ///< C [1/time]; 0: no rate effect
    double exponent = 1; ///< P

    /// Multiplier m of the return over a step: q(m) = (1 + r) (yield + hardening d) with the plastic strain
    /// d = 2/3 m q(m) of the step and the overstress ratio r = (d / (C dt))^(1/P); zero inside the static
    /// surface.
    ///
    /// Solved for r: d, the flow stress and then m follow from it without a root, and for P >= 1 what is
    /// left, q(m) - (1 + r) (yield + hardening d), falls with r and is concave, so that Newton's method comes
    /// down to it from above without a look back. (In m or d the root of the rate has an infinite slope at
    /// rest.) yield      static yield stress at the start of the step [stress] hardening  its growth with
    /// plastic strain [stress]
    template <class Lane>
    [[gnu::noinline]] Lane multiplier(const PlaneStressPath<Lane>& path, const Lane& yield, double hardening,
                                      double time_step) const
    {
        constexpr int most_rounds = 60;
        constexpr double near = 1e-7, round_off = 1e-14;
        const Lane trial = sqrt(path.slow_square + path.fast_square);
        const MaskOf<Lane> yielding = trial > yield;
        if (!any(yielding)) return Lane{};
        const double unit = constant * time_step; // plastic strain of the step at r = 1
        if (unit == 0) return Lane{};
        const Lane excess = yielding ? trial - yield : Lane{};

        // From above: the overstress alone takes up the excess, or the flow alone does.
        const double stiffness = 1.5 * min(path.slow, path.fast);
        const Lane by_flow = power<Lane>(excess * (1 / (stiffness * unit)), 1 / exponent);
        const Lane most = min(Lane{excess / yield}, by_flow);
        Lane ratio = most;
        MaskOf<Lane> open = yielding;
        for (int round = 0; round < most_rounds; ++round) {
            const Lane below = unit * raised_less_one(ratio); // plastic strain over the ratio
            const Lane strain = ratio * below, strain_rate = exponent * below;
            const Lane still = yield + hardening * strain, flow = (1.0 + ratio) * still;
            const Lane flow_rate = still + (1.0 + ratio) * (hardening * strain_rate);
            const Lane inverse_flow = 1.0 / flow;
            const Lane m = 1.5 * strain * inverse_flow;
            const Lane m_rate = (1.5 * strain_rate - m * flow_rate) * inverse_flow;
            const Lane a = 1.0 + path.slow * m, b = 1.0 + path.fast * m;
            const Lane inverse = 1.0 / (a * b), u = inverse * b, w = inverse * a;
            const Lane slow = path.slow_square * u * u, fast = path.fast_square * w * w;
            const Lane equivalent = sqrt(slow + fast);
            const Lane fall = path.slow * slow * u + path.fast * fast * w; // -q dq/dm
            const Lane left = equivalent - flow;
            const Lane slope = fall * m_rate + equivalent * flow_rate;
            const Lane newton = ratio + left * equivalent / max(slope, broadcast<Lane>(1e-300));
            // The bounds are for P < 1, where a step may overshoot.
            const Lane next = min(most, max(newton, Lane{0.125 * ratio}));
            ratio = open ? next : ratio;
            // A step that begins this near ends at round-off.
            open = open & (abs(left) > max(Lane{near * excess}, Lane{round_off * yield}));
            if (!any(open)) break;
        }
        const Lane strain = unit * ratio * raised_less_one(ratio);
        const Lane m = 1.5 * strain / ((1.0 + ratio) * (yield + hardening * strain));
        return yielding ? m : Lane{};
    }

    /// 1 + (rate / C)^(1/P) from the square of the rate.
    template <class Lane>
    [[gnu::noinline]] Lane factor(const Lane& rate_square) const
    {
        return 1.0 + power<Lane>(rate_square * (1 / (constant * constant)), 0.5 / exponent);
    }

private:
    /// ratio^(P - 1), by products where P is a small whole number, as it is for most metals (5 of mild
    /// steel).
    template <class Lane>
    Lane raised_less_one(const Lane& ratio) const
    {
        constexpr int most_products = 10;
        const int whole = static_cast<int>(min(exponent, most_products + 1.0));
        if (whole != exponent || whole > most_products) return power(ratio, exponent - 1);
        Lane product = broadcast<Lane>(1);
        for (int i = 1; i < whole; ++i) product *= ratio;
        return product;
    }
};

} // namespace plash
