#include "materials/cowper_symonds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plash {

namespace {

constexpr double yield = 0.3, young = 210, poisson = 0.3;

/// Flow stress less equivalent stress at a multiplier, written as the law says it.
double miss(const CowperSymonds& rate, const PlaneStressPath<double>& path, double m, double hardening,
            double time_step)
{
    const double u = 1 / (1 + path.slow * m), w = 1 / (1 + path.fast * m);
    const double q = std::sqrt(path.slow_square * u * u + path.fast_square * w * w);
    const double strain = 2.0 / 3 * m * q;
    const double factor = 1 + std::pow(strain / (rate.constant * time_step), 1 / rate.exponent);
    return factor * (yield + hardening * strain) - q;
}

/// A trial stress of a size over the yield stress and a share of the slow mode (sum of normal stresses).
PlaneStressPath<double> path_of(double size, double share, double kinematic)
{
    const double square = size * size * yield * yield;
    PlaneStressPath<double> path(SymmetricTensor<double>{}, kinematic, young, poisson);
    path.slow_square = share * square;
    path.fast_square = (1 - share) * square;
    return path;
}

struct Case {
    CowperSymonds rate;
    PlaneStressPath<double> path;
    double hardening, time_step;
};

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (double exponent : {0.5, 1.0, 2.5, 5.0, 8.0, 12.0})
        for (double unit : {1e-9, 1e-6, 1e-4, 1e-2, 10.0})
            for (double size : {1 + 1e-9, 1.001, 1.3, 5.0, 100.0})
                for (double share : {0.0, 0.4, 1.0})
                    for (double hardening : {0.0, 1.0, 50.0})
                        all.push_back({{40, exponent}, path_of(size, share, 0.7), hardening, unit / 40});
    return all;
}

} // namespace

/// The multiplier satisfies its equation to round-off, from almost no flow to a hundred times the yield
/// stress in one step, for rates that matter not at all and for rates that take up everything.
TEST(CowperSymonds, MultiplierSatisfiesItsEquation)
{
    for (const Case& c : cases()) {
        const double m = c.rate.multiplier(c.path, yield, c.hardening, c.time_step);
        ASSERT_GT(m, 0) << c.rate.exponent;
        const double size = std::sqrt(c.path.slow_square + c.path.fast_square);
        ASSERT_NEAR(miss(c.rate, c.path, m, c.hardening, c.time_step), 0, 1e-12 * size)
            << c.rate.exponent << ' ' << c.time_step << ' ' << size / yield << ' ' << c.hardening;
    }
    CowperSymonds rate{40, 5};
    EXPECT_EQ(rate.multiplier(path_of(1, 0.5, 0), yield, 1.0, 1e-6), 0);
    EXPECT_EQ(rate.multiplier(path_of(0, 0.5, 0), yield, 1.0, 1e-6), 0);
}

/// Eight paths at once, one of them inside the yield surface.
TEST(CowperSymonds, LanesEqualTheScalarReference)
{
    const CowperSymonds rate{40, 5};
    const double sizes[lane_count] = {1 + 1e-9, 1.0005, 1.01, 1.2, 2, 7, 0.9, 40};
    PlaneStressPath<Lanes> path(SymmetricTensor<Lanes>{}, 0.7, young, poisson);
    for (int lane = 0; lane < lane_count; ++lane) {
        const PlaneStressPath<double> one = path_of(sizes[lane], 0.1 * lane, 0.7);
        path.slow_square[lane] = one.slow_square;
        path.fast_square[lane] = one.fast_square;
    }
    const Lanes m = rate.multiplier(path, broadcast<Lanes>(yield), 2.0, 1e-6);
    for (int lane = 0; lane < lane_count; ++lane) {
        const double one = rate.multiplier(path_of(sizes[lane], 0.1 * lane, 0.7), yield, 2.0, 1e-6);
        EXPECT_NEAR(m[lane], one, 1e-12 * one) << lane;
    }
}

TEST(CowperSymonds, FactorScalesWithTheRoot)
{
    const CowperSymonds rate{40, 5};
    EXPECT_NEAR(rate.factor(40.0 * 40.0), 2, 1e-14);
    EXPECT_NEAR(rate.factor(32.0 * 40 * 32 * 40), 3, 1e-14);
    EXPECT_EQ(rate.factor(0.0), 1);
}

} // namespace plash
