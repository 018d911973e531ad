#include "materials/blatz_ko.h"
#include "materials/rubber.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

constexpr int branches = most_rubber_branches;

/// Ogden's fit to Treloar's rubber (Ogden 1972): mu 0.63, 0.0012, -0.01 MPa; alpha 1.3, 5, -2.
Rubber<OgdenEnergy, branches> treloar(double nu)
{
    return ogden_rubber(make_record("MAT_OGDEN_RUBBER", {{"RO", 1e-9},
                                                         {"PR", nu},
                                                         {"MU1", 0.63},
                                                         {"MU2", 0.0012},
                                                         {"MU3", -0.01},
                                                         {"ALPHA1", 1.3},
                                                         {"ALPHA2", 5},
                                                         {"ALPHA3", -2}}));
}

Rubber<PolynomialEnergy, branches> polynomial(double nu)
{
    return polynomial_rubber(make_record("MAT_HYPERELASTIC_RUBBER", {{"RO", 1e-9},
                                                                     {"PR", nu},
                                                                     {"C10", 0.18},
                                                                     {"C01", 0.02},
                                                                     {"C11", 0.003},
                                                                     {"C20", -0.002},
                                                                     {"C02", 0.001},
                                                                     {"C30", 0.0005}}),
                             Model{});
}

/// Nominal stress of a bar that is stretched, its sides free; the lateral stretch by bisection.
template <class Stress>
double nominal_stress(double s, Stress&& stress)
{
    double low = 0.05, high = 5, lateral = 1;
    for (int i = 0; i < 200; ++i) {
        lateral = 0.5 * (low + high);
        (stress(Tensor3<double>{s, 0, 0, 0, lateral, 0, 0, 0, lateral}).yy > 0 ? high : low) = lateral;
    }
    return stress(Tensor3<double>{s, 0, 0, 0, lateral, 0, 0, 0, lateral}).xx * lateral * lateral;
}

/// dW/dF of an energy by central differences, as Cauchy stress dW/dF F^T / J.
template <class Energy>
Tensor3<double> differenced_stress(const Tensor3<double>& f, Energy&& energy)
{
    const double h = 1e-6;
    double p[9];
    double Tensor3<double>::*const parts[9] = {
        &Tensor3<double>::xx, &Tensor3<double>::xy, &Tensor3<double>::xz,
        &Tensor3<double>::yx, &Tensor3<double>::yy, &Tensor3<double>::yz,
        &Tensor3<double>::zx, &Tensor3<double>::zy, &Tensor3<double>::zz};
    for (int i = 0; i < 9; ++i) {
        Tensor3<double> more = f, less = f;
        more.*parts[i] += h;
        less.*parts[i] -= h;
        p[i] = (energy(more) - energy(less)) / (2 * h);
    }
    const Tensor3<double> nominal{p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8]};
    const Tensor3<double> transposed{f.xx, f.yx, f.zx, f.xy, f.yy, f.zy, f.xz, f.yz, f.zz};
    return (1 / determinant(f)) * (nominal * transposed);
}

const Tensor3<double> general{1.2, 0.3, -0.1, 0.05, 0.8, 0.2, -0.15, 0.1, 1.1};

void expect_equal(const SymmetricTensor<double>& a, const Tensor3<double>& b, double tolerance)
{
    EXPECT_NEAR(a.xx, b.xx, tolerance);
    EXPECT_NEAR(a.yy, b.yy, tolerance);
    EXPECT_NEAR(a.zz, b.zz, tolerance);
    EXPECT_NEAR(a.xy, b.xy, tolerance);
    EXPECT_NEAR(a.yz, b.yz, tolerance);
    EXPECT_NEAR(a.zx, b.zx, tolerance);
    EXPECT_NEAR(b.xy, b.yx, tolerance); // the energy is isotropic
}

