#include "materials/mooney_rivlin.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

namespace plash {

using testing::record_of;

namespace {

MooneyRivlin rubber(double nu = 0.49)
{
    MooneyRivlin law;
    law.density = 9.2e-7;
    law.a = 5.4e-4;
    law.b = 4.75e-5;
    law.poisson_ratio = nu;
    return law;
}

Tensor3<double> product(const Tensor3<double>& a, const Tensor3<double>& b)
{
    const Vec3 x = a * Vec3{b.xx, b.yx, b.zx}, y = a * Vec3{b.xy, b.yy, b.zy}, z = a * Vec3{b.xz, b.yz, b.zz};
    return {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}

/// Identity plus gradient.
Tensor3<double> plus_one(Tensor3<double> g)
{
    g.xx += 1;
    g.yy += 1;
    g.zz += 1;
    return g;
}

} // namespace

TEST(MooneyRivlin, UniaxialStretchIsTheTextbookCurveWhenNearlyIncompressible)
{
    // Lateral stretch from zero lateral stress by bisection; nominal stress 2 (s - s^-2) (A + B / s) for an
    // incompressible rubber, so the difference is of order 1 - 2 nu = 2e-5.
    const MooneyRivlin law = rubber(0.49999);
    for (double s : {0.6, 0.9, 1.3, 2.0}) {
        double low = 0.1, high = 3, lateral = 1;
        for (int i = 0; i < 100; ++i) {
            lateral = 0.5 * (low + high);
            const auto stress = law.stress(Tensor3<double>{s, 0, 0, 0, lateral, 0, 0, 0, lateral});
            (stress.yy > 0 ? high : low) = lateral;
        }
        const auto stress = law.stress(Tensor3<double>{s, 0, 0, 0, lateral, 0, 0, 0, lateral});
        const double nominal = stress.xx * lateral * lateral;
        const double wanted = 2 * (s - 1 / (s * s)) * (law.a + law.b / s);
        EXPECT_NEAR(nominal, wanted, 3e-4 * std::abs(wanted)) << s;
    }
}

TEST(MooneyRivlin, SimpleShearHasTheTextbookStress)
{
    const MooneyRivlin law = rubber();
    for (double k : {0.01, 0.5, 2.0}) {
        // Volume is kept: sigma_xy = 2 (A + B) k and sigma_xx - sigma_yy = k sigma_xy (universal relation).
        const auto stress = law.stress(Tensor3<double>{1, k, 0, 0, 1, 0, 0, 0, 1});
        EXPECT_NEAR(stress.xy, 2 * (law.a + law.b) * k, 1e-15);
        EXPECT_NEAR(stress.xx - stress.yy, k * stress.xy, 1e-15);
    }
}

TEST(MooneyRivlin, VolumetricCycleFollowsItsEnergy)
{
    // Pressure of a dilatation: sigma = dW/dV, and W comes from its definition.
    const MooneyRivlin law = rubber();
    for (double v : {0.7, 0.95, 1.0, 1.2}) {
        const double s = std::cbrt(v), j2 = v * v;
        const double slope =
            2 * law.a / s + 4 * law.b * s + 2 * v * (2 * law.d() * (j2 - 1) - 2 * law.c() / (j2 * j2 * j2));
        const auto stress = law.stress(Tensor3<double>{s, 0, 0, 0, s, 0, 0, 0, s});
        EXPECT_NEAR(stress.xx, slope, 1e-14) << v;
    }
}

TEST(MooneyRivlin, StressIsTheDerivativeOfItsEnergy)
{
    const MooneyRivlin law = rubber();
    const Tensor3<double> f{1.2, 0.3, -0.1, 0.2, 0.9, 0.15, -0.05, 0.1, 1.1};
    const Tensor3<double> l{0.3, -0.2, 0.5, 0.4, 0.1, -0.6, 0.2, 0.7, -0.5};
    const double h = 1e-5;
    const auto energy_at = [&](double t) { return law.energy(product(plus_one(t * l), f)); };
    const double rate = (energy_at(h) - energy_at(-h)) / (2 * h);
    EXPECT_NEAR(determinant(f) * contract(law.stress(f), symmetric_part(l)), rate, 1e-8 * std::abs(rate));
}

TEST(MooneyRivlin, SmallStrainsHaveTheModuliOfTheCard)
{
    const MooneyRivlin law = rubber(0.45);
    const double shear = 2 * (law.a + law.b), nu = 0.45, e = 1e-7;
    const double modulus = 2 * shear * (1 - nu) / (1 - 2 * nu);
    const auto stress = law.stress(Tensor3<double>{1 + e, 0, 0, 0, 1, 0, 0, 0, 1});
    EXPECT_NEAR(stress.xx / e, modulus, 1e-5 * modulus);
    EXPECT_NEAR(stress.yy / e, modulus * nu / (1 - nu), 1e-5 * modulus);
    EXPECT_NEAR(law.wave_modulus(Tensor3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}), modulus, 1e-12 * modulus);
}

TEST(MooneyRivlin, WaveModulusIsThatOfTheStiffestPrincipalDirectionOrALittleMore)
{
    const MooneyRivlin law = rubber(0.4);
    for (const Vec3& s : {Vec3{1.5, 0.8, 0.9}, Vec3{0.6, 1.1, 1.2}, Vec3{2, 2, 0.4}, Vec3{0.7, 0.7, 0.7}}) {
        const Tensor3<double> f{s.x, 0, 0, 0, s.y, 0, 0, 0, s.z};
        const double bound = law.wave_modulus(f), h = 1e-5;
        double largest = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto stretched = [&](double t) {
                Tensor3<double> g = f;
                (axis == 0 ? g.xx : axis == 1 ? g.yy : g.zz) *= 1 + t;
                return law.energy(g);
            };
            // lambda^2 W'' / J.
            const double second =
                (stretched(h) - 2 * stretched(0) + stretched(-h)) / (h * h) / determinant(f);
            largest = std::max(largest, second);
        }
        EXPECT_GE(bound, largest * (1 - 1e-4)); // differences of energies: 1e-16 / h^2
        EXPECT_LT(bound, 1.2 * largest);
    }
}

