#include "math/curve.h"

#include <algorithm>

namespace plash {

double Curve::operator()(double x) const
{
    if (abscissa.empty()) return 0;
    if (x <= abscissa.front()) return ordinate.front();
    if (x >= abscissa.back()) return ordinate.back();
    const auto right = std::upper_bound(abscissa.begin(), abscissa.end(), x) - abscissa.begin();
    const auto left = right - 1;
    const double share = (x - abscissa[left]) / (abscissa[right] - abscissa[left]);
    return ordinate[left] + share * (ordinate[right] - ordinate[left]);
}

double Curve::slope(double x) const
{
    if (abscissa.size() < 2 || x < abscissa.front() || x >= abscissa.back()) return 0;
    const auto right = std::upper_bound(abscissa.begin(), abscissa.end(), x) - abscissa.begin();
    return (ordinate[right] - ordinate[right - 1]) / (abscissa[right] - abscissa[right - 1]);
}

Curve odd_curve(const Curve& given)
{
    if (given.abscissa.empty() || given.abscissa.front() < 0) return given;
    Curve result;
    for (std::size_t i = given.abscissa.size(); i-- > 0;) {
        if (given.abscissa[i] == 0) continue;
        result.abscissa.push_back(-given.abscissa[i]);
        result.ordinate.push_back(-given.ordinate[i]);
    }
    result.abscissa.insert(result.abscissa.end(), given.abscissa.begin(), given.abscissa.end());
    result.ordinate.insert(result.ordinate.end(), given.ordinate.begin(), given.ordinate.end());
    return result;
}

double steepest_slope(const Curve& curve)
{
    double slope = 0;
    for (std::size_t i = 0; i + 1 < curve.abscissa.size(); ++i) {
        slope = std::max(slope, (curve.ordinate[i + 1] - curve.ordinate[i]) /
                                    (curve.abscissa[i + 1] - curve.abscissa[i]));
    }
    return slope;
}

} // namespace plash