double polynomial_energy(const Rubber<PolynomialEnergy, branches>& law, const Tensor3<double>& f)
{
    const auto i = left_cauchy_green(f);
    const double j = std::sqrt(i.third), a = i.first / std::cbrt(i.third) - 3,
                 b = i.second / std::pow(i.third, 2.0 / 3) - 3;
    const PolynomialEnergy& c = law.energy;
    return c.c10 * a + c.c01 * b + c.c11 * a * b + c.c20 * a * a + c.c02 * b * b + c.c30 * a * a * a +
           law.bulk_modulus * (j - 1 - std::log(j));
}

double ogden_energy(const Rubber<OgdenEnergy, branches>& law, const Tensor3<double>& f)
{
    const auto axes = principal_axes(left_cauchy_green(f).left);
    const double j = determinant(f);
    double w = law.bulk_modulus * (j - 1 - std::log(j));
    for (int k = 0; k < law.energy.terms; ++k) {
        for (double square : axes.value) {
            w += law.energy.mu[k] / law.energy.alpha[k] *
                 (std::pow(std::sqrt(square) / std::cbrt(j), law.energy.alpha[k]) - 1);
        }
    }
    return w;
}

} // namespace

/// Nominal stress of an incompressible bar: sum of mu (s^(alpha - 1) - s^(-alpha / 2 - 1)); PR = 0.499999
/// leaves a difference of order (1 - 2 nu) times the stretch.
TEST(OgdenRubber, StretchedAndPressedIsTheTextbookCurve)
{
    const auto law = treloar(0.499999);
    EXPECT_NEAR(law.energy.shear_modulus(), 0.5 * (0.63 * 1.3 + 0.0012 * 5 + 0.01 * 2), 1e-15);
    for (double s : {0.5, 0.8, 1.5, 4.0, 6.0}) {
        double expected = 0;
        for (const auto& [mu, alpha] : {std::pair{0.63, 1.3}, {0.0012, 5.0}, {-0.01, -2.0}}) {
            expected += mu * (std::pow(s, alpha - 1) - std::pow(s, -alpha / 2 - 1));
        }
        const double found =
            nominal_stress(s, [&](const Tensor3<double>& f) { return law.elastic_stress(law.stretches(f)); });
        EXPECT_NEAR(found, expected, 2e-4 * std::abs(expected)) << s;
    }
}

TEST(OgdenRubber, ShearAndVolumeAreTheDerivativeOfTheEnergy)
{
    const auto law = treloar(0.45);
    const auto energy = [&](const Tensor3<double>& f) { return ogden_energy(law, f); };
    expect_equal(law.elastic_stress(law.stretches(general)), differenced_stress(general, energy), 1e-8);
    const Tensor3<double> shear{1, 0.7, 0, 0, 1, 0, 0, 0, 1};
    expect_equal(law.elastic_stress(law.stretches(shear)), differenced_stress(shear, energy), 1e-8);
    const Tensor3<double> swollen{1.2, 0, 0, 0, 1.2, 0, 0, 0, 1.2};
    EXPECT_NEAR(law.elastic_stress(law.stretches(swollen)).xx, law.bulk_modulus * (1 - 1 / 1.728), 1e-14);
}

TEST(HyperelasticRubber, StressIsTheDerivativeOfTheEnergy)
{
    const auto law = polynomial(0.47);
    const auto energy = [&](const Tensor3<double>& f) { return polynomial_energy(law, f); };
    expect_equal(law.elastic_stress(law.stretches(general)), differenced_stress(general, energy), 1e-8);
    const Tensor3<double> shear{1, 0.7, 0, 0, 1, 0, 0, 0, 1};
    expect_equal(law.elastic_stress(law.stretches(shear)), differenced_stress(shear, energy), 1e-8);
}

/// Two constants are Mooney's rubber: nominal stress 2 (s - s^-2) (C10 + C01 / s).
TEST(HyperelasticRubber, WithTwoConstantsIsMooneysRubber)
{
    auto law = polynomial(0.49999);
    law.energy.c11 = law.energy.c20 = law.energy.c02 = law.energy.c30 = 0;
    for (double s : {0.6, 1.3, 2.5}) {
        const double expected = 2 * (s - 1 / (s * s)) * (0.18 + 0.02 / s);
        const double found =
            nominal_stress(s, [&](const Tensor3<double>& f) { return law.elastic_stress(law.stretches(f)); });
        EXPECT_NEAR(found, expected, 2e-4 * std::abs(expected)) << s;
    }
}

