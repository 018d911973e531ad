#include "math/curve.h"

#include <gtest/gtest.h>

namespace plash {

TEST(Curve, InterpolatesLinearlyAndHoldsBeyondItsEnds)
{
    const Curve curve{{0, 1, 3}, {0, 2, 6}};
    EXPECT_DOUBLE_EQ(curve(0.5), 1);
    EXPECT_DOUBLE_EQ(curve(2), 4);
    EXPECT_DOUBLE_EQ(curve(-1), 0);
    EXPECT_DOUBLE_EQ(curve(9), 6);
    EXPECT_DOUBLE_EQ(curve.slope(2), 2);
    EXPECT_DOUBLE_EQ(curve.slope(9), 0);
}

TEST(Curve, IsZeroWithoutPoints)
{
    EXPECT_EQ(Curve{}(1.0), 0);
}

TEST(Curve, BecomesOddWhereItBeginsAtZeroOrAbove)
{
    const Curve odd = odd_curve({{0, 1, 3}, {0, 2, 3}});
    EXPECT_EQ(odd.abscissa, (std::vector<double>{-3, -1, 0, 1, 3}));
    EXPECT_EQ(odd.ordinate, (std::vector<double>{-3, -2, 0, 2, 3}));
    const Curve both{{-1, 1}, {-1, 5}};
    EXPECT_EQ(odd_curve(both).ordinate, both.ordinate);
    EXPECT_TRUE(odd_curve({}).abscissa.empty());
    EXPECT_DOUBLE_EQ(steepest_slope(odd), 2);
    EXPECT_EQ(steepest_slope({}), 0);
}

} // namespace plash