TEST(MooneyRivlin, FitsATensionTest)
{
    Model model;
    NamedCurve test;
    test.id = 7;
    const double gauge = 25, width = 6, thickness = 2, a = 0.4, b = 0.15;
    for (int i = 0; i <= 10; ++i) {
        const double change = 5.0 * i, s = 1 + change / gauge;
        test.curve.abscissa.push_back(change);
        test.curve.ordinate.push_back(2 * (s - 1 / (s * s)) * (a + b / s) * width * thickness);
    }
    model.curves.push_back(test);
    const auto law = MooneyRivlin::from_record(
        record_of(
            "MAT_MOONEY-RIVLIN_RUBBER", 1,
            {{"RO", 1e-9}, {"PR", 0.49}, {"SGL", gauge}, {"SW", width}, {"ST", thickness}, {"LCID", 7}}),
        model);
    EXPECT_NEAR(law.a, a, 1e-10);
    EXPECT_NEAR(law.b, b, 1e-10);
}

TEST(MooneyRivlin, LanesEqualTheScalarReference)
{
    const MooneyRivlin law = rubber();
    Tensor3<Lanes> f{};
    for (int lane = 0; lane < lane_count; ++lane) {
        f.xx[lane] = 1 + 0.1 * lane;
        f.yy[lane] = 1 - 0.05 * lane;
        f.zz[lane] = 1.02;
        f.xy[lane] = 0.3 - 0.1 * lane;
        f.zx[lane] = 0.05 * lane;
    }
    const auto stress = law.stress(f);
    const Lanes modulus = law.wave_modulus(f);
    for (int lane = 0; lane < lane_count; ++lane) {
        const Tensor3<double> one{f.xx[lane], f.xy[lane], 0, 0, f.yy[lane], 0, f.zx[lane], 0, f.zz[lane]};
        const auto reference = law.stress(one);
        EXPECT_NEAR(stress.xx[lane], reference.xx, 1e-16); // round-off of stresses up to 0.1
        EXPECT_NEAR(stress.zx[lane], reference.zx, 1e-16);
        EXPECT_NEAR(modulus[lane], law.wave_modulus(one), 1e-15);
    }
}

} // namespace plash
