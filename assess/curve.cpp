#include "assess/curve.h"

#include <algorithm>
#include <cmath>

namespace plash {

double value_at(const TimeCurve& curve, double time)
{
    const auto behind = std::upper_bound(curve.time.begin(), curve.time.end(), time);
    if (behind == curve.time.begin()) return curve.value.front();
    if (behind == curve.time.end()) return curve.value.back();
    const std::size_t i = behind - curve.time.begin();
    const double share = (time - curve.time[i - 1]) / (curve.time[i] - curve.time[i - 1]);
    return curve.value[i - 1] + share * (curve.value[i] - curve.value[i - 1]);
}

TimeCurve resampled(const TimeCurve& curve, double from, double to, std::size_t count)
{
    TimeCurve result;
    result.time.reserve(count);
    result.value.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double time = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
        result.time.push_back(time);
        result.value.push_back(value_at(curve, time));
    }
    return result;
}

Span common_span(const TimeCurve& a, const TimeCurve& b)
{
    return {std::max(a.time.front(), b.time.front()), std::min(a.time.back(), b.time.back())};
}

double impulse(const TimeCurve& curve)
{
    double sum = 0;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        sum += 0.5 * (curve.value[i - 1] + curve.value[i]) * (curve.time[i] - curve.time[i - 1]);
    }
    return sum;
}

Peak peak(const TimeCurve& curve)
{
    const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const std::size_t i =
        std::max_element(curve.value.begin(), curve.value.end(), smaller) - curve.value.begin();
    return {curve.time[i], curve.value[i]};
}

} // namespace plash
