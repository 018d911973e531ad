#include "elements/solid_groups.h"
#include "materials/orthotropic_elastic.h"
#include "tests/support/records.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

constexpr double ea = 10, eb = 2, ec = 1, ba = 0.06, ca = 0.03, cb = 0.25, ab = 0.8, bc = 0.3, gca = 0.5;

std::vector<std::pair<const char*, double>> card(std::vector<std::pair<const char*, double>> more = {})
{
    std::vector<std::pair<const char*, double>> fields{{"RO", 1e-6}, {"EA", ea},   {"EB", eb},   {"EC", ec},
                                                       {"PRBA", ba}, {"PRCA", ca}, {"PRCB", cb}, {"GAB", ab},
                                                       {"GBC", bc},  {"GCA", gca}};
    fields.insert(fields.end(), more.begin(), more.end());
    return fields;
}

OrthotropicElasticSolid orthotropic_law(std::vector<std::pair<const char*, double>> more = {})
{
    return OrthotropicElasticSolid::from_record(make_record("MAT_ORTHOTROPIC_ELASTIC", card(std::move(more))),
                                                Model{});
}

/// Cauchy stress of a deformation, with axis a turned from x by an angle about z.
SymmetricTensor<double> stress_of(const Tensor3<double>& f, double angle = 0)
{
    double history[] = {std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle), 0};
    SymmetricTensor<double> stress{};
    orthotropic_law().update(stress, f, SymmetricTensor<double>{}, HistoryView<double>{history}, 1.0);
    return stress;
}

Tensor3<double> about_z(double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {c, -s, 0, s, c, 0, 0, 0, 1};
}

void expect_equal(const SymmetricTensor<double>& a, const SymmetricTensor<double>& b, double tolerance)
{
    EXPECT_NEAR(a.xx, b.xx, tolerance);
    EXPECT_NEAR(a.yy, b.yy, tolerance);
    EXPECT_NEAR(a.zz, b.zz, tolerance);
    EXPECT_NEAR(a.xy, b.xy, tolerance);
    EXPECT_NEAR(a.yz, b.yz, tolerance);
    EXPECT_NEAR(a.zx, b.zx, tolerance);
}

} // namespace

/// The compliances of the card, by hand: pulled along one axis, sheared, and under equal pressure.
TEST(OrthotropicSolid, SmallStrainsAreThoseOfTheEngineeringConstants)
{
    const double s = 1e-7;
    const auto strained = [](double x, double y, double z) {
        return Tensor3<double>{1 + x, 0, 0, 0, 1 + y, 0, 0, 0, 1 + z};
    };
    const double of_b = ba / eb, of_c = ca / ec, bc_pair = cb / ec;
    expect_equal(stress_of(strained(s / ea, -of_b * s, -of_c * s)), {s, 0, 0, 0, 0, 0}, 1e-6 * s);
    expect_equal(stress_of(strained(-of_b * s, s / eb, -bc_pair * s)), {0, s, 0, 0, 0, 0}, 1e-6 * s);
    expect_equal(stress_of(strained(-of_c * s, -bc_pair * s, s / ec)), {0, 0, s, 0, 0, 0}, 1e-6 * s);
    expect_equal(stress_of(strained(-s * (1 / ea - of_b - of_c), -s * (1 / eb - of_b - bc_pair),
                                    -s * (1 / ec - of_c - bc_pair))),
                 {-s, -s, -s, 0, 0, 0}, 1e-6 * s);
    expect_equal(stress_of({1, s, 0, 0, 1, s, s, 0, 1}), {0, 0, 0, ab * s, bc * s, gca * s}, 1e-6 * s);
}

