#include "materials/soil_foam.h"
#include "tests/support/law_driver.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

// Units: mm, ms, kg, GPa; a sand like that of the drop tests of NASA's fuselage sections.
constexpr double soil_shear = 0.01, soil_bulk = 0.5;
constexpr double soil_a0 = 4e-8, soil_a1 = 2e-5, soil_a2 = 0.3, soil_cutoff = -2e-4;

SoilFoam sand(std::vector<std::pair<const char*, double>> more = {},
              const char* keyword = "MAT_SOIL_AND_FOAM")
{
    std::vector<std::pair<const char*, double>> fields{
        {"RO", 1.6e-6},  {"G", soil_shear},   {"BULK", soil_bulk}, {"A0", soil_a0}, {"A1", soil_a1},
        {"A2", soil_a2}, {"PC", soil_cutoff}, {"EPS1", 0},         {"EPS2", -0.05}, {"EPS3", -0.15},
        {"P1", 0},       {"P2", 1e-3},        {"P3", 11e-3}};
    fields.insert(fields.begin(), more.begin(), more.end()); // the first of a name counts
    return SoilFoam::from_record(make_record(keyword, std::move(fields)), Model{});
}

double pressure_of(const SymmetricTensor<double>& stress)
{
    return -trace(stress) / 3;
}

/// Yield stress at a pressure.
double strength(double p)
{
    return std::sqrt(3 * (soil_a0 + soil_a1 * p + soil_a2 * p * p));
}

} // namespace

/// Hydrostatic cycle: up to a compaction of 0.1, back until tension is cut off, up again beyond. On straight
/// pieces of the table the pressure is exact.
TEST(SoilFoam, CrushesAlongItsTableAndUnloadsWithItsBulkModulus)
{
    const SoilFoam soil = sand();
    testing::DrivenPoint point(soil);
    const auto squeeze = [&](double compaction) {
        point.strain({-compaction / 3, -compaction / 3, -compaction / 3, 0, 0, 0}, 10);
        return pressure_of(point.stress);
    };
    EXPECT_NEAR(squeeze(0.05), 1e-3, 1e-15);
    EXPECT_NEAR(squeeze(0.05), 6e-3, 1e-15); // 1e-3 + 0.05 * 0.1
    EXPECT_NEAR(squeeze(-0.004), 6e-3 - 0.5 * 0.004, 1e-15);
    EXPECT_NEAR(squeeze(0.004), 6e-3, 1e-15); // the way back is the way up
    EXPECT_NEAR(squeeze(-0.05), soil_cutoff, 1e-15);
    EXPECT_NEAR(squeeze(0.05), 6e-3, 1e-15);
    EXPECT_NEAR(squeeze(0.10), 16e-3, 1e-15); // beyond the last point with its slope
    EXPECT_NEAR(squeeze(-0.01), 16e-3 - 0.5 * 0.01, 1e-15);
}

TEST(SoilFoam, WithoutCrushingGoesBackAlongItsTable)
{
    const SoilFoam soil = sand({{"VCR", 1}});
    testing::DrivenPoint point(soil);
    point.strain({-0.1, 0, 0, 0, 0, 0}, 10);
    EXPECT_NEAR(pressure_of(point.stress), 6e-3, 1e-15);
    point.strain({0.06, 0, 0, 0, 0, 0}, 10);
    EXPECT_NEAR(pressure_of(point.stress), 0.04 * 1e-3 / 0.05, 1e-15);
}

/// Shear at a constant pressure: elastic, then on the surface, whatever the number of steps.
TEST(SoilFoam, ShearedUnderPressureBearsWhatItsYieldSurfaceSays)
{
    const SoilFoam soil = sand();
    testing::DrivenPoint point(soil);
    const double p = 6e-3;
    point.strain({-0.1 / 3, -0.1 / 3, -0.1 / 3, 0, 0, 0}, 10);
    const double elastic = 0.3 * strength(p) / std::sqrt(3.0) / soil_shear; // engineering shear strain
    point.strain({0, 0, 0, 0.5 * elastic, 0, 0}, 3);
    EXPECT_NEAR(point.stress.xy, soil_shear * elastic, 1e-15);
    point.strain({0, 0, 0, 5 * elastic, 0, 0}, 7);
    EXPECT_NEAR(std::sqrt(3.0) * point.stress.xy, strength(p), 1e-15);
    EXPECT_NEAR(pressure_of(point.stress), p, 1e-15);
    // Equivalent plastic strain: all shear strain less the elastic part, over sqrt(3).
    const double total = 11 * elastic, yield = strength(p) / std::sqrt(3.0) / soil_shear;
    EXPECT_NEAR(point.history[SoilFoam::plastic_strain], (total - yield) / std::sqrt(3.0), 1e-13);
}

/// Uniaxial strain: axial stress -(p + 2/3 Y(p)) once the point yields, which a stiff one does early.
TEST(SoilFoam, CompressedUniaxiallyHasItsAxialStress)
{
    const SoilFoam soil = sand({{"G", 0.2}});
    testing::DrivenPoint point(soil);
    point.strain({0, 0, -0.12, 0, 0, 0}, 1000);
    const double p = 1e-3 + 0.07 * 0.1;
    EXPECT_NEAR(point.stress.zz, -(p + 2.0 / 3 * strength(p)), 1e-14);
    EXPECT_NEAR(point.stress.xx, -(p - 1.0 / 3 * strength(p)), 1e-14);
}

TEST(SoilFoam, OnceTornBearsNoTensionAgain)
{
    const SoilFoam soil = sand({}, "MAT_SOIL_AND_FOAM_FAILURE");
    testing::DrivenPoint point(soil);
    point.strain({3e-4, 0, 0, 0, 0, 0}, 3); // -1.5e-4, above PC
    EXPECT_NEAR(pressure_of(point.stress), -1.5e-4, 1e-15);
    point.strain({3e-4, 0, 0, 0, 0, 0}, 3);
    EXPECT_NEAR(pressure_of(point.stress), 0, 1e-15);
    point.strain({-4.5e-4, 0, 0, 0, 0, 0}, 3); // where it bore tension before
    EXPECT_NEAR(pressure_of(point.stress), 0, 1e-15);
    point.strain({-3e-4, 0, 0, 0, 0, 0}, 3);
    EXPECT_NEAR(pressure_of(point.stress), 1.5e-4 * 1e-3 / 0.05, 1e-15);
}

TEST(SoilFoam, ReadsCompactionOfEitherSignAndRefusesMixedOnes)
{
    const SoilFoam positive = sand({{"EPS2", 0.05}, {"EPS3", 0.15}});
    testing::DrivenPoint point(positive);
    point.strain({-0.1, 0, 0, 0, 0, 0}, 10);
    EXPECT_NEAR(pressure_of(point.stress), 6e-3, 1e-15);
    EXPECT_THROW(sand({{"EPS3", 0.15}}), DeckError);
    EXPECT_THROW(sand({{"P3", 0.5e-3}}), DeckError);
    EXPECT_THROW(sand({{"PC", 1e-3}}), DeckError);
    // An unloading modulus below the steepest slope of the table would give work back for nothing.
    EXPECT_NEAR(sand({{"BULK", 0.01}}).bulk_modulus, 0.1, 1e-12);
}

TEST(SoilFoam, LanesEqualTheScalarReference)
{
    testing::expect_lanes_as_points(sand(), 1e-3, 1e-15);
}

} // namespace plash
