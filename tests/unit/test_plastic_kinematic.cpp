#include "materials/plastic_kinematic.h"
#include "tests/support/law_driver.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <random>

namespace plash {

using testing::DrivenPoint;
using testing::record_of;

namespace {

constexpr double young = 200e3, nu = 0.3, yield = 250, tangent = 2000;
constexpr double shear = young / (2 * (1 + nu)), bulk = young / (3 * (1 - 2 * nu));
constexpr double hardening = young * tangent / (young - tangent);

template <bool back>
PlasticKinematic<back> metal(double beta, double etan = tangent)
{
    const Record record = record_of(
        "MAT_PLASTIC_KINEMATIC", 1,
        {{"RO", 7.85e-9}, {"E", young}, {"PR", nu}, {"SIGY", yield}, {"ETAN", etan}, {"BETA", beta}});
    return PlasticKinematic<back>::from_record(record, Model{});
}

} // namespace

TEST(PlasticKinematic, UniaxialStrainCycleFollowsTheClosedForm)
{
    // Along a straight strain path sigma_xx - sigma_yy =: s obeys s + 3 G ep = 2 G e with linear hardening,
    // so every branch is a straight line whatever the step.
    for (double beta : {0.0, 0.4, 1.0}) {
        const auto law = metal<true>(beta);
        DrivenPoint point(law);
        const double forward = 0.02, back = -0.03;
        point.strain({forward, 0, 0, 0, 0, 0}, 7);
        const double flow = (2 * shear * forward - yield) / (3 * shear + hardening);
        EXPECT_NEAR(point.stress.xx - point.stress.yy, yield + hardening * flow, 1e-9);
        EXPECT_NEAR(point.history[0], flow, 1e-14);
        point.strain({back, 0, 0, 0, 0, 0}, 11);
        const double s1 = yield + hardening * flow;
        const double y1 = yield + beta * hardening * flow; // radius of the surface
        // Elastic down to s1 - 2 y1, then plastic.
        const double reverse = (-2 * shear * back - 2 * y1) / (3 * shear + hardening);
        EXPECT_NEAR(point.stress.xx - point.stress.yy, s1 - 2 * y1 - hardening * reverse, 1e-9) << beta;
        EXPECT_NEAR(point.history[0], flow + reverse, 1e-14);
        EXPECT_NEAR(trace(point.stress), 3 * bulk * (forward + back), 1e-8);
    }
}

TEST(PlasticKinematic, ShearFlowsAtTheYieldStressOverRootThree)
{
    const auto law = metal<false>(0, 0);
    DrivenPoint point(law);
    point.strain({0, 0, 0, 0, 0.004, 0}, 3);
    EXPECT_NEAR(point.stress.yz, yield / std::sqrt(3.0), 1e-10);
    EXPECT_NEAR(point.history[0], (2 * 0.004 * shear - yield / std::sqrt(3.0)) * std::sqrt(3.0) / (3 * shear),
                1e-14);
}

TEST(PlasticKinematic, VolumetricCycleStaysElastic)
{
    const auto law = metal<true>(0.5);
    DrivenPoint point(law);
    point.strain({-0.1, -0.1, -0.1, 0, 0, 0}, 5);
    EXPECT_NEAR(point.stress.xx, -0.3 * bulk, 1e-9);
    EXPECT_EQ(point.history[0], 0);
    point.strain({0.1, 0.1, 0.1, 0, 0, 0}, 5);
    EXPECT_NEAR(point.stress.xx, 0, 1e-9);
}

TEST(PlasticKinematic, CowperSymondsScalesTheYieldStress)
{
    auto law = metal<false>(1);
    law.rate.constant = 40;
    law.rate.exponent = 5;
    DrivenPoint point(law);
    const double strain = 0.01, duration = 1e-4;
    point.strain({0, 0, 0, strain, 0, 0}, 50, duration);
    // VP = 0: the norm of the strain rate tensor, here sqrt(2) times the shear rate.
    const double factor = 1 + std::pow(std::sqrt(2.0) * strain / duration / 40, 0.2);
    const double flow =
        (2 * std::sqrt(3.0) * shear * strain - factor * yield) / (3 * shear + factor * hardening);
    EXPECT_NEAR(std::sqrt(3.0) * point.stress.xy, factor * (yield + hardening * flow), 1e-9 * yield);
}

TEST(PlasticKinematic, ViscoplasticFlowSettlesAtItsOwnRate)
{
    auto law = metal<false>(1, 0);
    law.rate.constant = 40;
    law.rate.exponent = 5;
    law.viscoplastic = true;
    DrivenPoint point(law);
    const double rate = 100;
    point.strain({0, 0, 0, 0.1, 0, 0}, 1000, 0.1 / rate);
    // Perfectly plastic and steady: all strain is plastic, the effective rate is 2 / sqrt(3) of the shear
    // rate.
    const double factor = 1 + std::pow(2 / std::sqrt(3.0) * rate / 40, 0.2);
    EXPECT_NEAR(std::sqrt(3.0) * point.stress.xy, factor * yield, 1e-6 * yield);
}

TEST(PlasticKinematic, PlaneStressEqualsTheSolidLawWithoutThicknessStress)
{
    const auto check = [](const auto& law, double duration) {
        std::mt19937 random(3);
        const auto draw = [&] { return 1e-3 * (random() / 2147483648.0 - 1.0); };
        DrivenPoint solid(law), shell(law);
        for (int step = 0; step < 60; ++step) {
            SymmetricTensor<double> increment{2 * draw(), draw(), 0, draw(), draw(), draw()};
            // The thickness strain by bisection: sigma_zz rises with it.
            double low = -0.02, high = 0.02;
            DrivenPoint trial = solid;
            for (int i = 0; i < 60; ++i) {
                trial.stress = solid.stress;
                trial.history = solid.history;
                increment.zz = 0.5 * (low + high);
                trial.strain(increment, 1, duration);
                (trial.stress.zz > 0 ? high : low) = increment.zz;
            }
            solid.stress = trial.stress;
            solid.history = trial.history;
            SymmetricTensor<double> planar = increment;
            // With VP = 0 the rate depends on the thickness strain, so both see the same here.
            law.update_plane_stress(shell.stress, planar, HistoryView<double>{shell.history.data()},
                                    duration);
            ASSERT_NEAR(shell.stress.xx, solid.stress.xx, 1e-7) << step;
            ASSERT_NEAR(shell.stress.yy, solid.stress.yy, 1e-7);
            ASSERT_NEAR(shell.stress.xy, solid.stress.xy, 1e-7);
            ASSERT_NEAR(shell.stress.zx, solid.stress.zx, 1e-7);
            ASSERT_EQ(shell.stress.zz, 0);
            ASSERT_NEAR(planar.zz, increment.zz, 1e-12);
            ASSERT_NEAR(shell.history[0], solid.history[0], 1e-12);
        }
        EXPECT_GT(solid.history[0], 0.01); // the path was plastic
    };
    check(metal<false>(1), 1);
    check(metal<true>(0.3), 1);
    auto viscous = metal<true>(0.3);
    viscous.rate.constant = 40;
    viscous.rate.exponent = 5;
    viscous.viscoplastic = true;
    check(viscous, 1e-5);
}

TEST(PlasticKinematic, LanesEqualTheScalarReference)
{
    const auto law = metal<true>(0.3);
    std::mt19937 random(5);
    SymmetricTensor<Lanes> stress{}, plane{}, increment{};
    Lanes history[7]{}, plane_history[7]{};
    for (int step = 0; step < 20; ++step) {
        for (Lanes* part :
             {&increment.xx, &increment.yy, &increment.zz, &increment.xy, &increment.yz, &increment.zx}) {
            for (int lane = 0; lane < lane_count; ++lane)
                (*part)[lane] = 2e-3 * (random() / 2147483648.0 - 1.0);
        }
        SymmetricTensor<double> one[lane_count], one_plane[lane_count];
        double one_history[lane_count][7], one_plane_history[lane_count][7];
        for (int lane = 0; lane < lane_count; ++lane) {
            const auto pick = [lane](const SymmetricTensor<Lanes>& t) {
                return SymmetricTensor<double>{t.xx[lane], t.yy[lane], t.zz[lane],
                                               t.xy[lane], t.yz[lane], t.zx[lane]};
            };
            one[lane] = pick(stress);
            one_plane[lane] = pick(plane);
            for (int i = 0; i < 7; ++i) {
                one_history[lane][i] = history[i][lane];
                one_plane_history[lane][i] = plane_history[i][lane];
            }
            SymmetricTensor<double> one_increment = pick(increment);
            law.update(one[lane], one_increment, HistoryView<double>{one_history[lane]}, 1e-3);
            law.update_plane_stress(one_plane[lane], one_increment,
                                    HistoryView<double>{one_plane_history[lane]}, 1e-3);
        }
        law.update(stress, increment, HistoryView<Lanes>{history}, 1e-3);
        law.update_plane_stress(plane, increment, HistoryView<Lanes>{plane_history}, 1e-3);
        for (int lane = 0; lane < lane_count; ++lane) {
            // Round-off of stresses up to 1e3; the iteration of the plane return stops at 1e-13.
            ASSERT_NEAR(stress.xx[lane], one[lane].xx, 1e-9);
            ASSERT_NEAR(stress.yz[lane], one[lane].yz, 1e-9);
            ASSERT_NEAR(history[0][lane], one_history[lane][0], 1e-13);
            ASSERT_NEAR(plane.yy[lane], one_plane[lane].yy, 1e-9);
            ASSERT_NEAR(plane.zx[lane], one_plane[lane].zx, 1e-9);
            ASSERT_NEAR(plane_history[3][lane], one_plane_history[lane][3], 1e-9);
        }
    }
    EXPECT_GT(history[0][0], 0);
}

/// An element that no wave has reached yet stands beside one that yields.
TEST(PlasticKinematic, LanesWithoutStressStaySoBesideOthersThatYield)
{
    const auto law = metal<true>(0.3);
    SymmetricTensor<Lanes> stress{}, increment{};
    Lanes history[7]{};
    increment.xx[3] = 0.05;
    law.update_plane_stress(stress, increment, HistoryView<Lanes>{history}, 1e-3);
    EXPECT_GT(history[0][3], 0.01);
    for (int lane = 0; lane < lane_count; ++lane) {
        if (lane == 3) continue;
        EXPECT_EQ(stress.xx[lane], 0);
        EXPECT_EQ(history[0][lane], 0);
    }
}

} // namespace plash
