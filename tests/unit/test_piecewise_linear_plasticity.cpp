#include "materials/piecewise_linear_plasticity.h"

#include "tests/support/law_driver.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace plash {

namespace {

using Law = PiecewiseLinearPlasticity;
using Tensor = SymmetricTensor<double>;

constexpr double young_modulus = 210, poisson_ratio = 0.3, yield_stress = 0.3, tangent_modulus = 2;
constexpr double hardening_modulus = young_modulus * tangent_modulus / (young_modulus - tangent_modulus);

Model model_with_curves()
{
    Model model;
    model.curves.push_back({10, "", {}, Curve{{0, 0.1, 0.3}, {0.3, 0.4, 0.45}}});
    model.curves.push_back({11, "", {}, Curve{{0, 0.1, 0.3}, {0.6, 0.8, 0.9}}});
    model.curves.push_back({12, "", {}, Curve{{0, 100}, {1, 3}}}); // factor over strain rate
    model.curves.push_back({13, "", {}, Curve{{0, 0.05, 0.1, 0.2}, {0, 0.2, 0.6, 3}}});
    model.curves.push_back({14, "", {}, Curve{{0, 0.05, 0.1}, {0, 0, 0.6}}});
    NamedTable table;
    table.id = 20;
    table.abscissa = {1e-3, 10};
    table.curves = {0, 1};
    model.tables.push_back(table);
    table.id = 21;
    table.abscissa = {std::log(1e-3), std::log(10)};
    model.tables.push_back(table);
    return model;
}

Law law_of(std::vector<std::pair<const char*, double>> more)
{
    std::vector<std::pair<const char*, double>> fields{
        {"RO", 7.8e-6}, {"E", young_modulus}, {"PR", poisson_ratio}};
    if (more.empty() || more.front().first != std::string("SIGY")) fields.push_back({"SIGY", yield_stress});
    fields.insert(fields.end(), more.begin(), more.end());
    return Law::from_record(make_record("MAT_PIECEWISE_LINEAR_PLASTICITY", fields), model_with_curves());
}

/// A point that remembers its stress and history.
struct Point {
    Tensor stress;
    std::array<double, Law::history_size> history;
    explicit Point(const Law& law) : history(law.initial_history()) {}
    double plastic_strain() const { return history[Law::plastic_strain]; }
};

/// Stretches along x by `strain` in steps of which each takes `time_step`, the other directions free:
/// for solids both lateral strains, for shells the one in the plane are found by iteration to zero stress.
void stretch(const Law& law, Point& point, double strain, int steps, double time_step, bool shell)
{
    const double axial = strain / steps;
    double lateral = -0.5 * axial;
    for (int step = 0; step < steps; ++step) {
        const auto attempt = [&](double trial_lateral) {
            Point copy = point;
            Tensor increment{axial, trial_lateral, trial_lateral, 0, 0, 0};
            const HistoryView<double> history{copy.history.data()};
            if (shell) {
                law.update_plane_stress(copy.stress, increment, history, time_step);
            } else {
                law.update(copy.stress, increment, history, time_step);
            }
            return copy;
        };
        // Secant iteration on the lateral stress.
        double a = lateral, b = lateral * 1.01 + 1e-12;
        double fa = attempt(a).stress.yy, fb = attempt(b).stress.yy;
        for (int i = 0; i < 60 && std::abs(fb) > 1e-14 && fa != fb; ++i) {
            const double next = b - fb * (b - a) / (fb - fa);
            a = b;
            fa = fb;
            b = next;
            fb = attempt(b).stress.yy;
        }
        lateral = b;
        point = attempt(lateral);
        ASSERT_LT(std::abs(point.stress.yy), 1e-12);
    }
}

} // namespace

TEST(PiecewiseLinearPlasticity, FollowsTheBilinearUniaxialCurve)
{
    const Law law = law_of({{"ETAN", tangent_modulus}});
    for (bool shell : {false, true}) {
        Point point(law);
        stretch(law, point, 0.02, 20, 0, shell);
        const double yield_strain = yield_stress / young_modulus;
        const double stress = yield_stress + tangent_modulus * (0.02 - yield_strain);
        // Proportional loading: the return is exact for any step.
        EXPECT_NEAR(point.stress.xx, stress, 1e-10);
        EXPECT_NEAR(point.plastic_strain(), 0.02 - stress / young_modulus, 1e-10);
        stretch(law, point, -0.001, 1, 0, shell); // elastic back
        EXPECT_NEAR(point.stress.xx, stress - 0.001 * young_modulus, 1e-10);
    }
}

