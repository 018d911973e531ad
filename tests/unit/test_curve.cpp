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

} // namespace plash
