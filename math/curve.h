#pragma once

#include <vector>

namespace plash {

/// Piecewise-linear function y(x) through points with rising abscissa; held constant beyond both ends.
struct Curve {
    std::vector<double> abscissa;
    std::vector<double> ordinate;

    /// y at x; zero when the curve has no points.
    double operator()(double x) const;

    /// dy/dx of the segment that holds x (of the right one at a point); zero beyond the ends.
    double slope(double x) const;
};

/// A curve that begins at zero or above, continued below zero with the opposite sign; others as they are.
Curve odd_curve(const Curve& given);

/// Largest slope of a curve; zero of one without segments.
double steepest_slope(const Curve& curve);

} // namespace plash
