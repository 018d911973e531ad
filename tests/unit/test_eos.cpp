#include "eos/gruneisen.h"
#include "eos/ideal_gas.h"
#include "eos/jwl.h"
#include "eos/linear_polynomial.h"
#include "eos/murnaghan.h"
#include "tests/paths.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace plash {

using testing::record_of;

namespace {

nlohmann::json reference()
{
    return nlohmann::json::parse(std::ifstream(PLASH_SOURCE_DIR "/tests/reference/analytic.json"));
}

Gruneisen gruneisen_of(const nlohmann::json& water)
{
    return Gruneisen::from_record(record_of("EOS_GRUNEISEN", 1,
                                            {{"C", water["C"]},
                                             {"S1", water["S1"]},
                                             {"S2", water["S2"]},
                                             {"S3", water["S3"]},
                                             {"GAMMA0", water["gamma0"]},
                                             {"A", water["a"]},
                                             {"E0", 0},
                                             {"V0", 1}}),
                                  water["rho0"]);
}

LinearPolynomial ideal_gas(double gamma, double energy)
{
    return LinearPolynomial::from_record(
        record_of("EOS_LINEAR_POLYNOMIAL", 1, {{"C4", gamma - 1}, {"C5", gamma - 1}, {"E0", energy}}), 1);
}

/// Slopes against central differences.
template <class Eos>
void check_slopes(const Eos& eos)
{
    for (double compression : {0.8, 0.95, 1.02, 1.1, 1.25}) {
        const double h = 1e-6;
        const auto here = eos.evaluate(compression);
        const auto ahead = eos.evaluate(compression + h), behind = eos.evaluate(compression - h);
        // Truncation h^2 and cancellation 1e-16 / h, both by the size of the values.
        const double scale = std::abs(here.cold_slope) + 1;
        EXPECT_NEAR(here.cold_slope, (ahead.cold - behind.cold) / (2 * h), 1e-7 * scale) << compression;
        EXPECT_NEAR(here.warm_slope, (ahead.warm - behind.warm) / (2 * h), 1e-8) << compression;
    }
}

} // namespace

TEST(Gruneisen, PassesThroughTheHugoniotOfItsShockVelocity)
{
    for (const char* name : {"shah2015_seed002", "song_seed001"}) {
        const auto water = reference()["water_eos"][name];
        const Gruneisen eos = gruneisen_of(water);
        for (const auto& [text, state] : water["hugoniot"].items()) {
            const double up = std::stod(text), us = state["Us"], pressure = 1e6 * double(state["p_MPa"]);
            const double volume = 1 - up / us;                   // mass
            const double energy = 0.5 * pressure * (1 - volume); // Rankine-Hugoniot from zero pressure
            const auto response = eos.evaluate(1 / volume);
            EXPECT_NEAR(response.pressure(energy), pressure, 1e-9 * pressure) << name << " up " << up;
        }
    }
}

TEST(Gruneisen, HasTheSlopesOfItsPressure)
{
    check_slopes(gruneisen_of(reference()["water_eos"]["song_seed001"]));
}

TEST(Gruneisen, IsLinearInExpansion)
{
    const auto water = reference()["water_eos"]["shah2015_seed002"];
    const Gruneisen eos = gruneisen_of(water);
    EXPECT_NEAR(eos.evaluate(0.97).cold, -0.03 * 998 * 1484.0 * 1484.0, 1e-3);
}

TEST(LinearPolynomial, HasTheSlopesOfItsPressure)
{
    LinearPolynomial eos;
    eos.c0 = 1;
    eos.c1 = 2200;
    eos.c2 = 9500;
    eos.c3 = 14600;
    eos.c4 = 0.28;
    eos.c5 = 0.3;
    eos.c6 = 0.1;
    check_slopes(eos);
    // C2 and C6 are for compression alone.
    EXPECT_DOUBLE_EQ(eos.evaluate(0.9).cold, 1 - 220 - 14.6);
    EXPECT_DOUBLE_EQ(eos.evaluate(0.9).warm, 0.28 - 0.03);
}

TEST(Murnaghan, IsTaitsWaterAndHasItsSlopes)
{
    const auto eos_of = [](double gamma) {
        return Murnaghan::from_record(
            record_of("EOS_MURNAGHAN", 1, {{"GAMMA", gamma}, {"K0", 2200}, {"V0", 0}}), 1);
    };
    for (double gamma : {7.0, 6.5}) {
        check_slopes(eos_of(gamma));
        EXPECT_NEAR(eos_of(gamma).evaluate(1.05).cold, 2200 * (std::pow(1.05, gamma) - 1), 1e-9);
        EXPECT_DOUBLE_EQ(eos_of(gamma).bulk_modulus, 2200 * gamma);
        EXPECT_EQ(eos_of(gamma).relative_volume, 1);
    }
    EXPECT_THROW(eos_of(0), DeckError);
}

