#include "materials/johnson_cook.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

// Units: mm, ms, kg, GPa; a copper-like metal that softens much.
constexpr double density = 8.96e-6, shear_modulus = 46, bulk_modulus = 129;
constexpr double a = 0.09, b = 0.292, n = 0.31, c = 0.025, m = 1.09, melting = 1356, room = 293;
constexpr double reference_rate = 1e-3, capacity = 383e-6 * 1e6; // 1/ms; J/(kg K) in kN mm

JohnsonCook copper(std::vector<std::pair<const char*, double>> more = {})
{
    const double young = 9 * bulk_modulus * shear_modulus / (3 * bulk_modulus + shear_modulus);
    std::vector<std::pair<const char*, double>> fields{
        {"RO", density}, {"G", shear_modulus},
        {"E", young},    {"PR", young / (2 * shear_modulus) - 1},
        {"A", a},        {"B", b},
        {"N", n},        {"C", c},
        {"M", m},        {"TM", melting},
        {"TR", room},    {"EPSO", reference_rate},
        {"CP", capacity}};
    fields.insert(fields.begin(), more.begin(), more.end()); // the first of a name counts
    return JohnsonCook::from_record(make_record("MAT_JOHNSON_COOK", std::move(fields)), Model{});
}

/// The formula at a plastic strain, rate and temperature.
double flow_stress(double strain, double rate, double temperature)
{
    const double hot = (temperature - room) / (melting - room);
    return (a + b * std::pow(strain, n)) * (1 + c * std::log(std::max(rate / reference_rate, 1.0))) *
           (1 - std::pow(std::max(hot, 0.0), m));
}

/// Simple shear at a constant rate: the equivalent stress at the end by the differential equation dp = de -
/// dq / 3G, dT = q dp / (rho cp), in steps a thousand times finer with the flow stress inverted by bisection.
double sheared(double equivalent_strain, double rate)
{
    const int steps = 200000;
    const double step = equivalent_strain / steps;
    double plastic = 0, temperature = room, stress = 0;
    for (int i = 0; i < steps; ++i) {
        const double trial = stress + 3 * shear_modulus * step;
        if (trial <= flow_stress(plastic, rate, temperature)) {
            stress = trial;
            continue;
        }
        double low = 0, high = step;
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (low + high);
            const bool above =
                trial - 3 * shear_modulus * middle > flow_stress(plastic + middle, rate, temperature);
            (above ? low : high) = middle;
        }
        plastic += low;
        stress = trial - 3 * shear_modulus * low;
        temperature += stress * low / (density * capacity);
    }
    return stress;
}

} // namespace

/// 100 % equivalent strain in 200 steps at two rates. The temperature is taken at the start of each step,
/// which at the higher rate warms by 0.6 K: 0.6 / 1063 of the strength.
TEST(JohnsonCook, ShearedAdiabaticallyFollowsItsDifferentialEquation)
{
    const JohnsonCook law = copper();
    for (const double rate : {1e-3, 10.0}) {
        double history[JohnsonCook::history_size];
        std::copy_n(law.initial_history().begin(), JohnsonCook::history_size, history);
        SymmetricTensor<double> stress{};
        const int steps = 200;
        const double per_step = 1.0 / steps; // of equivalent strain: sqrt(4/3) times the shear strain xy
        for (int i = 0; i < steps; ++i) {
            law.update(stress, SymmetricTensor<double>{0, 0, 0, per_step * std::sqrt(0.75), 0, 0},
                       HistoryView<double>{history}, per_step / rate);
        }
        const double expected = sheared(1.0, rate);
        EXPECT_NEAR(std::sqrt(3.0) * stress.xy / expected, 1, 6e-4) << rate;
        EXPECT_GT(history[JohnsonCook::temperature], room + 50);
        EXPECT_LT(expected, 0.96 * flow_stress(history[JohnsonCook::plastic_strain], rate, room));
    }
}

/// Without heat a bar in plane stress and a solid in uniaxial stress see the closed form A + B p^N; VP = 1
/// takes the plastic rate instead of the total one, which differ by the elastic part alone.
TEST(JohnsonCook, PulledInPlaneStressLiesOnTheCurve)
{
    for (const double viscoplastic : {0.0, 1.0}) {
        const JohnsonCook law = copper({{"CP", 0}, {"VP", viscoplastic}});
        double history[JohnsonCook::history_size] = {0, room, 0};
        SymmetricTensor<double> stress{};
        const int steps = 400;
        const double step = 0.2 / steps, rate = 1;
        for (int i = 0; i < steps; ++i) { // lateral strain that keeps yy at zero, found by secants
            double lateral = -0.4 * step;
            SymmetricTensor<double> end{};
            double end_history[JohnsonCook::history_size];
            const auto at = [&](double yy) {
                end = stress;
                std::copy_n(history, JohnsonCook::history_size, end_history);
                SymmetricTensor<double> increment{step, yy, 0, 0, 0, 0};
                law.update_plane_stress(end, increment, HistoryView<double>{end_history}, step / rate);
                return end.yy;
            };
            double before = lateral * 1.1, value_before = at(before);
            for (int k = 0; k < 30; ++k) {
                const double value = at(lateral);
                if (std::abs(value) < 1e-13 || value == value_before) break;
                const double next = lateral - value * (lateral - before) / (value - value_before);
                before = lateral;
                value_before = value;
                lateral = next;
            }
            stress = end;
            std::copy_n(end_history, JohnsonCook::history_size, history);
        }
        const double p = history[JohnsonCook::plastic_strain];
        EXPECT_NEAR(p, 0.2 - stress.xx / law.young_modulus, 1e-6);
        // The rate of a bar's plastic strain is that of its length; the deviator's differs by the elastic
        // part.
        EXPECT_NEAR(stress.xx / flow_stress(p, rate, room), 1, 1e-4) << viscoplastic;
    }
}

