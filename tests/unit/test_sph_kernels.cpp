#include "sph/kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace plash {

namespace {

template <class K>
class SphKernel : public ::testing::Test {};

using AllKernels =
    ::testing::Types<CubicSpline, QuarticSpline, QuinticSpline, QuadraticKernel, WendlandC2, WendlandC4>;
struct KernelName {
    template <class K>
    static std::string GetName(int)
    {
        std::string name(K::name);
        for (char& c : name)
            if (c == ' ') c = '_';
        return name;
    }
};
TYPED_TEST_SUITE(SphKernel, AllKernels, KernelName);

/// Integral of value(q) over the plane or over space, Simpson's rule.
template <class K>
double integral(int dimension)
{
    const int steps = 6000; // knots at quarters fall on grid points
    const double width = K::support / steps;
    double sum = 0;
    for (int i = 0; i <= steps; ++i) {
        const double q = i * width;
        const double shell = dimension == 2 ? 2 * M_PI * q : 4 * M_PI * q * q;
        sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * K::value(q) * shell;
    }
    return sum * width / 3;
}

} // namespace

TYPED_TEST(SphKernel, IntegratesToOneInPlaneAndSpace)
{
    // Simpson's error on polynomials of degree up to 10 with 6000 intervals is round-off.
    EXPECT_NEAR(TypeParam::norm(2) * integral<TypeParam>(2), 1, 1e-12);
    EXPECT_NEAR(TypeParam::norm(3) * integral<TypeParam>(3), 1, 1e-12);
}

TYPED_TEST(SphKernel, SlopeIsTheDerivativeOfValue)
{
    const double step = 1e-5;
    for (double q = 0.013; q < TypeParam::support + 0.3; q += 0.031) {
        const double numeric = (TypeParam::value(q + step) - TypeParam::value(q - step)) / (2 * step);
        // Central differences: error of the second order in the step, times the third derivative (< 1e3).
        EXPECT_NEAR(TypeParam::slope(q), numeric, 1e-7 * std::max(1.0, TypeParam::value(0.0)))
            << "at q = " << q;
    }
}

TYPED_TEST(SphKernel, VanishesBeyondItsSupport)
{
    EXPECT_EQ(TypeParam::value(TypeParam::support), 0);
    EXPECT_EQ(TypeParam::value(TypeParam::support + 1), 0);
    EXPECT_EQ(TypeParam::slope(TypeParam::support + 0.01), 0);
    EXPECT_GT(TypeParam::value(TypeParam::support - 0.1), 0);
}

TYPED_TEST(SphKernel, LanesEqualTheScalarReference)
{
    const Lanes q{0, 0.2, 0.7, 1, 1.4, 1.9, 2.3, 3.1};
    for (int l = 0; l < lane_count; ++l) {
        EXPECT_DOUBLE_EQ(TypeParam::value(q)[l], TypeParam::value(double(q[l])));
        EXPECT_DOUBLE_EQ(TypeParam::slope(q)[l], TypeParam::slope(double(q[l])));
    }
}

} // namespace plash
