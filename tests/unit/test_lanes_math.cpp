#include "math/lanes_math.h"

#include <gtest/gtest.h>

namespace plash {

TEST(LanesMath, LogarithmExponentialAndPowerAreAccurate)
{
    constexpr double few_units = 1e-15;
    for (double x = 1e-12; x < 1e12; x *= 1.37) {
        EXPECT_NEAR(log<double>(x), std::log(x), few_units * std::max(1.0, std::abs(std::log(x)))) << x;
        const double a = std::log(x) * 5;
        EXPECT_NEAR(exp<double>(a) / std::exp(a), 1, 4e-16 * std::max(2.0, std::abs(a) / 8)) << a;
        EXPECT_NEAR(power<double>(x, 0.2) / std::pow(x, 0.2), 1, 4 * few_units) << x;
        const Lanes lanes = log<Lanes>(broadcast<Lanes>(x));
        EXPECT_NEAR(lanes[3], log<double>(x), few_units * std::max(1.0, std::abs(std::log(x))));
    }
    EXPECT_EQ(power<double>(0.0, 0.2), 0);
    EXPECT_NEAR(log<double>(1.0), 0, 1e-300);
    EXPECT_EQ(exp<double>(0.0), 1);
    // Beyond the normal numbers it stays at the last ones.
    EXPECT_LT(exp<double>(-6400.0), 1e-300);
    EXPECT_GT(exp<double>(-6400.0), 0);
    EXPECT_GT(exp<Lanes>(broadcast<Lanes>(1e5))[2], 1e307);
}

TEST(LanesMath, NearestIntegersGoThereAndBack)
{
    for (const double x : {-3.0, -0.6, 0.0, 0.4, 0.6, 1e6}) {
        EXPECT_EQ(nearest_integer<double>(x), std::llround(x));
        EXPECT_EQ(lanes_of_integer<double>(std::llround(x)), std::round(x));
    }
}

} // namespace plash
