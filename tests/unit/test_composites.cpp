#include "elements/shell_laminate.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <random>

#include <cmath>
#include <numbers>

namespace plash {

namespace {

using Fields = std::vector<std::pair<const char*, double>>;

/// Carbon and epoxy in MPa, as in the wing of the SPH bird deck.
Fields carbon(Fields more = {})
{
    Fields fields{{"RO", 1.49e-9}, {"EA", 121000}, {"EB", 8600},  {"PRBA", 0.0191901},
                  {"GAB", 4700},   {"GBC", 3100},  {"GCA", 4700}, {"XC", 1082},
                  {"XT", 2231},    {"YC", 100},    {"YT", 29},    {"SC", 60}};
    fields.insert(fields.end(), more.begin(), more.end());
    return fields;
}

/// One ply point, driven by strains in its own axes.
template <class Law>
struct Ply {
    Law law;
    SymmetricTensor<double> stress{};
    std::array<double, Law::history_size + 1> history{};

    explicit Ply(Law its) : law(std::move(its))
    {
        const auto start = law.initial_history();
        std::copy(start.begin(), start.end(), history.begin());
    }

    void strain(double a, double b, double twice_ab, int steps = 1)
    {
        for (int i = 0; i < steps; ++i) {
            SymmetricTensor<double> increment{a / steps, b / steps, 0, 0.5 * twice_ab / steps, 0, 0};
            law.update_plane_stress(stress, increment, HistoryView<double>{history.data()}, 1);
        }
    }
    bool gone() { return law.failed(HistoryView<double>{history.data()}); }
};

Ply<CompositeDamage> chang(Fields more = {})
{
    return Ply(
        CompositeDamage::from_record(make_record("MAT_ENHANCED_COMPOSITE_DAMAGE", carbon(more)), Model{}));
}

} // namespace

TEST(OrthotropicPly, HasItsModuliAlongItsAxes)
{
    const auto law =
        OrthotropicElastic::from_record(make_record("MAT_ORTHOTROPIC_ELASTIC", carbon()), Model{});
    Ply ply(law);
    // Pulled along a with free b: strain_b = -nu_ab strain_a with nu_ab = nu_ba EA / EB.
    ply.strain(1e-3, -0.0191901 * 121000 / 8600 * 1e-3, 0);
    EXPECT_NEAR(ply.stress.xx, 121, 1e-9);
    EXPECT_NEAR(ply.stress.yy, 0, 1e-9);
    Ply across(law);
    across.strain(-0.0191901 * 1e-3, 1e-3, 2e-3);
    EXPECT_NEAR(across.stress.xx, 0, 1e-9);
    EXPECT_NEAR(across.stress.yy, 8.6, 1e-9);
    EXPECT_NEAR(across.stress.xy, 9.4, 1e-9);
}

TEST(LaminatePly, TurnsItsStiffness)
{
    // Reduced stiffness of a ply at an angle (Jones 1999, Mechanics of Composite Materials, eq. 2.80).
    const auto law =
        OrthotropicElastic::from_record(make_record("MAT_ORTHOTROPIC_ELASTIC", carbon()), Model{});
    const double angle = 0.5, c = std::cos(angle), s = std::sin(angle);
    const double q11 = law.plane.plane_a(), q22 = law.plane.plane_b(), q12 = law.plane.plane_ab(),
                 q66 = law.plane.gab;
    const double bar11 = q11 * std::pow(c, 4) + 2 * (q12 + 2 * q66) * s * s * c * c + q22 * std::pow(s, 4);
    const double bar12 = (q11 + q22 - 4 * q66) * s * s * c * c + q12 * (std::pow(s, 4) + std::pow(c, 4));
    const double bar16 = (q11 - q12 - 2 * q66) * s * c * c * c + (q12 - q22 + 2 * q66) * s * s * s * c;
    const Laminate laminate{{law}};
    std::array<double, Laminate::history_size> history{};
    history[Laminate::ply_cosine] = c;
    history[Laminate::ply_sine] = s;
    SymmetricTensor<double> stress{}, strain{1e-3, 0, 0, 0, 0, 0};
    laminate.update_ply(0, stress, strain, HistoryView<double>{history.data()}, 1);
    EXPECT_NEAR(stress.xx, 1e-3 * bar11, 1e-10);
    EXPECT_NEAR(stress.yy, 1e-3 * bar12, 1e-10);
    EXPECT_NEAR(stress.xy, 1e-3 * bar16, 1e-10);
}

TEST(CompositeDamage, FibersBreakInTensionAndHoldTheirStrengthInCompression)
{
    auto pulled = chang();
    double largest = 0;
    for (int i = 0; i < 400 && !pulled.gone(); ++i) {
        pulled.strain(1e-4, 0, 0);
        largest = std::max(largest, pulled.stress.xx);
    }
    EXPECT_TRUE(pulled.gone());
    EXPECT_EQ(pulled.stress.xx, 0);
    // The last stress before 2231; a step adds 12.
    EXPECT_GT(largest, 2231 - 12.5);
    EXPECT_LT(largest, 2231);

    // Without a matrix that fails first, compression stops at XC and stays there.
    auto pressed = chang();
    pressed.law.yt = pressed.law.yc = pressed.law.sc = 0;
    pressed.strain(-0.02, 0, 0, 2000);
    EXPECT_FALSE(pressed.gone());
    EXPECT_NEAR(pressed.stress.xx, -1082, 2);
}

TEST(CompositeDamage, TheMatrixStaysAtItsStrength)
{
    auto pulled = chang();
    pulled.strain(0, 0.01, 0, 10000); // 8.6 kPa a step
    EXPECT_NEAR(pulled.stress.yy, 29, 0.01);
    auto pressed = chang();
    pressed.strain(0, -0.05, 0, 10000);
    EXPECT_NEAR(pressed.stress.yy, -100, 0.05);
    auto sheared = chang();
    sheared.strain(0, 0, 0.05, 10000);
    EXPECT_NEAR(sheared.stress.xy, 60, 0.03);
    // Tsai-Wu under transverse stress alone ends at both strengths, too.
    auto wu = chang({{"CRIT", 55}});
    wu.strain(0, -0.05, 0, 10000);
    EXPECT_NEAR(wu.stress.yy, -100, 0.05);
}

/// Stress of a failed matrix lies inside the criterion wherever the strain goes, and unloads elastically.
TEST(CompositeDamage, TheMatrixKeepsToItsCriterion)
{
    auto ply = chang({{"DFAILT", 1}});
    std::mt19937 random(3);
    const auto draw = [&] { return random() / 2147483648.0 - 1.0; };
    double largest = 0;
    for (int i = 0; i < 2000; ++i) {
        ply.strain(0, 0.002 * draw(), 0.004 * draw(), 10);
        const double b = ply.stress.yy, shear = ply.stress.xy * ply.stress.xy / 3600;
        const double index =
            b >= 0 ? b * b / (29 * 29.0) + shear
                   : b * b / (120 * 120.0) + (100.0 / 120 * (100.0 / 120) - 1) * b / 100 + shear;
        largest = std::max(largest, index);
    }
    EXPECT_LE(largest, 1 + 1e-12);
    EXPECT_GT(largest, 1 - 1e-12);
    auto back = chang();
    back.strain(0, -0.02, 0, 1000);
    back.strain(0, 0.005, 0, 10);
    EXPECT_NEAR(back.stress.yy, -100 + 43, 0.01);
}

/// XC becomes YCFAC YC when the matrix has failed in compression, not when it has failed in tension; 0
/// means 2.
TEST(CompositeDamage, FibersLoseStrengthWithACrushedMatrix)
{
    for (double factor : {0.0, 3.0}) {
        auto crushed = chang({{"YCFAC", factor}});
        crushed.strain(0, -0.02, 0, 1000);
        crushed.strain(-0.02, 0, 0, 1000);
        EXPECT_NEAR(crushed.stress.xx, factor > 0 ? -300 : -200, 1e-9);
    }
    auto torn = chang();
    torn.strain(0, 0.02, 0, 1000);
    torn.strain(-0.02, 0, 0, 1000);
    EXPECT_NEAR(torn.stress.xx, -1082, 1e-9);
}

/// However a broken ply is strained, it takes energy and gives none.
TEST(CompositeDamage, FailedPliesGiveNoEnergy)
{
    auto ply = chang({{"DFAILT", 1}}); // fibres that tear do not take the ply away
    std::mt19937 random(11);
    const auto draw = [&] { return random() / 2147483648.0 - 1.0; };
    double work = 0, lowest = 0;
    SymmetricTensor<double> strain{};
    for (int i = 0; i < 500; ++i) {
        // Random ways between places within 5 %, in compression along the fibres so that they do not tear.
        const double a = -0.025 + 0.025 * draw() - strain.xx, b = 0.05 * draw() - strain.yy,
                     ab = 0.05 * draw() - strain.xy;
        strain = {strain.xx + a, strain.yy + b, 0, strain.xy + ab, 0, 0};
        constexpr int steps = 50;
        for (int step = 0; step < steps; ++step) {
            const SymmetricTensor<double> old = ply.stress;
            ply.strain(a / steps, b / steps, ab / steps);
            work += 0.5 *
                    ((old.xx + ply.stress.xx) * a + (old.yy + ply.stress.yy) * b +
                     (old.xy + ply.stress.xy) * ab) /
                    steps;
        }
        lowest = std::min(lowest, work);
    }
    EXPECT_FALSE(ply.gone());
    EXPECT_GT(work, 0);
    EXPECT_GE(lowest, -1e-9);
}

TEST(CompositeDamage, StrainLimitsTakeThePlyAway)
{
    auto ply = chang({{"DFAILT", 0.025}});
    ply.strain(0.024, 0, 0, 240);
    EXPECT_FALSE(ply.gone());
    EXPECT_NEAR(ply.stress.xx, 2231, 13);
    ply.strain(0.002, 0, 0, 20);
    EXPECT_TRUE(ply.gone());
    EXPECT_EQ(ply.stress.xx, 0);
}

TEST(LaminatedFabric, ReachesItsStrengthAtItsStrain)
{
    const Record record = make_record("MAT_LAMINATED_COMPOSITE_FABRIC", {{"RO", 1.4e-9},
                                                                         {"EA", 60000},
                                                                         {"EB", 60000},
                                                                         {"PRBA", 0},
                                                                         {"GAB", 3300},
                                                                         {"GBC", 2700},
                                                                         {"GCA", 2700},
                                                                         {"FS", -1},
                                                                         {"E11T", 0.02},
                                                                         {"E11C", 0.02},
                                                                         {"E22T", 0.02},
                                                                         {"E22C", 0.02},
                                                                         {"GMS", 0.1},
                                                                         {"XT", 800},
                                                                         {"XC", 500},
                                                                         {"YT", 800},
                                                                         {"YC", 500},
                                                                         {"SC", 120}});
    const auto law = LaminatedFabric::from_record(record, Model{});
    Ply ply(law);
    double largest = 0, at = 0;
    for (int i = 1; i <= 400; ++i) {
        ply.strain(1e-4, 0, 0);
        if (ply.stress.xx > largest) {
            largest = ply.stress.xx;
            at = i * 1e-4;
        }
    }
    EXPECT_NEAR(largest, 800, 0.1);
    EXPECT_NEAR(at, 0.02, 1e-4);
    // The closed form behind the peak, and unloading along the secant.
    const double m = 1 / std::log(60000 * 0.02 / 800), ratio = 0.04 * 60000 / 800;
    const double left = std::exp(-std::pow(ratio, m) / (m * std::numbers::e));
    EXPECT_NEAR(ply.stress.xx, 60000 * 0.04 * left, 1e-6 * 800);
    ply.strain(-0.02, 0, 0);
    EXPECT_NEAR(ply.stress.xx, 60000 * 0.02 * left, 1e-6 * 800);
    // Compression has a damage of its own, which has only begun.
    ply.strain(-0.0201, 0, 0);
    const double mc = 1 / std::log(60000 * 0.02 / 500), begun = 1e-4 * 60000 / 500;
    EXPECT_NEAR(ply.stress.xx, -6 * std::exp(-std::pow(begun, mc) / (mc * std::numbers::e)), 1e-6);
    Ply sheared(law);
    sheared.strain(0, 0, 0.1, 1000);
    EXPECT_NEAR(sheared.stress.xy, 120, 1e-6 * 120);
}

/// Strengths beyond the elastic line, as the woven plies of a wing have them: straight up to the strength,
/// then nothing, from the smallest strain on.
TEST(LaminatedFabric, BrittlePliesStartElasticAndBreakAtTheirStrength)
{
    const Record record = make_record("MAT_LAMINATED_COMPOSITE_FABRIC", {{"RO", 1.42e-9},
                                                                         {"EA", 61340},
                                                                         {"EB", 61340},
                                                                         {"PRBA", 0},
                                                                         {"GAB", 3300},
                                                                         {"GBC", 2700},
                                                                         {"GCA", 2700},
                                                                         {"FS", -1},
                                                                         {"E11T", 0.0126},
                                                                         {"E11C", 0.0102},
                                                                         {"E22T", 0.0126},
                                                                         {"E22C", 0.0102},
                                                                         {"GMS", 0.022},
                                                                         {"XT", 805},
                                                                         {"XC", 509},
                                                                         {"YT", 805},
                                                                         {"YC", 509},
                                                                         {"SC", 125}});
    const auto law = LaminatedFabric::from_record(record, Model{});
    Ply ply(law);
    ply.strain(0, 0, 1e-12);
    EXPECT_NEAR(ply.stress.xy, 3300e-12, 1e-12 * 3300e-12);
    EXPECT_EQ(ply.stress.xx, 0);
    ply.strain(1e-30, 0, 0);
    EXPECT_NEAR(ply.stress.xx, 61340e-30, 1e-12 * 61340e-30);
    // Exponent 100: exp(-(E eps / X)^100 / (100 e)).
    const auto left = [](double strain) {
        return std::exp(-std::pow(61340 * strain / 805, 100) / (100 * std::numbers::e));
    };
    ply.strain(0.0130, 0, 0, 100);
    EXPECT_NEAR(ply.stress.xx, 61340 * 0.0130 * left(0.0130), 1e-9 * 805);
    ply.strain(0.0010, 0, 0, 100);
    EXPECT_NEAR(ply.stress.xx, 61340 * 0.0140 * left(0.0140), 1e-9 * 805);
    ply.strain(0.0060, 0, 0, 100);
    EXPECT_NEAR(ply.stress.xx, 0, 1e-9 * 805);
}

TEST(Fabric, CarriesNoCompressionAndTightensAgain)
{
    const auto law = Fabric::from_record(
        make_record("MAT_FABRIC", {{"RO", 1}, {"EA", 100}, {"PRBA", 0}, {"CSE", 1}}), Model{});
    struct Point {
        SymmetricTensor<double> stress{};
        std::array<double, Fabric::history_size> history{};
    } point;
    const auto strain = [&](double a, double b, double twice_ab) {
        SymmetricTensor<double> increment{a, b, 0, 0.5 * twice_ab, 0, 0};
        law.update_plane_stress(point.stress, increment, HistoryView<double>{point.history.data()}, 1);
    };
    strain(0.01, -0.02, 0);
    EXPECT_NEAR(point.stress.xx, 1, 1e-14);
    EXPECT_NEAR(point.stress.yy, 0, 1e-14);
    // Pure shear: only the pulled diagonal acts, with half the sum as centre.
    strain(-0.01, 0.02, 0.02);
    EXPECT_NEAR(point.stress.xx, 0.5, 1e-14);
    EXPECT_NEAR(point.stress.yy, 0.5, 1e-14);
    EXPECT_NEAR(point.stress.xy, 0.5, 1e-14);
    // Back to no strain, slack; then taut from there.
    strain(0, 0, -0.02);
    EXPECT_NEAR(point.stress.xx, 0, 1e-14);
    strain(-0.05, 0, 0);
    EXPECT_NEAR(point.stress.xx, 0, 1e-14);
    strain(0.06, 0, 0);
    EXPECT_NEAR(point.stress.xx, 1, 1e-13);
}

// A tenth of the thickness is an isotropic liner: 0.9 of the fabric's stress, which knows no compression, and
// 0.1 E / (1 - nu^2) (e_a + nu e_b), which does.
TEST(Fabric, LinerBearsCompression)
{
    constexpr double el = 20, prl = 0.35, share = 0.1;
    const auto law = Fabric::from_record(make_record("MAT_FABRIC", {{"RO", 1},
                                                                    {"EA", 100},
                                                                    {"EB", 60},
                                                                    {"PRBA", 0.2},
                                                                    {"GAB", 30},
                                                                    {"CSE", 1},
                                                                    {"EL", el},
                                                                    {"PRL", prl},
                                                                    {"LRATIO", share}}),
                                         Model{});
    SymmetricTensor<double> stress{};
    std::array<double, Fabric::history_size> history{};
    const auto strain = [&](double a, double b, double twice_ab) {
        SymmetricTensor<double> increment{a, b, 0, 0.5 * twice_ab, 0, 0};
        law.update_plane_stress(stress, increment, HistoryView<double>{history.data()}, 1);
    };
    const double plane = el / (1 - prl * prl), shear = el / (2 * (1 + prl));
    strain(-0.03, -0.02, 0.002);
    EXPECT_NEAR(stress.xx, share * plane * (-0.03 + prl * -0.02), 1e-14);
    EXPECT_NEAR(stress.yy, share * plane * (-0.02 + prl * -0.03), 1e-14);
    EXPECT_NEAR(stress.xy, share * shear * 0.002, 1e-14);
    strain(0.04, 0.04, -0.002); // taut: 0.01, 0.02
    const double coupling = 1 - 0.2 * 0.2 * 100 / 60.0;
    EXPECT_NEAR(stress.xx,
                0.9 * (100 * 0.01 + 0.2 * 100 * 0.02) / coupling + share * plane * (0.01 + prl * 0.02),
                1e-13);
    EXPECT_NEAR(stress.yy,
                0.9 * (60 * 0.02 + 0.2 * 100 * 0.01) / coupling + share * plane * (0.02 + prl * 0.01), 1e-13);
    EXPECT_NEAR(law.largest_modulus(), 0.9 * 100 / coupling + share * plane, 1e-12);
}

} // namespace plash