TEST(PiecewiseLinearPlasticity, ShearCycleHardensIsotropically)
{
    const Law law = law_of({{"ETAN", tangent_modulus}});
    const double shear_modulus = law.shear_modulus();
    for (bool shell : {false, true}) {
        Point point(law);
        double travelled = 0; // plastic strain by hand
        double expected = 0;  // shear stress by hand
        for (const double gamma : {0.02, -0.03, 0.04}) {
            for (int step = 0; step < 10; ++step) {
                Tensor increment{0, 0, 0, 0.05 * gamma, 0, 0};
                const HistoryView<double> history{point.history.data()};
                if (shell) law.update_plane_stress(point.stress, increment, history, 0);
                if (!shell) law.update(point.stress, increment, history, 0);
                // tau = k(p) with k = (sigma_y + H p) / sqrt(3); p grows by |dgamma_p| / sqrt(3).
                const double trial = expected + shear_modulus * 0.1 * gamma;
                const double excess =
                    std::sqrt(3.0) * std::abs(trial) - yield_stress - hardening_modulus * travelled;
                const double plastic = std::max(excess, 0.0) / (3 * shear_modulus + hardening_modulus);
                travelled += plastic;
                expected = trial - std::copysign(std::sqrt(3.0) * shear_modulus * plastic, trial);
                EXPECT_NEAR(point.stress.xy, expected, 1e-10);
                EXPECT_NEAR(point.plastic_strain(), travelled, 1e-10);
                EXPECT_NEAR(increment.zz, 0, 1e-15);
            }
        }
    }
}

TEST(PiecewiseLinearPlasticity, FollowsPointsAndCurves)
{
    for (const Law& law :
         {law_of({{"LCSS", 10}}),
          law_of({{"EPS1", 0}, {"ES1", 0.3}, {"EPS2", 0.1}, {"ES2", 0.4}, {"EPS3", 0.3}, {"ES3", 0.45}})}) {
        for (bool shell : {false, true}) {
            Point point(law);
            stretch(law, point, 0.15, 30, 0, shell);
            const double first = point.plastic_strain();
            EXPECT_NEAR(point.stress.xx, 0.4 + 0.25 * (first - 0.1), 1e-10);
            stretch(law, point, 0.25, 30, 0, shell); // beyond the last point with the last slope
            const double second = point.plastic_strain();
            EXPECT_GT(second, 0.35);
            EXPECT_NEAR(point.stress.xx, 0.45 + 0.25 * (second - 0.3), 1e-10);
        }
    }
}

