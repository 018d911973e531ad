#pragma once

#include <vector>

namespace plash {

/// A value over time, as a run or a test rig recorded it. Times never go down.
struct Curve {
    std::vector<double> time;  ///< [time]
    std::vector<double> value; ///< whatever was recorded

    bool empty() const { return time.empty(); }
    std::size_t size() const { return time.size(); }
};

/// Linear interpolation; before the first and behind the last point the curve keeps their values. Wants at
/// least one point.
double value_at(const Curve& curve, double time);

/// The curve at `count` times evenly spread from `from` to `to`, both included. Wants count > 1.
Curve resampled(const Curve& curve, double from, double to, std::size_t count);

/// The span that both curves cover: {later start, earlier end}; the second is not above the first when they
/// share none.
struct Span {
    double from = 0, to = 0; ///< [time]
};
Span common_span(const Curve& a, const Curve& b);

/// Integral over the whole curve by the trapezoidal rule: of a force its impulse [value * time].
double impulse(const Curve& curve);

/// The point of the largest absolute value.
struct Peak {
    double time = 0, value = 0;
};
Peak peak(const Curve& curve);

} // namespace plash
