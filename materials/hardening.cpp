#include "materials/hardening.h"

#include <algorithm>

namespace plash {

namespace {

constexpr std::size_t most_kinks = 12;
constexpr std::int64_t fewest_bins = 16;
constexpr std::int64_t most_bins = 4096;      // of one curve
constexpr std::int64_t most_in_all = 1 << 16; // of all curves: 2 MiB

/// The curve as points from x = 0 on: constant before its first point, then as given.
Curve from_zero(const Curve& curve)
{
    Curve result;
    result.abscissa.push_back(0);
    result.ordinate.push_back(curve(0));
    for (std::size_t i = 0; i < curve.abscissa.size(); ++i) {
        if (curve.abscissa[i] <= 0) continue;
        result.abscissa.push_back(curve.abscissa[i]);
        result.ordinate.push_back(curve.ordinate[i]);
    }
    return result;
}

/// Slope of the segment that begins at or before x; the last one goes on for ever.
double slope_at(const Curve& curve, double x)
{
    const std::size_t points = curve.abscissa.size();
    if (points < 2) return 0;
    std::size_t right =
        std::upper_bound(curve.abscissa.begin(), curve.abscissa.end(), x) - curve.abscissa.begin();
    right = std::clamp<std::size_t>(right, 1, points - 1);
    return (curve.ordinate[right] - curve.ordinate[right - 1]) /
           (curve.abscissa[right] - curve.abscissa[right - 1]);
}

double value_at(const Curve& curve, double x)
{
    const double last = curve.abscissa.back();
    return x <= last ? curve(x) : curve.ordinate.back() + slope_at(curve, last) * (x - last);
}

/// Whether no bin of this length holds two points of the curve inside.
bool one_kink_a_bin(const Curve& curve, double length)
{
    // The last point is no kink: its segment goes on.
    for (std::size_t i = 1; i + 2 < curve.abscissa.size(); ++i) {
        const auto bin = static_cast<std::int64_t>(curve.abscissa[i] / length);
        if (curve.abscissa[i + 1] < (bin + 1) * length) return false;
    }
    return true;
}

} // namespace

Hardening Hardening::linear(double yield_stress, double modulus)
{
    Hardening result;
    result.initial_ = yield_stress;
    result.modulus_ = modulus;
    return result;
}

Hardening Hardening::curve(const Curve& stress_of_strain)
{
    const Curve points = from_zero(stress_of_strain);
    Hardening result;
    if (points.abscissa.size() > most_kinks + 2) {
        result.cut({&stress_of_strain});
        return result;
    }
    result.initial_ = points.ordinate.front();
    result.modulus_ = slope_at(points, 0);
    for (std::size_t i = 1; i + 1 < points.abscissa.size(); ++i) {
        const double x = points.abscissa[i];
        result.kinks_.push_back({x, slope_at(points, x) - slope_at(points, points.abscissa[i - 1])});
    }
    return result;
}

Hardening Hardening::table(const std::vector<double>& rates, const std::vector<const Curve*>& curves,
                           bool logarithmic)
{
    Hardening result;
    result.rates_ = rates;
    result.logarithmic_ = logarithmic;
    result.cut(curves);
    return result;
}

void Hardening::cut(const std::vector<const Curve*>& given)
{
    std::vector<Curve> curves;
    double range = 0;
    for (const Curve* curve : given) {
        curves.push_back(from_zero(*curve));
        range = std::max(range, curves.back().abscissa.back());
    }
    if (range == 0) range = 1; // single points: constant
    const std::int64_t limit =
        std::min<std::int64_t>(most_bins, most_in_all / static_cast<std::int64_t>(curves.size()));
    bin_count_ = fewest_bins;
    const auto fits = [&](const Curve& curve) { return one_kink_a_bin(curve, range / bin_count_); };
    while (2 * bin_count_ <= limit && !std::all_of(curves.begin(), curves.end(), fits)) bin_count_ *= 2;
    bins_per_strain_ = bin_count_ / range;

    const double length = range / bin_count_;
    for (const Curve& curve : curves) {
        std::size_t next = 1; // first point not yet passed
        for (std::int64_t i = 0; i < bin_count_; ++i) {
            const double start = i * length, end = start + length;
            while (next + 1 < curve.abscissa.size() && curve.abscissa[next] <= start) ++next;
            const double slope = slope_at(curve, start), value = value_at(curve, start);
            Bin bin{value - slope * start, slope, end, 0};
            if (next + 1 < curve.abscissa.size() && curve.abscissa[next] < end) {
                bin.kink = curve.abscissa[next];
                bin.change = (value_at(curve, end) - value - slope * length) / (end - bin.kink);
            }
            bins_.push_back(bin);
        }
        // Beyond the last bin the last segment goes on, so its line must be the final one.
        Bin& last = bins_.back();
        const double slope = slope_at(curve, range);
        if (last.change == 0) last.slope = slope;
        if (last.change != 0) last.change = slope - last.slope;
    }
}

} // namespace plash
