#include "assess/iso_18571.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace plash {

namespace {

using Samples = std::span<const double>;

// Names and values as in ISO/TS 18571.
constexpr double inner_corridor = 0.05, outer_corridor = 0.5; // a_0, b_0, with exponent k_z = 2
constexpr double largest_shift = 0.2;                         // epsilon_P*
constexpr double largest_magnitude_error = 0.5;               // epsilon_M*
constexpr double largest_slope_error = 2;                     // epsilon_S*
constexpr double warping_window = 0.1;

double largest_size(Samples values)
{
    double largest = 0;
    for (double value : values) largest = std::max(largest, std::abs(value));
    return largest;
}

double corridor_score(Samples reference, Samples computed)
{
    const double size = largest_size(reference);
    const double inner = inner_corridor * size, outer = outer_corridor * size;
    double sum = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const double difference = std::abs(reference[i] - computed[i]);
        const double share = std::clamp((outer - difference) / (outer - inner), 0.0, 1.0);
        sum += difference <= inner ? 1 : share * share;
    }
    return sum / static_cast<double>(reference.size());
}

/// Pearson's coefficient; 1 for two constants, 0 when only one is constant.
double correlation(Samples a, Samples b)
{
    const double n = static_cast<double>(a.size());
    double mean_a = 0, mean_b = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        mean_a += a[i] / n;
        mean_b += b[i] / n;
    }
    double aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    if (aa == 0 && bb == 0) return 1;
    return aa == 0 || bb == 0 ? 0 : ab / std::sqrt(aa * bb);
}

/// What is left of both curves when the computed one comes `steps` late (negative: early).
struct Shifted {
    Samples reference, computed;
};

Shifted shifted(Samples reference, Samples computed, long steps)
{
    const std::size_t size = std::abs(steps), rest = reference.size() - size;
    return {reference.subspan(steps < 0 ? size : 0, rest), computed.subspan(steps > 0 ? size : 0, rest)};
}

/// The shift of best correlation; the smallest one where several are as good.
long best_shift(Samples reference, Samples computed)
{
    const long most = static_cast<long>(largest_shift * static_cast<double>(reference.size()));
    long best = 0;
    double highest = correlation(reference, computed);
    for (long size = 1; size <= most; ++size) {
        for (long steps : {size, -size}) {
            const Shifted pair = shifted(reference, computed, steps);
            const double value = correlation(pair.reference, pair.computed);
            if (value > highest) {
                highest = value;
                best = steps;
            }
        }
    }
    return best;
}

/// Dynamic time warping (Sakoe & Chiba 1978) with squared local costs in a band; then the sum of differences
/// along the path over the sum of the reference's sizes along it.
double warped_error(Samples reference, Samples computed)
{
    const long n = static_cast<long>(reference.size());
    const long band = static_cast<long>(std::ceil(warping_window * static_cast<double>(n))) - 1;
    const long width = 2 * band + 1;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // Row i holds the columns i - band ... i + band.
    std::vector<double> cost(static_cast<std::size_t>(n * width), infinity);
    const auto at = [&](long i, long j) -> double {
        if (i < 0 || j < 0 || std::abs(j - i) > band) return infinity;
        return cost[static_cast<std::size_t>(i * width + j - i + band)];
    };
    for (long i = 0; i < n; ++i) {
        for (long j = std::max(0L, i - band); j <= std::min(n - 1, i + band); ++j) {
            const double local = (computed[i] - reference[j]) * (computed[i] - reference[j]);
            const double before =
                i == 0 && j == 0 ? 0 : std::min({at(i - 1, j - 1), at(i - 1, j), at(i, j - 1)});
            cost[static_cast<std::size_t>(i * width + j - i + band)] = before + local;
        }
    }
    double difference = 0, size = 0;
    for (long i = n - 1, j = n - 1;;) {
        difference += std::abs(computed[i] - reference[j]);
        size += std::abs(reference[j]);
        if (i == 0 && j == 0) break;
        const double both = at(i - 1, j - 1), up = at(i - 1, j), left = at(i, j - 1);
        if (both <= up && both <= left) {
            --i, --j;
        } else if (up <= left) {
            --i;
        } else {
            --j;
        }
    }
    return difference / size;
}

/// Central differences (one-sided at the ends, over one step) averaged over nine points, fewer near the ends.
std::vector<double> smooth_slopes(Samples values)
{
    const long n = static_cast<long>(values.size());
    std::vector<double> slopes(n), smooth(n);
    for (long i = 0; i < n; ++i) {
        const long before = std::max(0L, i - 1), behind = std::min(n - 1, i + 1);
        slopes[i] = (values[behind] - values[before]) / static_cast<double>(behind - before);
    }
    for (long i = 0; i < n; ++i) {
        const long reach = std::min({4L, i, n - 1 - i});
        for (long j = i - reach; j <= i + reach; ++j) smooth[i] += slopes[j];
        smooth[i] /= static_cast<double>(2 * reach + 1);
    }
    return smooth;
}

double slope_error(Samples reference, Samples computed)
{
    const std::vector<double> wanted = smooth_slopes(reference), found = smooth_slopes(computed);
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        difference += std::abs(found[i] - wanted[i]);
        size += std::abs(wanted[i]);
    }
    return difference / size;
}

/// 1 without error, 0 at the largest error that still counts; a reference that is zero has no error only
/// where the computed curve is zero too.
double linear_score(double error, double largest)
{
    if (std::isnan(error)) return 1; // 0 / 0: both are zero throughout
    return std::clamp(1 - error / largest, 0.0, 1.0);
}

} // namespace

const char* IsoRating::grade() const
{
    return overall > 0.94 ? "excellent" : overall > 0.8 ? "good" : overall > 0.58 ? "fair" : "poor";
}

IsoRating iso_rating(const TimeCurve& reference, const TimeCurve& computed, std::size_t samples)
{
    const Span span = common_span(reference, computed);
    const TimeCurve wanted = resampled(reference, span.from, span.to, samples);
    const TimeCurve found = resampled(computed, span.from, span.to, samples);
    IsoRating rating;
    rating.corridor = corridor_score(wanted.value, found.value);
    const long steps = best_shift(wanted.value, found.value);
    rating.phase = linear_score(static_cast<double>(std::abs(steps)),
                                largest_shift * static_cast<double>(wanted.size()));
    const Shifted pair = shifted(wanted.value, found.value, steps);
    rating.magnitude = linear_score(warped_error(pair.reference, pair.computed), largest_magnitude_error);
    rating.slope = linear_score(slope_error(pair.reference, pair.computed), largest_slope_error);
    rating.overall = 0.4 * rating.corridor + 0.2 * (rating.phase + rating.magnitude + rating.slope);
    return rating;
}

} // namespace plash
