#include "tests/support/ale_samples.h"

#include <gtest/gtest.h>
#include <random>

/// Fluid::dry_around spares a coupling the points that no fluid can meet. What it calls dry must be so for
/// all that a coupling looks at: two cells around the cell of a point, and the cells around the place that
/// lies half a cell before it.
namespace plash {

namespace {

std::vector<double> growing(int cells, double width, double ratio)
{
    std::vector<double> planes{0};
    for (int cell = 0; cell < cells; ++cell, width *= ratio) planes.push_back(planes.back() + width);
    return planes;
}

double filled(const BoxFluid& fluid, int i, int j, int k)
{
    const BoxGrid& grid = fluid.grid;
    const auto within = [&](int axis, int cell) { return cell >= 0 && cell < grid.cells(axis); };
    return within(0, i) && within(1, j) && within(2, k) ? fluid.fields.groups[0].fraction[grid.at(i, j, k)]
                                                        : 0;
}

} // namespace

TEST(AleDryAround, NeverLeavesOutWhatAPointMayMeet)
{
    // Growing cells whose widths differ by up to a factor of 20.
    LagrangeSettings settings;
    settings.void_allowed = true;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    const auto pick = [&](double low, double high) { return low + (high - low) * part(random); };
    int dry = 0, wet = 0;
    for (int round = 0; round < 20; ++round) {
        BoxFluid fluid(BoxGrid({growing(37, 0.1, 1.05), growing(13, 1, 1), growing(11, 2, 0.8)}),
                       {linear_liquid(1000, 100)}, settings);
        const BoxGrid& grid = fluid.grid;
        for (int drop = 0; drop < 3; ++drop)
            fluid.fill_cell(random() % 37, random() % 13, random() % 11, 0, pick(0.001, 1), 1000, 0);
        fluid.start();
        for (int box = 0; box < 50; ++box) {
            double low[3], high[3];
            for (int axis = 0; axis < 3; ++axis) {
                const double end = grid.planes(axis).back();
                low[axis] = pick(-0.1, 1) * end;
                high[axis] = low[axis] + pick(0, 0.1) * end;
            }
            const std::array<int, 3> guess = {int(random() % 37), int(random() % 13), int(random() % 11)};
            const bool found =
                fluid.dry_around({low[0], low[1], low[2]}, {high[0], high[1], high[2]}, guess, 1);
            ++(found ? dry : wet);
            EXPECT_TRUE(fluid.dry_around({low[0], low[1], low[2]}, {high[0], high[1], high[2]}, guess, 2));
            if (!found) continue;
            for (int trial = 0; trial < 50; ++trial) {
                const Vec3 x{pick(low[0], high[0]), pick(low[1], high[1]), pick(low[2], high[2])};
                const MeshPoint own = fluid.locate(x, guess);
                if (!own.inside) continue;
                for (int n = 0; n < 125; ++n)
                    ASSERT_EQ(filled(fluid, own.cell[0] + n % 5 - 2, own.cell[1] + n / 5 % 5 - 2,
                                     own.cell[2] + n / 25 - 2),
                              0);
                Vec3 normal{pick(-1, 1), pick(-1, 1), pick(-1, 1)};
                normal = (1 / norm(normal)) * normal;
                double reach = 0;
                for (const Vec3& edge : fluid.edges(own)) reach += 0.5 * std::abs(dot(edge, normal));
                const PlaceWeights around = fluid.cell_weights(fluid.locate(x + reach * normal, own.cell));
                for (const std::ptrdiff_t place : around.place)
                    ASSERT_EQ(fluid.fields.groups[0].fraction[place], 0);
            }
        }
    }
    EXPECT_GT(dry, 300); // of 1000: neither answer is the rule
    EXPECT_GT(wet, 100);
}

} // namespace plash
