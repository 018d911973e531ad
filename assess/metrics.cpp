#include "assess/metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace plash {

namespace {

/// Integral of a product over evenly spaced samples, by the trapezoidal rule, without the spacing.
double product_sum(const std::vector<double>& a, const std::vector<double>& b)
{
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0) -
           0.5 * (a.front() * b.front() + a.back() * b.back());
}

SpragueGeers sprague_geers(const std::vector<double>& measured, const std::vector<double>& computed)
{
    const double mm = product_sum(measured, measured), cc = product_sum(computed, computed);
    const double mc = product_sum(measured, computed);
    SpragueGeers result;
    if (mm == 0 && cc == 0) return result; // nothing beside nothing
    result.magnitude = std::sqrt(cc / mm) - 1;
    result.phase = mm == 0 || cc == 0
                       ? 0.5
                       : std::acos(std::clamp(mc / std::sqrt(mm * cc), -1.0, 1.0)) / std::numbers::pi;
    result.comprehensive = std::hypot(result.magnitude, result.phase);
    return result;
}

} // namespace

CurveErrors curve_errors(const TimeCurve& reference, const TimeCurve& computed, std::size_t samples)
{
    const Span span = common_span(reference, computed);
    const TimeCurve measured = resampled(reference, span.from, span.to, samples);
    const TimeCurve found = resampled(computed, span.from, span.to, samples);
    const Peak measured_peak = peak(measured), found_peak = peak(found);
    CurveErrors errors;
    errors.peak = (found_peak.value - measured_peak.value) / measured_peak.value;
    errors.peak_time = found_peak.time - measured_peak.time;
    errors.impulse = impulse(found) / impulse(measured) - 1;
    double squares = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const double difference = found.value[i] - measured.value[i];
        squares += difference * difference;
    }
    errors.rms = std::sqrt(squares / static_cast<double>(samples)) / std::abs(measured_peak.value);
    errors.sprague_geers = sprague_geers(measured.value, found.value);
    return errors;
}

} // namespace plash
