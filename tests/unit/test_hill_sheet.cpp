#include "materials/hill_sheet.h"
#include "materials/piecewise_linear_plasticity.h"
#include "tests/support/law_driver.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

// MPa: a deep drawing steel.
constexpr double r00 = 1.8, r45 = 1.3, r90 = 2.2, hill_young = 207000, hill_poisson = 0.3, first_yield = 180,
                 hard = 400;

HillSheet sheet(std::vector<std::pair<const char*, double>> more = {})
{
    std::vector<std::pair<const char*, double>> fields{
        {"RO", 7.85e-9},     {"E", hill_young}, {"PR", hill_poisson}, {"HR", 1},   {"P1", hard},
        {"P2", first_yield}, {"R00", r00},      {"R45", r45},         {"R90", r90}};
    fields.insert(fields.begin(), more.begin(), more.end());
    return HillSheet::from_record(make_record("MAT_HILL_3R", std::move(fields)), Model{});
}

SymmetricTensor<double> turned(const SymmetricTensor<double>& t, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * c * t.xx + s * s * t.yy + 2 * c * s * t.xy,
            s * s * t.xx + c * c * t.yy - 2 * c * s * t.xy,
            t.zz,
            c * s * (t.yy - t.xx) + (c * c - s * s) * t.xy,
            0,
            0};
}

/// Tension along x of a strip whose rolling direction stands at an angle: the lateral and shear strains of
/// every step are found so that only s_x is left. Returns stress and the plastic strains.
struct Tension {
    double stress, width_over_thickness, plastic_work, equivalent;
};
Tension pulled(const HillSheet& law, double angle, double strain, int steps)
{
    double history[HillSheet::history_size] = {};
    SymmetricTensor<double> stress{};
    double width = 0, thickness = 0, work = 0;
    double lateral = -0.5, sheared = 0; // strains over the axial one
    for (int step = 0; step < steps; ++step) {
        const auto attempt = [&](double l, double g, double* h, SymmetricTensor<double>& out) {
            const double e = strain / steps;
            SymmetricTensor<double> local = turned({e, l * e, 0, g * e, 0, 0}, angle);
            SymmetricTensor<double> s = turned(stress, angle);
            law.update_plane_stress(s, local, HistoryView<double>{h}, 1);
            out = turned(s, -angle);
            return local.zz;
        };
        double zz = 0;
        SymmetricTensor<double> now{};
        for (int round = 0; round < 40; ++round) { // Newton with differences
            double h0[1] = {history[0]}, h1[1] = {history[0]}, h2[1] = {history[0]};
            SymmetricTensor<double> a{}, b{};
            attempt(lateral, sheared, h0, now);
            if (std::hypot(now.yy, now.xy) < 1e-9) break;
            const double d = 1e-6;
            attempt(lateral + d, sheared, h1, a);
            attempt(lateral, sheared + d, h2, b);
            const double j11 = (a.yy - now.yy) / d, j12 = (b.yy - now.yy) / d, j21 = (a.xy - now.xy) / d,
                         j22 = (b.xy - now.xy) / d, det = j11 * j22 - j12 * j21;
            lateral -= (j22 * now.yy - j12 * now.xy) / det;
            sheared -= (j11 * now.xy - j21 * now.yy) / det;
        }
        const SymmetricTensor<double> before = stress;
        zz = attempt(lateral, sheared, history, now);
        stress = now;
        const double e = strain / steps, change = stress.xx - before.xx;
        width += lateral * e + hill_poisson / hill_young * change; // less the elastic part
        thickness += zz + hill_poisson / hill_young * change;
        work += 0.5 * (stress.xx + before.xx) * e;
    }
    return {stress.xx, width / thickness, work - 0.5 * stress.xx * stress.xx / hill_young, history[0]};
}

} // namespace

/// Lankford's ratios come back, and the yield stresses of Hill's formula at the angle.
TEST(HillSheet, HasItsRatiosInTension)
{
    const HillSheet law = sheet();
    const double f = r00 / (r90 * (1 + r00)), g = 1 / (1 + r00), h = r00 / (1 + r00);
    const double n = (1 + 2 * r45) * (r00 + r90) / (2 * r90 * (1 + r00));
    const double ratios[] = {r00, r45, r90};
    for (int i = 0; i < 3; ++i) {
        const double angle = -0.7853981633974483 * i; // of the strip in the axes of the sheet
        const Tension end = pulled(law, angle, 0.05, 50);
        EXPECT_NEAR(end.width_over_thickness, ratios[i], 1e-5) << 45 * i;
        const double c = std::cos(angle), s = std::sin(angle);
        const double factor = std::sqrt(g * c * c * c * c + f * s * s * s * s +
                                        h * std::pow(c * c - s * s, 2) + 2 * n * c * c * s * s);
        const double plastic_modulus = hill_young * hard / (hill_young - hard);
        EXPECT_NEAR(factor * end.stress, first_yield + plastic_modulus * end.equivalent, 1e-8) << 45 * i;
        // Equivalent plastic strain is work conjugate: strain - stress / E is q-strain times the factor.
        EXPECT_NEAR((0.05 - end.stress / hill_young), factor * end.equivalent, 1e-7) << 45 * i;
    }
}