/// At a constant triaxiality the fracture strain is D1 + D2 exp(D3 s); the sum reaches 1 there.
TEST(JohnsonCook, BreaksAtItsFractureStrain)
{
    EXPECT_FALSE(copper().fractures());
    JohnsonCook brittle = copper({{"CP", 0}, {"C", 0}});
    brittle.fracture = {0.1, 0.3, -1.5, 0, 0};
    double history[JohnsonCook::history_size] = {0, room, 0};
    SymmetricTensor<double> stress{};
    double strain = 0;
    while (history[JohnsonCook::damage] < 1 && strain < 1) { // pure shear: no mean stress
        brittle.update(stress, SymmetricTensor<double>{0, 0, 0, 1e-4, 0, 0}, HistoryView<double>{history},
                       1.0);
        strain = history[JohnsonCook::plastic_strain];
    }
    EXPECT_NEAR(strain, 0.4, 2e-4);
    EXPECT_TRUE(brittle.failed(HistoryView<double>{history}));
    EXPECT_EQ(stress.xy, 0);
}

/// Lanes give what single points give.
TEST(JohnsonCook, LanesEqualSinglePoints)
{
    const JohnsonCook law = copper({{"VP", 1}});
    Lanes history[JohnsonCook::history_size] = {Lanes{}, broadcast<Lanes>(room), Lanes{}};
    double single[lane_count][JohnsonCook::history_size];
    SymmetricTensor<Lanes> stress{};
    SymmetricTensor<double> stresses[lane_count] = {};
    for (auto& values : single) std::copy_n(law.initial_history().begin(), JohnsonCook::history_size, values);
    for (int step = 0; step < 50; ++step) {
        SymmetricTensor<Lanes> increment{};
        for (int lane = 0; lane < lane_count; ++lane) {
            const double size = 1e-3 * lane * std::cos(0.3 * step + lane);
            increment.xx[lane] = size;
            increment.yy[lane] = -0.3 * size;
            increment.xy[lane] = 0.2 * size;
            const SymmetricTensor<double> one{size, -0.3 * size, 0, 0.2 * size, 0, 0};
            law.update(stresses[lane], one, HistoryView<double>{single[lane]}, 1e-3);
        }
        law.update(stress, increment, HistoryView<Lanes>{history}, 1e-3);
    }
    for (int lane = 0; lane < lane_count; ++lane) {
        EXPECT_NEAR(stress.xx[lane], stresses[lane].xx, 1e-12);
        EXPECT_NEAR(stress.xy[lane], stresses[lane].xy, 1e-12);
        EXPECT_NEAR(history[0][lane], single[lane][0], 1e-12);
    }
}

/// Pulled to a tension of PC in all directions, a spalled point is rubble: no tension and no shear again, but
/// pressure (SPALL = 3); the default limit (1) keeps its strength.
TEST(JohnsonCook, SpallsInHydrostaticTension)
{
    for (const double model : {1.0, 3.0}) {
        const JohnsonCook law = copper({{"PC", -1}, {"SPALL", model}});
        double history[JohnsonCook::history_size];
        std::copy_n(law.initial_history().begin(), JohnsonCook::history_size, history);
        SymmetricTensor<double> stress{};
        const auto strain = [&](double mean, double shear) {
            law.update(stress, SymmetricTensor<double>{mean, mean, mean, shear, 0, 0},
                       HistoryView<double>{history}, 1e-3);
            return trace(stress) / 3;
        };
        const double limit = 1 / (3 * bulk_modulus);
        EXPECT_NEAR(strain(0.9 * limit, 1e-4), 0.9, 1e-12);
        EXPECT_NEAR(stress.xy, 2 * shear_modulus * 1e-4, 1e-12);
        EXPECT_NEAR(strain(0.3 * limit, 0), model == 1 ? 1 : 0, 1e-12);
        EXPECT_NEAR(stress.xy, model == 1 ? 2 * shear_modulus * 1e-4 : 0, 1e-12);
        EXPECT_NEAR(strain(-2 * limit, 1e-4), model == 1 ? -1 : -2, 1e-12);
        EXPECT_NEAR(stress.xy, model == 1 ? 4 * shear_modulus * 1e-4 : 0, 1e-12);
    }
}

} // namespace plash