/// Off the axes: the modulus along x of fibres at an angle (Jones 1975, eq. 2.97).
TEST(OrthotropicSolid, FibresAtAnAngleHaveTheModulusOfTheirDirection)
{
    const double angle = 0.5, c = std::cos(angle), s = std::sin(angle), size = 1e-7;
    const double modulus =
        1 / (std::pow(c, 4) / ea + std::pow(s, 4) / eb + (1 / ab - 2 * ba / eb) * c * c * s * s);
    // The strains of the stress {size} along x, turned from the axes: e_a = c^2/EA - s^2 ba/EB, ...
    const double e_a = c * c / ea - s * s * ba / eb, e_b = s * s / eb - c * c * ba / eb;
    const double g_ab = -2 * c * s / (2 * ab), e_c = -c * c * ca / ec - s * s * cb / ec;
    const SymmetricTensor<double> strain =
        rotated(SymmetricTensor<double>{e_a, e_b, e_c, 0.5 * g_ab, 0, 0}, about_z(angle));
    EXPECT_NEAR(strain.xx, 1 / modulus, 1e-15);
    const Tensor3<double> f{
        1 + size * strain.xx, size * strain.xy, 0, size * strain.xy, 1 + size * strain.yy, 0, 0, 0,
        1 + size * strain.zz};
    expect_equal(stress_of(f, angle), {size, 0, 0, 0, 0, 0}, 1e-6 * size);
}

/// The fastest wave at the start runs along a, with the stiffness of a bar that cannot bulge.
TEST(OrthotropicSolid, WavesRunWithTheStiffnessOfTheStrongAxis)
{
    const double p = -ba / eb, q = -ca / ec, r = -cb / ec;
    const double stiffest =
        1 / (1 / ea - (p * p / ec - 2 * p * q * r + q * q / eb) / (1 / (eb * ec) - r * r));
    EXPECT_NEAR(orthotropic_law().wave_modulus(Tensor3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}), stiffest, 1e-12);
}

/// Pulled to twice its length along b without lateral strain: S = C E with E = 3/2, Cauchy = 2^2 S / 2; and
/// turned as a whole, the stress turns along.
TEST(OrthotropicSolid, LargeStrainsAreGreensAndTurnExactly)
{
    const double a = 1 / ea, b = 1 / eb, c = 1 / ec, p = -ba / eb, q = -ca / ec, r = -cb / ec;
    const double determinant = a * (b * c - r * r) - p * (p * c - r * q) + q * (p * r - b * q);
    const auto stress = stress_of({1, 0, 0, 0, 2, 0, 0, 0, 1});
    EXPECT_NEAR(stress.yy, 2 * 1.5 * (a * c - q * q) / determinant, 1e-13);
    EXPECT_NEAR(stress.xx, 0.5 * 1.5 * (q * r - p * c) / determinant, 1e-13);
    const Tensor3<double> f{1.1, 0.2, 0, -0.1, 0.9, 0.3, 0, 0.1, 1.2}, turn = about_z(1.9);
    expect_equal(stress_of(turn * f, 0.4), rotated(stress_of(f, 0.4), turn), 1e-13);
}

/// A cube in a group, stretched along x.
TEST(OrthotropicSolid, ElementsTakeTheirAxesFromTheCardOrTheirNodes)
{
    const double a = 1 / ea, b = 1 / eb, c = 1 / ec, p = -ba / eb, q = -ca / ec, r = -cb / ec;
    const double determinant = a * (b * c - r * r) - p * (p * c - r * q) + q * (p * r - b * q);
    for (const double option : {0, 2}) {
        auto fields = card({{"AOPT", option}, {"A2", 1}, {"D1", -1}});
        Record material = make_record("MAT_ORTHOTROPIC_ELASTIC", std::move(fields));
        material.id = 5;
        testing::SolidBlock block({1, 1, 1}, {1, 1, 1}, material);
        State state = block.state();
        auto groups = make_solid_groups(block.model, state);
        Clock clock;
        clock.last_step = 1;
        for (std::size_t n = 0; n < state.size(); ++n) {
            state.velocity[n] = {1e-7 * block.model.nodes.position[n].x, 0, 0};
            state.position[n] += state.velocity[n];
        }
        for (auto& group : groups) group->add_forces(clock, state);
        ElementResults results;
        results.solid_stress.resize(1);
        groups[0]->collect(state, results);
        // Along x lies a (nodes 1 to 2), or -b of the card's vectors.
        const double along = option == 0 ? b * c - r * r : a * c - q * q;
        EXPECT_NEAR(results.solid_stress[0].xx, 1e-7 * along / determinant, 1e-12);
    }
}

} // namespace plash