/// A crush curve from zero on, in a uniaxial cycle. By hand, with isotropic hardening and strain e from the
/// start of each way: |s| = curve(p), p grown by e less the elastic way (|s| + |s at the turn|) / E.
TEST(PiecewiseLinearPlasticity, CurvesMayBeginAtZero)
{
    for (const auto& more : {std::vector<std::pair<const char*, double>>{{"LCSS", 13}},
                             {{"LCSS", 13}, {"C", 1e300}, {"P", 4}},
                             {{"LCSS", 13}, {"C", 1e300}, {"P", 4}, {"VP", 1}, {"SIGY", 0}}}) {
        const Law law = law_of(more);
        const Curve curve{{0, 0.05, 0.1, 0.2}, {0, 0.2, 0.6, 3}};
        for (bool shell : {false, true}) {
            Point point(law);
            double plastic = 0, turn = 0;
            for (const double way : {0.03, -0.05, 0.04, -1e-9}) {
                stretch(law, point, way, 25, 1, shell);
                double low = plastic, high = plastic + 1; // bisection on the plastic strain at the end
                const auto excess = [&](double p) {
                    return p - plastic + (curve(p) + std::abs(turn)) / young_modulus - std::abs(way);
                };
                if (excess(plastic) >= 0) { // elastic
                    EXPECT_NEAR(point.stress.xx, turn + young_modulus * way, 1e-12);
                    continue;
                }
                for (int i = 0; i < 100; ++i)
                    (excess(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
                plastic = low;
                turn = std::copysign(curve(plastic), way);
                EXPECT_NEAR(point.stress.xx, turn, 1e-10);
                EXPECT_NEAR(point.plastic_strain(), plastic, 1e-10);
            }
        }
    }
    EXPECT_THROW(law_of({{"LCSS", 14}}), DeckError); // no stress at 5 %
}

TEST(PiecewiseLinearPlasticity, AVirginPointWithoutStrengthBearsNothingAtRest)
{
    const Law law = law_of({{"LCSS", 13}});
    for (double strain : {0.0, 1e-30, 1e-12, 0.4}) {
        Point solid(law), shell(law), beam(law);
        Tensor increment{strain, 0, 0, 0.5 * strain, 0, 0}, plane = increment;
        law.update(solid.stress, increment, HistoryView<double>{solid.history.data()}, 1);
        law.update_plane_stress(shell.stress, plane, HistoryView<double>{shell.history.data()}, 1);
        double stress[3] = {};
        law.update_beam(stress, strain, strain, 0.0, HistoryView<double>{beam.history.data()}, 1);
        const auto mises = [](const Tensor& s) {
            const Tensor d = deviator(s);
            return std::sqrt(1.5 * contract(d, d));
        };
        EXPECT_NEAR(mises(solid.stress), law.hardening(solid.plastic_strain(), 0.0).stress,
                    1e-7 * strain); // near of return_parameter, squared by its last step
        EXPECT_NEAR(mises(shell.stress), law.hardening(shell.plastic_strain(), 0.0).stress, 1e-7 * strain);
        EXPECT_NEAR(std::sqrt(stress[0] * stress[0] + 3 * stress[1] * stress[1]),
                    law.hardening(beam.plastic_strain(), 0.0).stress, 1e-7 * strain);
        if (strain == 0) {
            EXPECT_EQ(solid.plastic_strain() + shell.plastic_strain() + beam.plastic_strain(), 0);
        }
    }
}

TEST(PiecewiseLinearPlasticity, CowperSymondsScalesTheYieldStress)
{
    const double reference = 40, exponent = 5;
    const Law law = law_of({{"C", reference}, {"P", exponent}});
    for (const double rate : {0.1, 100.0}) {
        Point point(law);
        const double time_step = 1e-4 / rate;
        stretch(law, point, 0.02, 200, time_step, true);
        const double factor = 1 + std::pow(rate / reference, 1 / exponent);
        // In the plastic range the lateral strain is -1/2 of the axial one, and the rate that of the test.
        EXPECT_NEAR(point.stress.xx, yield_stress * factor, 1e-9);
    }
}

TEST(PiecewiseLinearPlasticity, ViscoplasticStressIsStaticPlusOverstress)
{
    const double reference = 40, exponent = 5;
    for (const bool shell : {false, true}) {
        for (const double rate : {1e-6, 0.1, 100.0, 1e4}) {
            const Law law = law_of({{"C", reference}, {"P", exponent}, {"VP", 1}, {"ETAN", tangent_modulus}});
            Point point(law);
            const double time_step = 1e-4 / rate;
            stretch(law, point, 0.05, 500, time_step, shell);
            const double before = point.plastic_strain();
            stretch(law, point, 1e-4, 1, time_step, shell);
            const double plastic_rate = (point.plastic_strain() - before) / time_step;
            const double stress = yield_stress * (1 + std::pow(plastic_rate / reference, 1 / exponent)) +
                                  hardening_modulus * point.plastic_strain();
            EXPECT_NEAR(point.stress.xx, stress, 1e-9) << rate;
            EXPECT_NEAR(plastic_rate, rate, 0.02 * rate);
        }
    }
}

TEST(PiecewiseLinearPlasticity, TablesInterpolateBetweenRates)
{
    for (const int viscoplastic : {0, 1}) {
        for (const int table : {20, 21}) {
            const Law law = law_of({{"LCSS", table}, {"VP", viscoplastic}});
            for (const double rate : {1e-4, 0.1, 5.0, 50.0}) {
                Point point(law);
                stretch(law, point, 0.05, 500, 1e-4 / rate, true);
                const double strain = point.plastic_strain();
                double share = (rate - 1e-3) / (10 - 1e-3);
                if (table == 21) share = std::log(rate / 1e-3) / std::log(10 / 1e-3);
                share = std::clamp(share, 0.0, 1.0);
                const double stress = (0.3 + strain) * (1 - share) + (0.6 + 2 * strain) * share;
                // The plastic rate is below the total one by the elastic part, at most H / E = 1 %; for the
                // total one only the lateral strain of the hardening differs from -1/2.
                EXPECT_NEAR(point.stress.xx, stress, viscoplastic ? 2e-3 : 1e-6) << rate;
            }
        }
    }
}

/// C and P beside a table are not used (keyword manual, volume II).
TEST(PiecewiseLinearPlasticity, ATableGoesBeforeCowperAndSymonds)
{
    const Law alone = law_of({{"LCSS", 20}}), both = law_of({{"LCSS", 20}, {"C", 40}, {"P", 5}});
    const Law with_curve = law_of({{"LCSS", 20}, {"LCSR", 12}});
    Point first(alone), second(both), third(with_curve);
    stretch(alone, first, 0.05, 500, 1e-4 / 5, true);
    stretch(both, second, 0.05, 500, 1e-4 / 5, true);
    stretch(with_curve, third, 0.05, 500, 1e-4 / 5, true);
    EXPECT_EQ(first.stress.xx, second.stress.xx);
    EXPECT_EQ(first.stress.xx, third.stress.xx);
}

/// Uniaxial strain at rate r: sqrt(2/3 d:d) is sqrt(2/3) r of the whole strain (VP = 0) and 2/3 r of its
/// deviatoric part (VP = -1).
TEST(PiecewiseLinearPlasticity, DeviatoricRatesLeaveTheVolumeOut)
{
    const double reference = 40, exponent = 5, rate = 100, strain = 0.02;
    for (const int option : {0, -1}) {
        const Law law = law_of({{"C", reference}, {"P", exponent}, {"VP", option}});
        testing::DrivenPoint<Law> point(law);
        point.strain({strain, 0, 0, 0, 0, 0}, 200, strain / rate);
        const double seen = rate * (option == 0 ? std::sqrt(2.0 / 3) : 2.0 / 3);
        const double factor = 1 + std::pow(seen / reference, 1 / exponent);
        EXPECT_NEAR(point.stress.xx - point.stress.yy, yield_stress * factor, 1e-9) << option;
    }
}

TEST(PiecewiseLinearPlasticity, RateCurveScalesTheYieldStress)
{
    for (const int viscoplastic : {0, 1}) {
        const Law law = law_of({{"LCSR", 12}, {"VP", viscoplastic}});
        Point point(law);
        stretch(law, point, 0.02, 200, 1e-4 / 50, true);
        // Perfect plasticity: in the end all strain is plastic (the viscoplastic rate gets there slowly).
        EXPECT_NEAR(point.stress.xx, 2 * yield_stress, 5e-6);
    }
}

TEST(PiecewiseLinearPlasticity, FailedPointsCarryNothing)
{
    const Law law = law_of({{"FAIL", 0.01}});
    Point point(law);
    const HistoryView<double> history{point.history.data()};
    Tensor increment;
    for (int step = 0; step < 20; ++step) {
        increment = {0, 0, 0, 0.001, 0, 0};
        EXPECT_EQ(law.failed(history), point.stress.xy == 0 && step > 0) << step;
        law.update_plane_stress(point.stress, increment, history, 0);
    }
    EXPECT_TRUE(law.failed(history));
    EXPECT_EQ(point.stress.xy, 0);
    // Plastic strain stops where the point failed: 2 eps_xy / sqrt(3) a step.
    EXPECT_NEAR(point.plastic_strain(), 0.01, 2 * 0.001 / std::sqrt(3.0));
}

TEST(PiecewiseLinearPlasticity, LanesEqualTheScalarReference)
{
    for (const Law& law :
         {law_of({{"ETAN", tangent_modulus}}), law_of({{"LCSS", 10}}), law_of({{"LCSS", 21}, {"VP", 1}}),
          law_of({{"C", 40}, {"P", 5}}), law_of({{"C", 40}, {"P", 5}, {"VP", 1}, {"FAIL", 0.02}})}) {
        for (bool shell : {false, true}) {
            std::mt19937 generator(3);
            std::uniform_real_distribution<double> random(-2e-3, 2e-3);
            std::vector<Point> points(lane_count, Point(law));
            SymmetricTensor<Lanes> stress{};
            Lanes history[Law::history_size];
            for (int i = 0; i < Law::history_size; ++i) history[i] = broadcast<Lanes>(points[0].history[i]);
            for (int step = 0; step < 30; ++step) {
                SymmetricTensor<Lanes> increments;
                Tensor increment[lane_count];
                for (int lane = 0; lane < lane_count; ++lane) {
                    // Some lanes stay elastic.
                    const double size = lane < 3 ? 0.01 : 1;
                    for (auto [all, one] : {std::pair{&increments.xx, &increment[lane].xx},
                                            {&increments.yy, &increment[lane].yy},
                                            {&increments.zz, &increment[lane].zz},
                                            {&increments.xy, &increment[lane].xy},
                                            {&increments.yz, &increment[lane].yz},
                                            {&increments.zx, &increment[lane].zx}}) {
                        (*all)[lane] = *one = size * random(generator);
                    }
                }
                if (shell) law.update_plane_stress(stress, increments, HistoryView<Lanes>{history}, 1e-3);
                if (!shell) law.update(stress, increments, HistoryView<Lanes>{history}, 1e-3);
                for (int lane = 0; lane < lane_count; ++lane) {
                    Point& point = points[lane];
                    const HistoryView<double> own{point.history.data()};
                    if (shell) law.update_plane_stress(point.stress, increment[lane], own, 1e-3);
                    if (!shell) law.update(point.stress, increment[lane], own, 1e-3);
                    // Newton's tolerance is 1e-11 of the yield stress, and errors add up over steps.
                    EXPECT_NEAR(stress.xx[lane], point.stress.xx, 1e-10);
                    EXPECT_NEAR(stress.zx[lane], point.stress.zx, 1e-10);
                    EXPECT_NEAR(history[0][lane], point.history[0], 1e-12);
                    EXPECT_NEAR(increments.zz[lane], increment[lane].zz, 1e-12);
                }
            }
        }
    }
}

TEST(PiecewiseLinearPlasticity, NamesWhatIsWrongInTheCard)
{
    const auto message = [](std::vector<std::pair<const char*, double>> fields) {
        try {
            law_of(std::move(fields));
        } catch (const DeckError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(message({{"SIGY", 0}}),
              "*MAT_PIECEWISE_LINEAR_PLASTICITY, field SIGY: 0 is not positive (yield stress)");
    EXPECT_EQ(message({{"ETAN", 300}}),
              "*MAT_PIECEWISE_LINEAR_PLASTICITY, field ETAN: tangent modulus 300 is not "
              "below Young's modulus 210");
    EXPECT_EQ(message({{"LCSS", 99}}),
              "*MAT_PIECEWISE_LINEAR_PLASTICITY, field LCSS: there is no *DEFINE_CURVE 99");
    EXPECT_EQ(message({{"VP", 7}}),
              "*MAT_PIECEWISE_LINEAR_PLASTICITY, field VP: rate formulation 7 is not supported "
              "(-1, 0 or 1)");
}

TEST(Hardening, IsExactForUnevenPointsAndBeyondThem)
{
    Curve few{{0, 0.001, 0.0015, 0.02, 0.5}, {1, 2, 2.1, 3, 4}}, many = few;
    // Enough points in the last segment that the curve is cut into bins.
    for (int i = 1; i < 40; ++i) {
        many.abscissa.insert(many.abscissa.end() - 1, 0.02 + 0.48 * i / 40);
        many.ordinate.insert(many.ordinate.end() - 1, 3 + std::sqrt(i / 40.0));
    }
    for (const Curve& curve : {few, many}) {
        const Hardening hardening = Hardening::curve(curve);
        const std::size_t last = curve.abscissa.size() - 1;
        const double end_slope = (curve.ordinate[last] - curve.ordinate[last - 1]) /
                                 (curve.abscissa[last] - curve.abscissa[last - 1]);
        for (int i = 0; i <= 5000; ++i) {
            const double x = 0.6 * i / 5000;
            const double expected = x <= 0.5 ? curve(x) : 4 + (x - 0.5) * end_slope;
            // Slopes of segments 0.012 wide carry 2^-52 4 / 0.012 = 7e-14 of round-off, here and in the
            // curve.
            EXPECT_NEAR(hardening(x, 0.0).stress, expected, 2e-13) << x;
            EXPECT_EQ(hardening.lowest(x), hardening(x, 0.0).stress);
        }
    }
}

} // namespace plash
