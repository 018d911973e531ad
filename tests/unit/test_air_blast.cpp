// Shocks of explosions in air against other fits of the same data and the jump conditions.

#include "conditions/air_blast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plash {

namespace {

/// ft / lb^(1/3) of one m / kg^(1/3), and kg^(1/3) in lb^(1/3).
const double mass_root = std::cbrt(1 / 0.45359237);
const double scaled_metre = 1 / 0.3048 / mass_root;
constexpr double kilopascals = 6.894757293168;

/// exp of a polynomial of the logarithm of the scaled distance [m / kg^(1/3)].
double swisdak(const std::vector<double>& coefficients, double distance)
{
    double sum = 0, power = 1;
    for (const double c : coefficients) {
        sum += c * power;
        power *= std::log(distance);
    }
    return std::exp(sum);
}

} // namespace

// Swisdak (1994, Simplified Kingery Airblast Calculations, tables for metric units) fitted the same curves
// anew; he gives 1 % for his fits.
TEST(AirBlast, SurfaceBurstsAreSwisdaks)
{
    for (const double z : {0.3, 0.7, 1.0, 1.45, 2.1, 5.0, 10.0, 20.0}) {
        const AirBlast blast = air_blast(Burst::surface, z * scaled_metre);
        const double incident = z < 2.9 ? swisdak({7.2106, -2.1069, -0.3229, 0.1117, 0.0685}, z)
                                        : swisdak({7.5938, -3.0523, 0.40977, 0.0261, -0.01267}, z);
        const double reflected =
            z < 2 ? swisdak({9.006, -2.6893, -0.6295, 0.1011, 0.29255, 0.13505, 0.019736}, z)
                  : swisdak({8.8396, -1.733, -2.64, 2.293, -0.8232, 0.14247, -0.0099}, z);
        const double arrival = z < 1.5 ? swisdak({-0.7604, 1.8058, 0.1257, -0.0437, -0.0310, -0.00669}, z)
                                       : swisdak({-0.7137, 1.5732, 0.5561, -0.4213, 0.1054, -0.00929}, z);
        const double impulse = swisdak({6.7853, -1.3466, 0.101, -0.01123}, z);
        EXPECT_NEAR(blast.incident_pressure * kilopascals / incident, 1, 0.01) << z;
        EXPECT_NEAR(blast.reflected_pressure * kilopascals / reflected, 1, 0.01) << z;
        EXPECT_NEAR(blast.arrival * mass_root / arrival, 1, 0.01) << z;
        EXPECT_NEAR(blast.reflected_impulse * kilopascals * mass_root / impulse, 1, 1e-3) << z;
    }
}

// A shock in air (gamma = 1.4) that hits a wall: 2 p (7 p0 + 4 p) / (7 p0 + p); weak shocks, where air is an
// ideal gas. And ground that reflected all would double the charge, real ground makes it 1.7 to 1.8 times.
TEST(AirBlast, PressuresReflectAsTheJumpConditionsSay)
{
    constexpr double ambient = 14.696;
    for (const Burst burst : {Burst::surface, Burst::air}) {
        for (const double z : {8.0, 15.0, 30.0, 60.0}) {
            const AirBlast blast = air_blast(burst, z);
            const double p = blast.incident_pressure;
            EXPECT_NEAR(blast.reflected_pressure / (2 * p * (7 * ambient + 4 * p) / (7 * ambient + p)), 1,
                        0.03)
                << z;
        }
    }
    for (const double z : {2.0, 5.0, 10.0, 30.0}) {
        const AirBlast ground = air_blast(Burst::surface, z),
                       air = air_blast(Burst::air, z / std::cbrt(1.75));
        EXPECT_NEAR(ground.incident_pressure / air.incident_pressure, 1, 0.1) << z;
        EXPECT_NEAR(ground.arrival / (air.arrival * std::cbrt(1.75)), 1, 0.1) << z;
    }
}

// The positive phase has the impulse of the data, whatever the angle's share of it.
TEST(AirBlast, PositivePhaseHasItsImpulse)
{
    for (const Burst burst : {Burst::surface, Burst::air}) {
        for (const double z : {0.3, 1.0, 3.0, 10.0, 50.0}) {
            const AirBlast blast = air_blast(burst, z);
            constexpr int parts = 20000;
            double facing = 0, averted = 0;
            for (int i = 0; i < parts; ++i) {
                const double t = (i + 0.5) / parts * blast.duration;
                facing += blast.pressure(t, 1) * blast.duration / parts;
                averted += blast.pressure(t, -0.3) * blast.duration / parts;
            }
            EXPECT_NEAR(facing, blast.reflected_impulse, 1e-5 * blast.reflected_impulse) << z;
            EXPECT_NEAR(averted, blast.incident_impulse, 1e-5 * blast.incident_impulse) << z;
        }
    }
    const AirBlast blast = air_blast(Burst::air, 10);
    EXPECT_EQ(blast.pressure(-1e-9, 1), 0);
    const double oblique = 0.6 * 0.6 * blast.reflected_pressure + 0.4 * 0.4 * blast.incident_pressure;
    EXPECT_NEAR(blast.pressure(0, 0.6), oblique, 1e-12 * oblique);
    EXPECT_LT(blast.pressure(1.5 * blast.duration, 1), 0);
    EXPECT_GE(blast.pressure(1.5 * blast.duration, 1), -14.696);
}

} // namespace plash