/// A test that the law itself could have made gives its constants back, for each kind of test.
TEST(HyperelasticRubber, FitsATest)
{
    const double c[3] = {0.18, 0.02, 0.003}; // C10, C01, C11
    for (int kind = 1; kind <= 3; ++kind) {
        Model model;
        NamedCurve test;
        test.id = 7;
        const double gauge = 20, area = 3 * 2;
        for (double s = 0.6; s < 2.5; s += 0.1) {
            // W of the incompressible test by its stretch, differentiated.
            const auto energy = [&](double t) {
                const double side = kind == 1 ? 1 / std::sqrt(t) : kind == 2 ? t : 1;
                const double third = 1 / (t * side);
                const double i = t * t + side * side + third * third - 3;
                const double ii = 1 / (t * t) + 1 / (side * side) + 1 / (third * third) - 3;
                return (c[0] * i + c[1] * ii + c[2] * i * ii) / (kind == 2 ? 2 : 1);
            };
            test.curve.abscissa.push_back((s - 1) * gauge);
            test.curve.ordinate.push_back((energy(s + 1e-6) - energy(s - 1e-6)) / 2e-6 * area);
        }
        model.curves.push_back(test);
        const auto fields = [&](double data) {
            return make_record("MAT_HYPERELASTIC_RUBBER", {{"RO", 1e-9},
                                                           {"PR", 0.49},
                                                           {"N", data == 3 ? 1.0 : 3.0},
                                                           {"SGL", gauge},
                                                           {"SW", 3},
                                                           {"ST", 2},
                                                           {"LCID1", 7},
                                                           {"DATA", data}});
        };
        if (kind == 3) { // both invariants are equal in pure shear, so that only one constant can be found
            EXPECT_THROW(polynomial_rubber(make_record("MAT_HYPERELASTIC_RUBBER", {{"RO", 1e-9},
                                                                                   {"PR", 0.49},
                                                                                   {"N", 2},
                                                                                   {"SGL", gauge},
                                                                                   {"SW", 3},
                                                                                   {"ST", 2},
                                                                                   {"LCID1", 7},
                                                                                   {"DATA", 3}}),
                                           model),
                         DeckError);
            continue;
        }
        const auto law = polynomial_rubber(fields(kind), model);
        EXPECT_NEAR(law.energy.c10, c[0], 1e-7) << kind;
        EXPECT_NEAR(law.energy.c01, c[1], 1e-7) << kind;
        EXPECT_NEAR(law.energy.c11, c[2], 1e-7) << kind;
    }
}

/// A stretched and held rubber with a Prony series: the elastic stress and 2 G e exp(-beta t) besides.
TEST(OgdenRubber, SeriesRelaxes)
{
    Record record =
        make_record("MAT_OGDEN_RUBBER", {{"RO", 1e-9}, {"PR", 0.49}, {"MU1", 0.6}, {"ALPHA1", 2}});
    record.tables.push_back(
        {{"GI", "BETAI", "VFLAG"}, {0.2, 3, 0, 0.1, 0, 0, 0, 0, 0}, {}, {1, 2, 3}, false});
    const auto law = ogden_rubber(record);
    double history[36] = {};
    SymmetricTensor<double> stress{};
    const double shear = 1e-3;
    const Tensor3<double> f{1, shear, 0, 0, 1, 0, 0, 0, 1};
    law.update(stress, law.stretches(f), SymmetricTensor<double>{0, 0, 0, 0.5 * shear, 0, 0},
               HistoryView<double>{history}, 1e-9);
    EXPECT_NEAR(stress.xy, (0.6 + 0.2 + 0.1) * shear, 1e-10);
    law.update(stress, law.stretches(f), SymmetricTensor<double>{}, HistoryView<double>{history}, 0.5);
    EXPECT_NEAR(stress.xy, (0.6 + 0.1 + 0.2 * std::exp(-1.5)) * shear, 1e-10);
    record.tables[0].values[2] = 1; // VFLAG
    EXPECT_THROW(ogden_rubber(record), DeckError);
}

