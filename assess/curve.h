#pragma once

#include <vector>

namespace plash {

/// A value over time, as a run or a test rig recorded it. Times never go down.
struct TimeCurve {
    std::vector<double> time;  ///< [time]
    std::vector<double> value; ///< whatever was recorded

    bool empty() const { return time.empty(); }
    std::size_t size() const { return time.size(); }
};

/// Linear interpolation; before the first and behind the last point the curve keeps their values. Wants at
/// least one point.
double value_at(const TimeCurve& curve, double time);

/// The curve at `count` times evenly spread from `from` to `to`, both included. Wants count > 1.
TimeCurve resampled(const TimeCurve& curve, double from, double to, std::size_t count);

/// The span that both curves cover: {later start, earlier end}; the second is not above the first when they
/// share none.
struct Span {
    double from = 0, to = 0; ///< [time]
};
Span common_span(const TimeCurve& a, const TimeCurve& b);

/// Integral over the whole curve by the trapezoidal rule: of a force its impulse [value * time].
double impulse(const TimeCurve& curve);

/// The point of the largest absolute value.
struct Peak {
    double time = 0, value = 0;
};
Peak peak(const TimeCurve& curve);

} // namespace plash