/// With all ratios 1 it is von Mises' sheet.
TEST(HillSheet, WithoutAnisotropyIsVonMises)
{
    const HillSheet law = sheet({{"R00", 1}, {"R45", 1}, {"R90", 1}});
    const auto mises = PiecewiseLinearPlasticity::from_record(
        make_record("MAT_PIECEWISE_LINEAR_PLASTICITY", {{"RO", 7.85e-9},
                                                        {"E", hill_young},
                                                        {"PR", hill_poisson},
                                                        {"SIGY", first_yield},
                                                        {"ETAN", hard}}),
        Model{});
    double h[HillSheet::history_size] = {};
    std::array<double, PiecewiseLinearPlasticity::history_size> k = mises.initial_history();
    SymmetricTensor<double> a{}, b{};
    for (int i = 0; i < 60; ++i) {
        SymmetricTensor<double> one{
            1e-3 * std::sin(0.3 * i), 8e-4 * std::cos(0.2 * i), 0, 5e-4 * std::sin(i), 0, 0};
        SymmetricTensor<double> two = one;
        law.update_plane_stress(a, one, HistoryView<double>{h}, 1);
        mises.update_plane_stress(b, two, HistoryView<double>{k.data()}, 1);
        EXPECT_NEAR(a.xx, b.xx, 1e-9);
        EXPECT_NEAR(a.xy, b.xy, 1e-9);
        EXPECT_NEAR(one.zz, two.zz, 1e-15);
    }
    EXPECT_NEAR(h[0], k[0], 1e-14);
}

TEST(HillSheet, ReadsItsHardeningRulesAndMat037)
{
    const HillSheet swift = sheet({{"HR", 2}, {"P1", 550}, {"P2", 0.22}, {"E0", 0.004}});
    EXPECT_NEAR(swift.hardening(0.1, 0.0).stress, 550 * std::pow(0.104, 0.22), 0.02);
    const HillSheet normal = HillSheet::from_record(
        make_record("MAT_TRANSVERSELY_ANISOTROPIC_ELASTIC_PLASTIC",
                    {{"RO", 1}, {"E", 10}, {"PR", 0.3}, {"SIGY", 1}, {"ETAN", 1}, {"R", -2}}),
        Model{});
    EXPECT_NEAR(normal.b, 1, 1e-15);
    EXPECT_NEAR(normal.c, 2.0 / 3, 1e-15);
    EXPECT_NEAR(normal.d, 10.0 / 3, 1e-15);
    EXPECT_THROW(sheet({{"HR", 4}}), DeckError);
    EXPECT_THROW(sheet({{"R45", 0}}), DeckError);
}

TEST(HillSheet, LanesEqualTheScalarReference)
{
    const HillSheet law = sheet();
    Lanes history[HillSheet::history_size] = {};
    SymmetricTensor<Lanes> stress{};
    std::array<double, lane_count> h{};
    std::array<SymmetricTensor<double>, lane_count> single{};
    for (int step = 0; step < 30; ++step) {
        SymmetricTensor<Lanes> increment{};
        for (int lane = 0; lane < lane_count; ++lane) {
            SymmetricTensor<double> one{
                1e-3 * std::sin(0.4 * step + lane), 4e-4 * std::cos(step - lane), 0, 2e-4 * lane, 0, 0};
            increment.xx[lane] = one.xx;
            increment.yy[lane] = one.yy;
            increment.xy[lane] = one.xy;
            law.update_plane_stress(single[lane], one, HistoryView<double>{&h[lane]}, 1);
        }
        law.update_plane_stress(stress, increment, HistoryView<Lanes>{history}, 1);
    }
    for (int lane = 0; lane < lane_count; ++lane) {
        EXPECT_NEAR(stress.xx[lane], single[lane].xx, 1e-9);
        EXPECT_NEAR(stress.xy[lane], single[lane].xy, 1e-9);
        EXPECT_NEAR(history[0][lane], h[lane], 1e-14);
    }
}

} // namespace plash
