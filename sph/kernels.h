#pragma once

#include "math/lanes.h"

#include <numbers>
#include <string_view>

namespace plash {

/// Smoothing kernels W(r, h) = norm(d) / h^d * value(q) with q = r / h, zero from q = support on. `slope` is
/// d value / d q. Both are inline templates over the lane type; positive parts make them exact piecewise
/// polynomials without branches. `slope_by_q`, where it is there, is slope / q without a division. `norm`
/// takes the dimension, 2 or 3.

namespace kernel_detail {

template <class Lane>
inline Lane positive_part(Lane a)
{
    return max(a, broadcast<Lane>(0.0));
}

template <class Lane>
inline Lane square(Lane a)
{
    return a * a;
}

} // namespace kernel_detail

/// Cubic B-spline (Monaghan & Lattanzio 1985), SPHKERN = 0 and LS-DYNA's default.
struct CubicSpline {
    static constexpr std::string_view name = "cubic spline";
    static constexpr double support = 2;
    static constexpr double norm(int dimension)
    {
        return dimension == 2 ? 10 / (28 * std::numbers::pi) : 1 / (4 * std::numbers::pi);
    }
    template <class Lane>
    static Lane value(Lane q)
    {
        const Lane two = kernel_detail::positive_part(2.0 - q), one = kernel_detail::positive_part(1.0 - q);
        return two * two * two - 4.0 * (one * one * one);
    }
    template <class Lane>
    static Lane slope(Lane q)
    {
        const Lane two = kernel_detail::positive_part(2.0 - q), one = kernel_detail::positive_part(1.0 - q);
        return 12.0 * (one * one) - 3.0 * (two * two);
    }
};

/// Quartic spline (Schoenberg's M5), SPHKERN = 3.
struct QuarticSpline {
    static constexpr std::string_view name = "quartic spline";
    static constexpr double support = 2.5;
    static constexpr double norm(int dimension)
    {
        return dimension == 2 ? 96 / (1199 * std::numbers::pi) : 1 / (20 * std::numbers::pi);
    }
    template <class Lane>
    static Lane value(Lane q)
    {
        const Lane a = kernel_detail::square(kernel_detail::positive_part(2.5 - q));
        const Lane b = kernel_detail::square(kernel_detail::positive_part(1.5 - q));
        const Lane c = kernel_detail::square(kernel_detail::positive_part(0.5 - q));
        return a * a - 5.0 * (b * b) + 10.0 * (c * c);
    }
    template <class Lane>
    static Lane slope(Lane q)
    {
        const Lane a = kernel_detail::positive_part(2.5 - q), b = kernel_detail::positive_part(1.5 - q),
                   c = kernel_detail::positive_part(0.5 - q);
        return 20.0 * (b * b * b) - 4.0 * (a * a * a) - 40.0 * (c * c * c);
    }
};

/// Quintic spline (Morris 1996), SPHKERN = 1.
struct QuinticSpline {
    static constexpr std::string_view name = "quintic spline";
    static constexpr double support = 3;
    static constexpr double norm(int dimension)
    {
        return dimension == 2 ? 7 / (478 * std::numbers::pi) : 1 / (120 * std::numbers::pi);
    }
    template <class Lane>
    static Lane value(Lane q)
    {
        const Lane a = kernel_detail::positive_part(3.0 - q), b = kernel_detail::positive_part(2.0 - q),
                   c = kernel_detail::positive_part(1.0 - q);
        const Lane a2 = a * a, b2 = b * b, c2 = c * c;
        return a2 * a2 * a - 6.0 * (b2 * b2 * b) + 15.0 * (c2 * c2 * c);
    }
    template <class Lane>
    static Lane slope(Lane q)
    {
        const Lane a = kernel_detail::square(kernel_detail::positive_part(3.0 - q)),
                   b = kernel_detail::square(kernel_detail::positive_part(2.0 - q)),
                   c = kernel_detail::square(kernel_detail::positive_part(1.0 - q));
        return 30.0 * (b * b) - 5.0 * (a * a) - 75.0 * (c * c);
    }
};

/// Quadratic kernel (Johnson, Stryk & Beissel 1996), SPHKERN = 2: its slope is steepest at the centre, which
/// keeps particles from clumping under strong compression.
struct QuadraticKernel {
    static constexpr std::string_view name = "quadratic";
    static constexpr double support = 2;
    static constexpr double norm(int dimension)
    {
        return dimension == 2 ? 2 / std::numbers::pi : 5 / (4 * std::numbers::pi);
    }
    template <class Lane>
    static Lane value(Lane q)
    {
        return (3.0 / 16.0) * kernel_detail::square(kernel_detail::positive_part(2.0 - q));
    }
    template <class Lane>
    static Lane slope(Lane q)
    {
        return (-3.0 / 8.0) * kernel_detail::positive_part(2.0 - q);
    }
};

/// Wendland C2 (1995) with support 2 h, the kernel of DualSPHysics.
struct WendlandC2 {
    static constexpr std::string_view name = "Wendland C2";
    static constexpr double support = 2;
    static constexpr double norm(int dimension)
    {
        return dimension == 2 ? 7 / (4 * std::numbers::pi) : 21 / (16 * std::numbers::pi);
    }
    template <class Lane>
    static Lane value(Lane q)
    {
        const Lane a = kernel_detail::square(kernel_detail::positive_part(1.0 - 0.5 * q));
        return a * a * (2.0 * q + 1.0);
    }
    template <class Lane>
    static Lane slope_by_q(Lane q)
    {
        const Lane two = kernel_detail::positive_part(2.0 - q);
        return (-0.625 * two) * (two * two);
    }
    template <class Lane>
    static Lane slope(Lane q)
    {
        return q * slope_by_q(q);
    }
};

/// Wendland C4 (1995) with support 2 h.
struct WendlandC4 {
    static constexpr std::string_view name = "Wendland C4";
    static constexpr double support = 2;
    static constexpr double norm(int dimension)
    {
        return dimension == 2 ? 9 / (4 * std::numbers::pi) : 495 / (256 * std::numbers::pi);
    }
    template <class Lane>
    static Lane value(Lane q)
    {
        const Lane a = kernel_detail::positive_part(1.0 - 0.5 * q);
        const Lane a3 = a * a * a;
        return a3 * a3 * ((35.0 / 12.0) * q * q + 3.0 * q + 1.0);
    }
    template <class Lane>
    static Lane slope_by_q(Lane q)
    {
        const Lane a = kernel_detail::positive_part(1.0 - 0.5 * q);
        const Lane a2 = a * a;
        return ((-14.0 / 3.0) * (1.0 + 2.5 * q)) * (a2 * a2 * a);
    }
    template <class Lane>
    static Lane slope(Lane q)
    {
        return q * slope_by_q(q);
    }
};

enum class Kernel { cubic_spline, quintic_spline, quadratic, quartic_spline, wendland_c2, wendland_c4 };

/// function(kernel) with an object of the kernel's type; the choice is made once, outside of any loop.
template <class Function>
decltype(auto) with_kernel(Kernel kernel, Function&& function)
{
    switch (kernel) {
    case Kernel::quintic_spline:
        return function(QuinticSpline{});
    case Kernel::quadratic:
        return function(QuadraticKernel{});
    case Kernel::quartic_spline:
        return function(QuarticSpline{});
    case Kernel::wendland_c2:
        return function(WendlandC2{});
    case Kernel::wendland_c4:
        return function(WendlandC4{});
    case Kernel::cubic_spline:
        break;
    }
    return function(CubicSpline{});
}

} // namespace plash
