#include "tests/support/ale_samples.h"

#include <gtest/gtest.h>
#include <numbers>

namespace plash {

namespace {

enum class Shape { disc, slotted_disc, square };

bool inside(Shape shape, double x, double z)
{
    const bool disc = std::hypot(x - 0.5, z - 0.75) < 0.15;
    if (shape == Shape::disc) return disc;
    if (shape == Shape::slotted_disc) return disc && !(std::abs(x - 0.5) < 0.025 && z < 0.85);
    return std::abs(x - 0.5) < 0.1 && std::abs(z - 0.75) < 0.1;
}

struct Result {
    double error; ///< sum of |after - before| over the sum of before
    Extremes extremes;
    double mass_change; ///< relative
};

/// One turn of a shape about the middle of the unit square (Zalesak 1979), in a sheet one cell thick.
Result turn(Shape shape, int cells, AdvectionOrder order = AdvectionOrder::van_leer)
{
    LagrangeSettings settings;
    settings.void_allowed = true;
    BoxFluid fluid(BoxGrid::uniform({0, 0, 0}, {1, 1.0 / cells, 1}, {cells, 1, cells}), {linear_liquid(1, 1)},
                   settings);
    fluid.order = order;
    std::vector<double> before;
    for_cells(fluid.grid, [&](int i, int j, int k) {
        const auto in = [&](double x, double, double z) { return inside(shape, x, z); };
        before.push_back(sampled_fraction(fluid.grid, i, j, k, 8, in));
        fluid.fill_cell(i, j, k, 0, before.back(), 1, 0);
    });
    const double mass = fluid.total_mass(0);
    set_mean_velocity(fluid, [](double x, double, double z) {
        return std::array<double, 3>{-(z - 0.5), 0, x - 0.5};
    });
    const int steps = static_cast<int>(
        std::ceil(2 * std::numbers::pi * 0.5 * cells / 0.25)); // at most a quarter cell a step
    Result result{};
    result.extremes = carry(fluid, 2 * std::numbers::pi / steps, steps);
    double sum = 0;
    std::size_t cell = 0;
    for_cells(fluid.grid, [&](int i, int j, int k) {
        const double after = fluid.fields.groups[0].fraction[fluid.grid.at(i, j, k)];
        result.error += std::abs(after - before[cell]);
        sum += before[cell++];
    });
    result.error /= sum;
    result.mass_change = (fluid.total_mass(0) - mass) / mass;
    return result;
}

/// A smooth hump of density in full cells, carried around the same way.
double turn_hump(int cells, AdvectionOrder order)
{
    BoxFluid fluid(BoxGrid::uniform({0, 0, 0}, {1, 1.0 / cells, 1}, {cells, 1, cells}), {linear_liquid(1, 1)},
                   {});
    fluid.order = order;
    const auto density = [&](int i, int k) {
        const double r = std::hypot(fluid.grid.centre(0, i) - 0.5, fluid.grid.centre(2, k) - 0.7) / 0.25;
        return r < 1 ? 1 + std::pow(std::cos(0.5 * std::numbers::pi * r), 2) : 1;
    };
    for_cells(fluid.grid, [&](int i, int j, int k) { fluid.fill_cell(i, j, k, 0, 1, density(i, k), 0); });
    set_mean_velocity(fluid, [](double x, double, double z) {
        return std::array<double, 3>{-(z - 0.5), 0, x - 0.5};
    });
    const int steps = static_cast<int>(std::ceil(2 * std::numbers::pi * 0.5 * cells / 0.25));
    carry(fluid, 2 * std::numbers::pi / steps, steps);
    double error = 0, sum = 0;
    for_cells(fluid.grid, [&](int i, int j, int k) {
        const double after = fluid.fields.groups[0].mass[fluid.grid.at(i, j, k)] / fluid.grid.volume(i, j, k);
        error += std::abs(after - density(i, k));
        sum += density(i, k) - 1;
    });
    return error / sum;
}

/// A sphere carried along a skew direction, through all three sweeps; error against the sphere at its new
/// place.
Result carry_sphere(int cells)
{
    const Threads one(1);
    LagrangeSettings settings;
    settings.void_allowed = true;
    BoxFluid fluid(BoxGrid::uniform({0, 0, 0}, {1, 1, 1}, {cells, cells, cells}), {linear_liquid(1, 1)},
                   settings);
    const std::array<double, 3> way{0.3, 0.28, 0.25};
    const auto fraction = [&](int i, int j, int k, double time) {
        return sampled_fraction(fluid.grid, i, j, k, 6, [&](double x, double y, double z) {
            return std::hypot(x - 0.35 - way[0] * time, y - 0.35 - way[1] * time, z - 0.35 - way[2] * time) <
                   0.2;
        });
    };
    for_cells(fluid.grid,
              [&](int i, int j, int k) { fluid.fill_cell(i, j, k, 0, fraction(i, j, k, 0), 1, 0); });
    const double mass = fluid.total_mass(0);
    set_mean_velocity(fluid, [&](double, double, double) { return way; });
    Result result{};
    result.extremes = carry(fluid, 1.0 / (4 * cells), 4 * cells);
    double sum = 0;
    for_cells(fluid.grid, [&](int i, int j, int k) {
        const double expected = fraction(i, j, k, 1);
        result.error += std::abs(fluid.fields.groups[0].fraction[fluid.grid.at(i, j, k)] - expected);
        sum += expected;
    });
    result.error /= sum;
    result.mass_change = (fluid.total_mass(0) - mass) / mass;
    return result;
}

} // namespace

// Youngs' planes are exact to second order only where the interface runs along a line of cells; for a curved
// one the observed order lies between 1 and 2 (Rider & Kothe 1998, J. Comput. Phys. 141, 112-152, table 5).
TEST(AleAdvection, DiscComesBackWithAnErrorThatFallsFasterThanTheMesh)
{
    const Result coarse = turn(Shape::disc, 32), fine = turn(Shape::disc, 64);
    EXPECT_LT(fine.error, 0.012);
    EXPECT_GT(coarse.error / fine.error, 2.0);
}

// On 64 cells the slot is three cells wide and the square thirteen: corners are rounded over about two cells,
// which alone is some 8 % of the area of the square. Measured 0.071 and 0.098; the error of the square halves
// with the mesh.
TEST(AleAdvection, SlottedDiscAndSquareKeepTheirShape)
{
    EXPECT_LT(turn(Shape::slotted_disc, 64).error, 0.08);
    const double square = turn(Shape::square, 64).error;
    EXPECT_LT(square, 0.11);
    EXPECT_GT(turn(Shape::square, 32).error / square, 1.7);
}

TEST(AleAdvection, FractionsNeitherOvershootNorUndershootAndMassStays)
{
    for (const Shape shape : {Shape::disc, Shape::slotted_disc, Shape::square}) {
        const Result result = turn(shape, 40);
        EXPECT_GE(result.extremes.lowest, -1e-12);
        EXPECT_LE(result.extremes.highest, 1 + 1e-12);
        EXPECT_NEAR(result.mass_change, 0, 1e-12); // round-off of some 1e6 exchanges between cells
    }
}

// A hump with a smooth top: monotone slopes cost some order at the top, donor cell is of first order
// throughout and not yet in its asymptotic range on these meshes.
TEST(AleAdvection, VanLeerIsOfSecondOrderAndDonorCellIsNot)
{
    const double coarse = turn_hump(32, AdvectionOrder::van_leer),
                 fine = turn_hump(64, AdvectionOrder::van_leer);
    EXPECT_GT(std::log2(coarse / fine), 1.7);
    EXPECT_LT(fine, 0.04); // measured 0.032
    const double rough = turn_hump(32, AdvectionOrder::donor_cell),
                 less = turn_hump(64, AdvectionOrder::donor_cell);
    EXPECT_LT(std::log2(rough / less), 1.0);
    EXPECT_GT(less, 10 * fine);
}

// Measured 0.048 and 0.022. Youngs' gradient is of first order where the sphere's normal runs along the
// diagonal.
TEST(AleAdvection, SphereTravelsInBounds)
{
    const Result coarse = carry_sphere(16), fine = carry_sphere(32);
    for (const Result& result : {coarse, fine}) {
        EXPECT_GE(result.extremes.lowest, -1e-12);
        EXPECT_LE(result.extremes.highest, 1 + 1e-12);
        EXPECT_NEAR(result.mass_change, 0, 1e-12);
    }
    EXPECT_LT(fine.error, 0.025);
    EXPECT_GT(coarse.error / fine.error, 1.9);
}

} // namespace plash
