#pragma once

#include "math/lanes.h"

#include <vector>

namespace plash {

/// A broken line through points as a sum over its kinks: short for few points, and without look-up. It goes
/// on with the slopes of its ends.
class BrokenLine {
public:
    BrokenLine() = default;
    /// Through points whose abscissas rise; one point gives a constant.
    BrokenLine(const std::vector<double>& x, const std::vector<double>& y)
        : start_(x.front()), value_(y.front())
    {
        for (std::size_t i = 0; i + 1 < x.size(); ++i) {
            const double slope = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
            if (i == 0) {
                first_slope_ = slope;
            } else {
                kinks_.push_back({x[i], slope - last_slope_});
            }
            last_slope_ = slope;
        }
    }

    template <class Lane>
    void evaluate(const Lane& x, Lane& y, Lane& slope) const
    {
        slope = broadcast<Lane>(first_slope_);
        y = value_ + first_slope_ * (x - start_);
        for (const Kink& kink : kinks_) {
            const Lane beyond = x - kink.place;
            y += kink.change * max(beyond, Lane{});
            slope += beyond > 0.0 ? broadcast<Lane>(kink.change) : Lane{};
        }
    }

    template <class Lane>
    Lane operator()(const Lane& x) const
    {
        Lane y, slope;
        evaluate(x, y, slope);
        return y;
    }

    /// Integral from the first point to x, which lies at or beyond it.
    template <class Lane>
    Lane integral(const Lane& x) const
    {
        const Lane way = x - start_;
        Lane sum = way * (value_ + (0.5 * first_slope_) * way);
        for (const Kink& kink : kinks_) {
            const Lane beyond = max(Lane{x - kink.place}, Lane{});
            sum += (0.5 * kink.change) * (beyond * beyond);
        }
        return sum;
    }

private:
    /// A change of slope.
    struct Kink {
        double place, change;
    };
    double start_ = 0, value_ = 0; ///< first point
    double first_slope_ = 0, last_slope_ = 0;
    std::vector<Kink> kinks_;
};

} // namespace plash