TEST(PressureStep, FollowsTheAdiabatOfAnIdealGasToSecondOrder)
{
    const double gamma = 1.4;
    const LinearPolynomial gas = ideal_gas(gamma, 2.5);
    const auto error_with = [&](int steps) {
        double energy = gas.energy, pressure = gas.evaluate(1.0).pressure(energy);
        for (int i = 1; i <= steps; ++i) {
            const double volume = 1 - 0.5 * i / steps;
            const auto end =
                advance_pressure(gas.evaluate(1 / volume), energy, 0.0, pressure, -0.5 / steps, -1e30);
            energy = end.energy;
            pressure = end.pressure;
        }
        return pressure / std::pow(2, gamma) - 1; // p v^gamma = const from p = 1
    };
    EXPECT_LT(std::abs(error_with(50)), 1e-3);
    EXPECT_NEAR(error_with(50) / error_with(100), 4, 0.1);
}

TEST(PressureStep, StopsAtTheCutOff)
{
    const Gruneisen eos = gruneisen_of(reference()["water_eos"]["shah2015_seed002"]);
    const auto end = advance_pressure(eos.evaluate(0.99), 0.0, 0.0, 0.0, 0.01, -1e5);
    EXPECT_EQ(end.pressure, -1e5);
    EXPECT_NEAR(end.energy, 0.5 * 0.01 * 1e5, 1e-9);
}

TEST(EquationsOfState, LanesEqualTheScalarReference)
{
    const Gruneisen water = gruneisen_of(reference()["water_eos"]["song_seed001"]);
    const LinearPolynomial gas = ideal_gas(1.4, 1);
    Lanes compression;
    for (int lane = 0; lane < lane_count; ++lane) compression[lane] = 0.9 + 0.05 * lane;
    const auto many = water.evaluate(compression);
    const auto many_gas = gas.evaluate(compression);
    for (int lane = 0; lane < lane_count; ++lane) {
        const auto one = water.evaluate(double{compression[lane]});
        EXPECT_NEAR(many.cold[lane], one.cold, 1e-14 * std::abs(one.cold));
        EXPECT_NEAR(many.cold_slope[lane], one.cold_slope, 1e-13 * std::abs(one.cold_slope));
        EXPECT_NEAR(many.warm[lane], one.warm, 1e-15);
        EXPECT_NEAR(many_gas.warm[lane], gas.evaluate(double{compression[lane]}).warm, 1e-15);
    }
}

/// Products of TNT (Dobratz & Crawford 1985, LLNL Explosives Handbook, UCRL-52997: A 371.2, B 3.231 GPa,
/// R1 4.15, R2 0.95, OMEGA 0.30, E0 7.0 GPa, 1.63 g/cc): of all shocks that reach their Hugoniot the slowest
/// is the detonation, with D = 6.93 km/s and 21.0 GPa.
TEST(Jwl, DetonatesTntAtItsSpeedAndPressure)
{
    const double density = 1.63;
    const Jwl tnt = Jwl::from_record(
        record_of(
            "EOS_JWL", 1,
            {{"A", 371.2}, {"B", 3.231}, {"R1", 4.15}, {"R2", 0.95}, {"OMEG", 0.30}, {"E0", 7.0}, {"VO", 1}}),
        density);
    double slowest = 1e300, pressure = 0;
    for (double volume = 0.6; volume < 0.95; volume += 1e-5) {
        const auto at = tnt.evaluate(1 / volume);
        // p = cold + warm (E0 + p (1 - V) / 2).
        const double p = (at.cold + at.warm * tnt.energy) / (1 - 0.5 * at.warm * (1 - volume));
        const double speed = std::sqrt(p / (density * (1 - volume)));
        if (speed >= slowest) continue;
        slowest = speed;
        pressure = p;
    }
    EXPECT_NEAR(slowest, 6.93, 0.01 * 6.93);
    EXPECT_NEAR(pressure, 21.0, 0.01 * 21.0);
    check_slopes(tnt);
    EXPECT_THROW(Jwl::from_record(record_of("EOS_JWL", 1, {{"A", 1}, {"R1", 1}, {"R2", 0}, {"OMEG", 1}}), 1),
                 DeckError);
}

/// Air at 288.15 K and 1.225 kg / m^3: 101.3 kPa and a speed of sound of 340.3 m/s (US Standard Atmosphere
/// 1976).
TEST(IdealGas, IsAirAtSeaLevel)
{
    const double density = 1.225;
    const IdealGas air = IdealGas::from_record(
        record_of("EOS_IDEAL_GAS", 1, {{"CVMAS", 717.63}, {"CPMAS", 1004.68}, {"T0", 288.15}, {"V0", 1}}),
        density);
    const auto at = air.evaluate(1.0);
    const double pressure = at.pressure(air.energy);
    EXPECT_NEAR(pressure, 101325, 30);
    EXPECT_NEAR(std::sqrt(at.stiffness(1.0, pressure, air.energy) / density), 340.29, 0.1);
    check_slopes(air);
    EXPECT_THROW(
        IdealGas::from_record(record_of("EOS_IDEAL_GAS", 1, {{"CVMAS", 2}, {"CPMAS", 1}, {"T0", 1}}), 1),
        DeckError);
}

} // namespace plash
