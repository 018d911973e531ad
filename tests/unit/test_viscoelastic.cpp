#include "materials/viscoelastic.h"
#include "tests/support/law_driver.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

constexpr double visco_bulk = 2, short_shear = 0.3, long_shear = 0.1, beta = 4;

Viscoelastic jelly()
{
    return Viscoelastic::from_record(
        make_record(
            "MAT_VISCOELASTIC",
            {{"RO", 1}, {"BULK", visco_bulk}, {"G0", short_shear}, {"GI", long_shear}, {"BETA", beta}}),
        Model{});
}

/// Shear stress of a shear strain that grows from 0 to `strain` in `time` and then rests for `rest`: the
/// integral of 2 G(t - s) de/ds.
double ramp_and_rest(double strain, double time, double rest)
{
    const double rate = strain / time;
    const double fading =
        (short_shear - long_shear) * rate / beta * (1 - std::exp(-beta * time)) * std::exp(-beta * rest);
    return 2 * (long_shear * strain + fading);
}

} // namespace

TEST(Viscoelastic, ShearedAndHeldRelaxesAsTheIntegralSays)
{
    const Viscoelastic law = jelly();
    for (const int steps : {1, 7, 100}) { // exact for any number of steps, up to round-off
        testing::DrivenPoint point(law);
        point.strain({0, 0, 0, 0.01, 0, 0}, steps, 0.2);
        EXPECT_NEAR(point.stress.xy, ramp_and_rest(0.01, 0.2, 0), 1e-15);
        point.strain({}, steps, 0.5);
        EXPECT_NEAR(point.stress.xy, ramp_and_rest(0.01, 0.2, 0.5), 1e-15);
        point.strain({}, steps, 50);
        EXPECT_NEAR(point.stress.xy, 2 * long_shear * 0.01, 1e-15);
    }
}

TEST(Viscoelastic, VolumeIsElasticAndPullingStartsWithTheShortTimeModulus)
{
    const Viscoelastic law = jelly();
    testing::DrivenPoint point(law);
    point.strain({0.001, 0.002, 0.003, 0, 0, 0}, 10, 100);
    EXPECT_NEAR(trace(point.stress) / 3, visco_bulk * 0.006, 1e-15);
    point.strain({-0.001, -0.002, -0.003, 0, 0, 0}, 10, 100);
    EXPECT_NEAR(trace(point.stress), 0, 1e-15);
    testing::DrivenPoint quick(law);
    quick.strain({0.001, 0, 0, 0, 0, 0}, 1, 1e-9);
    EXPECT_NEAR(quick.stress.xx, 0.001 * (visco_bulk + 4.0 / 3 * short_shear), 1e-10);
    EXPECT_NEAR(law.young_modulus, 9 * visco_bulk * short_shear / (3 * visco_bulk + short_shear), 1e-12);
}

TEST(Viscoelastic, TurnsWithTheMaterial)
{
    const Viscoelastic law = jelly();
    testing::DrivenPoint point(law);
    point.strain({0.01, -0.01, 0, 0, 0, 0}, 1, 0.01);
    const Tensor3<double> quarter{0, -1, 0, 1, 0, 0, 0, 0, 1};
    point.stress = rotated(point.stress, quarter);
    law.rotate_history(HistoryView<double>{point.history.data()}, quarter);
    point.strain({}, 1, 1000);
    EXPECT_NEAR(point.stress.xx, -2 * long_shear * 0.01, 1e-15);
    EXPECT_NEAR(point.stress.yy, 2 * long_shear * 0.01, 1e-15);
}

TEST(Viscoelastic, KelvinMaxwellCardIsTheSameLaw)
{
    const auto law = Viscoelastic::from_record(
        make_record("MAT_KELVIN-MAXWELL_VISCOELASTIC",
                    {{"RO", 1}, {"BULK", visco_bulk}, {"G0", short_shear}, {"GI", long_shear}, {"DC", beta}}),
        Model{});
    testing::DrivenPoint point(law);
    point.strain({0, 0, 0, 0.01, 0, 0}, 10, 0.2);
    EXPECT_NEAR(point.stress.xy, ramp_and_rest(0.01, 0.2, 0), 1e-15);
    EXPECT_THROW(
        Viscoelastic::from_record(make_record("MAT_KELVIN-MAXWELL_VISCOELASTIC", {{"RO", 1},
                                                                                  {"BULK", visco_bulk},
                                                                                  {"G0", short_shear},
                                                                                  {"GI", long_shear},
                                                                                  {"DC", beta},
                                                                                  {"FO", 1}}),
                                  Model{}),
        DeckError);
}

} // namespace plash
