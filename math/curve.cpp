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

} // namespace plash
