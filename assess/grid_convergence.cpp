#include "assess/grid_convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plash {

GridConvergence grid_convergence(const double (&size)[3], const double (&value)[3])
{
    const double r21 = size[1] / size[0], r32 = size[2] / size[1];
    const double e21 = value[1] - value[0], e32 = value[2] - value[1];
    GridConvergence result;
    result.error_fine = std::abs(e21 / value[0]);
    result.error_coarse = std::abs(e32 / value[1]);
    result.oscillating = e32 / e21 < 0;
    if (e21 == 0 || e32 == 0) {
        result.order = std::numeric_limits<double>::infinity();
        result.extrapolated = value[0];
        return result;
    }
    // Fixed-point iteration from q = 0, as the paper recommends; for one constant ratio q stays 0.
    const double sign = result.oscillating ? -1 : 1, ratio = std::log(std::abs(e32 / e21));
    double order = std::abs(ratio) / std::log(r21);
    for (int i = 0; i < 200; ++i) {
        const double q = std::log((std::pow(r21, order) - sign) / (std::pow(r32, order) - sign));
        const double next = std::abs(ratio + q) / std::log(r21);
        if (!std::isfinite(next)) break;
        const double change = std::abs(next - order);
        order = next;
        if (change < 1e-12 * order) break;
    }
    result.order = order;
    const double gain21 = std::pow(r21, order) - 1, gain32 = std::pow(r32, order) - 1;
    result.extrapolated = value[0] - e21 / gain21;
    result.index_fine = 1.25 * result.error_fine / gain21;
    result.index_coarse = 1.25 * result.error_coarse / gain32;
    return result;
}

AveragedConvergence averaged_convergence(const double (&size)[3], const TimeCurve* const (&curves)[3],
                                         std::size_t samples)
{
    const Span first = common_span(*curves[0], *curves[1]), second = common_span(*curves[1], *curves[2]);
    const double from = std::max(first.from, second.from), to = std::min(first.to, second.to);
    TimeCurve sampled[3];
    for (int i = 0; i < 3; ++i) sampled[i] = resampled(*curves[i], from, to, samples);
    const double largest = std::abs(peak(sampled[0]).value);
    AveragedConvergence result;
    double orders = 0, fine = 0, coarse = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const double value[3] = {sampled[0].value[i], sampled[1].value[i], sampled[2].value[i]};
        const double e21 = std::abs(value[1] - value[0]), e32 = std::abs(value[2] - value[1]);
        fine += e21 / largest;
        coarse += e32 / largest;
        if (std::min(e21, e32) < 1e-9 * largest) continue;
        orders += grid_convergence(size, value).order;
        ++result.points;
    }
    if (result.points == 0) return result;
    result.order = orders / static_cast<double>(result.points);
    const double count = static_cast<double>(samples);
    result.index_fine = 1.25 * fine / count / (std::pow(size[1] / size[0], result.order) - 1);
    result.index_coarse = 1.25 * coarse / count / (std::pow(size[2] / size[1], result.order) - 1);
    return result;
}

} // namespace plash