/// c^2 rho of small longitudinal waves on top of a stretch, by differences: dP/dF of each direction times F^2
/// / J; the fastest counts.
TEST(Rubber, WaveModulusIsThatOfTheEnergy)
{
    const Tensor3<double> f{1.4, 0, 0, 0, 0.9, 0, 0, 0, 0.85};
    const double volume = determinant(f);
    const auto from = [&](auto&& stress) {
        double fastest = 0;
        for (const auto& [side, normal] : {std::pair{&Tensor3<double>::xx, &SymmetricTensor<double>::xx},
                                           {&Tensor3<double>::yy, &SymmetricTensor<double>::yy},
                                           {&Tensor3<double>::zz, &SymmetricTensor<double>::zz}}) {
            const auto nominal = [&](double x) {
                Tensor3<double> g = f;
                g.*side = x;
                return stress(g).*normal * volume / f.*side;
            };
            const double x = f.*side;
            fastest = std::max(fastest, (nominal(x + 1e-6) - nominal(x - 1e-6)) / 2e-6 * x * x / volume);
        }
        return fastest;
    };
    const auto ogden = treloar(0.45);
    EXPECT_NEAR(ogden.wave_modulus(ogden.stretches(f)),
                from([&](const auto& g) { return ogden.elastic_stress(ogden.stretches(g)); }), 1e-5);
    const auto hyper = polynomial(0.45);
    EXPECT_NEAR(hyper.wave_modulus(hyper.stretches(f)),
                from([&](const auto& g) { return hyper.elastic_stress(hyper.stretches(g)); }), 1e-5);
    BlatzKo blatz;
    blatz.shear_modulus = 1;
    EXPECT_NEAR(blatz.wave_modulus(f), from([&](const auto& g) { return blatz.stress(g); }), 1e-5);
}

TEST(BlatzKoRubber, StressIsTheDerivativeOfTheEnergyAndHasItsModuli)
{
    const auto law =
        BlatzKo::from_record(make_record("MAT_BLATZ-KO_RUBBER", {{"RO", 1e-9}, {"G", 0.7}}), Model{});
    expect_equal(law.stress(general),
                 differenced_stress(general, [&](const auto& f) { return law.energy(f); }), 1e-8);
    // Small strains: Hooke's law with G and nu = 0.463.
    const double e = 1e-7, lame = 2 * 0.7 * 0.463 / (1 - 2 * 0.463);
    const auto pulled = law.stress(Tensor3<double>{1 + e, 0, 0, 0, 1, 0, 0, 0, 1});
    EXPECT_NEAR(pulled.xx / e, lame + 1.4, 1e-4);
    EXPECT_NEAR(pulled.yy / e, lame, 1e-4);
    EXPECT_NEAR(law.stress(Tensor3<double>{1, e, 0, 0, 1, 0, 0, 0, 1}).xy / e, 0.7, 1e-6);
}

TEST(Rubber, LanesEqualTheScalarReference)
{
    const auto law = treloar(0.48);
    Tensor3<Lanes> f;
    for (int lane = 0; lane < lane_count; ++lane) {
        const double a = 0.1 * lane;
        f.xx[lane] = 1 + a;
        f.yy[lane] = 1;
        f.zz[lane] = 1 - 0.5 * a;
        f.xy[lane] = lane == 0 ? 0 : 0.1;
        f.zx[lane] = -a;
    }
    const SymmetricTensor<Lanes> all = law.elastic_stress(law.stretches(f));
    for (int lane = 0; lane < lane_count; ++lane) {
        const auto one = law.elastic_stress(law.stretches(
            Tensor3<double>{f.xx[lane], f.xy[lane], 0, 0, f.yy[lane], 0, f.zx[lane], 0, f.zz[lane]}));
        EXPECT_NEAR(all.xx[lane], one.xx, 1e-13) << lane;
        EXPECT_NEAR(all.zx[lane], one.zx, 1e-13) << lane;
    }
    EXPECT_NEAR(all.xx[0], 0, 1e-14);
}

} // namespace plash
