#pragma once

#include <vector>

namespace plash {

/// Mean period of a history from its rising zero crossings (linear between samples); zero when there are not
/// two.
inline double period_of(const std::vector<double>& time, const std::vector<double>& value)
{
    std::vector<double> crossings;
    for (std::size_t i = 1; i < value.size(); ++i) {
        if (value[i - 1] < 0 && value[i] >= 0) {
            const double share = value[i - 1] / (value[i - 1] - value[i]);
            crossings.push_back(time[i - 1] + share * (time[i] - time[i - 1]));
        }
    }
    if (crossings.size() < 2) return 0;
    return (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
}

} // namespace plash
